// A file that changes while it is read is kept in its state before, and so read again.
#include "recipe/inputs/input_cache.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "recipe/identity.h"

namespace lamella {

namespace {

std::uintmax_t bytes_of(const std::string& path) {
    std::error_code missing;  // reading says so
    return std::filesystem::file_size(path, missing);
}

std::filesystem::file_time_type changed_at(const std::string& path) {
    std::error_code missing;
    return std::filesystem::last_write_time(path, missing);
}

}  // namespace

InputCache::FileState::FileState(const std::string& path)
    : bytes(bytes_of(path)), changed(changed_at(path)) {}

InputCache::Solid InputCache::solid(const SolidSource& source) {
    KeptSolid made{source, FileState(source.path)};
    {
        const std::lock_guard lock(mutex_);
        const auto found = std::ranges::find_if(solids_, [&](const KeptSolid& other) {
            return other.source == source && other.state == made.state;
        });
        if (found != solids_.end()) {
            solids_.splice(solids_.begin(), solids_, found);
            return found->solid;
        }
    }
    std::optional<MeshReport> report;
    made.solid.field = read_solid(source, report);
    made.solid.report = std::move(*report);
    const std::lock_guard lock(mutex_);
    solids_.push_front(std::move(made));
    if (solids_.size() > most_) solids_.pop_back();
    return solids_.front().solid;
}

std::string InputCache::hash(const std::string& path) {
    constexpr std::size_t most_hashes = 256;
    const FileState state(path);
    {
        const std::lock_guard lock(mutex_);
        const auto found = hashes_.find(path);
        if (found != hashes_.end() && found->second.state == state) return found->second.hash;
    }
    std::string hash = hash_file(path);
    const std::lock_guard lock(mutex_);
    if (hashes_.size() >= most_hashes) hashes_.clear();
    hashes_.insert_or_assign(path, KeptHash{state, hash});
    return hash;
}

}  // namespace lamella
