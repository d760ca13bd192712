// UnfinishedFolder: creates, resumes, replaces and completes a folder of layers.
#include "printers/archive/unfinished_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "engine/base/error.h"
#include "engine/base/json_depth.h"
#include "printers/common/layer_heights.h"

namespace lamella {
namespace fs = std::filesystem;
namespace {

constexpr const char* job_file = "job.json";
constexpr const char* stamp_file = "unfinished.json";
constexpr const char* journal_file = "unfinished.layers";
constexpr std::string_view sheet_prefix = "sheet_";

nlohmann::ordered_json read_json(const fs::path& path) {
    std::ifstream in(path);
    if (!in) return nullptr;
    const std::string text(std::istreambuf_iterator<char>(in), {});
    return nlohmann::ordered_json::parse(shallow_json(text), nullptr, false);
}

/// Returns true if a run died before it could record which job the folder belongs to.
bool holds_nothing(const fs::path& folder) {
    return fs::is_directory(folder) &&
           std::all_of(fs::directory_iterator(folder), fs::directory_iterator(),
                       [](const auto& entry) { return entry.path().extension() == ".tmp"; });
}

/// Returns true if a folder has the description that marks it as complete.
bool is_ours_whole(const fs::path& folder) {
    const nlohmann::ordered_json job = read_json(folder / job_file);
    return job.is_object() && job.value("format", "") == "lamella-layers";
}

std::string journal_line(double area, double support_area) {
    return nlohmann::json{area, support_area}.dump() + "\n";
}

}  // namespace

bool is_finished_output(const fs::path& path) {
    const fs::path named = path.filename().empty() ? path.parent_path() : path;  // "out/" means "out"
    fs::path partial = named;
    partial += ".partial";
    if (is_present(partial)) return false;
    std::error_code ignored;
    return fs::is_directory(named, ignored) ? is_ours_whole(named) : fs::is_regular_file(named, ignored);
}

UnfinishedFolder::UnfinishedFolder(fs::path path, std::string extension, bool force)
    : path_(std::move(path)), extension_(std::move(extension)), force_(force) {
    if (path_.filename().empty()) path_ = path_.parent_path();  // "out/" means "out"
    if (path_.filename().empty() || path_.filename() == "." || path_.filename() == "..") {
        throw InputError("'" + path_.string() + "' does not name an output folder");
    }
    partial_ = path_;
    partial_ += ".partial";
}

std::string UnfinishedFolder::file_name(int layer) const { return fmt::format("{:05}{}", layer, extension_); }

bool UnfinishedFolder::is_ours(const fs::path& file) const {
    const std::string name = file.filename().string();
    if (name == job_file || name == stamp_file || name == journal_file) return true;
    std::string_view stem = name;
    if (stem.ends_with(".tmp")) stem.remove_suffix(4);
    if (stem == job_file || stem == stamp_file) return true;
    // Files of every format count: a folder of one format may replace one of another.
    stem = stem.substr(0, stem.find('.'));
    const bool sheet = stem.starts_with(sheet_prefix);
    if (sheet) stem.remove_prefix(sheet_prefix.size());
    return stem.size() >= (sheet ? 3 : 5) &&
           std::ranges::all_of(stem, [](char c) { return '0' <= c && c <= '9'; });
}

void UnfinishedFolder::check_replaceable() const {
    if (!force_) {
        throw InputError(path_.string() + " exists already; choose another name or pass --force");
    }
    if (!fs::is_directory(path_) || !is_ours_whole(path_)) {
        throw InputError(path_.string() +
                         " is no folder of layers that lamella made, so --force does not replace it; choose "
                         "another name");
    }
    for (const auto& entry : fs::directory_iterator(path_)) {
        if (entry.is_directory() || !is_ours(entry.path())) {
            throw InputError(path_.string() + " holds " + entry.path().filename().string() +
                             ", which lamella did not write, so --force does not replace it; move that file "
                             "away or choose another name");
        }
    }
}

void UnfinishedFolder::remove_ours(const fs::path& folder) const {
    std::error_code ignored;  // a file that stays prevents the folder's removal, which is reported
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (!entry.is_directory() && is_ours(entry.path())) files.push_back(entry.path());
    }
    for (const fs::path& file : files) fs::remove(file, ignored);
    std::error_code error;
    fs::remove(folder, error);
    if (error) throw FaultError("cannot remove " + folder.string() + ": " + error.message());
}

nlohmann::ordered_json UnfinishedFolder::open(const JobStamp& stamp, bool resume) {
    if (names_standard_output(path_)) {
        throw InputError(
            "sheets that layers share are a folder of files; name one with -o instead of standard output");
    }
    nlohmann::ordered_json state;
    if (is_present(path_)) check_replaceable();
    if (is_present(partial_)) lock_.take(partial_);
    // A run that died after removing its stamp and before renaming the folder leaves a job.json. The folder
    // is made anew.
    if (resume && !is_present(partial_ / stamp_file) && is_ours_whole(partial_)) remove_ours(partial_);
    if (is_present(partial_) && !holds_nothing(partial_)) {
        if (resume) {
            const nlohmann::ordered_json found = read_json(partial_ / stamp_file);
            check_same_job(found, stamp, partial_);
            state = found.value("state", nlohmann::ordered_json());
        } else if (!force_) {
            throw InputError(partial_.string() +
                             " is left from a run that was stopped; continue it with --resume, or discard it "
                             "with --force");
        } else {
            remove_ours(partial_);
        }
    }
    std::error_code error;
    fs::create_directories(partial_, error);
    if (error) throw FaultError("cannot make the folder " + partial_.string() + ": " + error.message());
    lock_.take(partial_);
    stamp_ = stamp;
    note(state);
    return state;
}

void UnfinishedFolder::note(const nlohmann::ordered_json& state) {
    nlohmann::ordered_json stamp = to_json(stamp_);
    if (!state.is_null()) stamp["state"] = state;
    write_whole_file(partial_ / stamp_file, stamp.dump(2) + "\n");
}

void UnfinishedFolder::commit(const std::string& file, std::string_view text,
                              const nlohmann::ordered_json& state) {
    write_whole_file(partial_ / file, text);
    note(state);
}

bool UnfinishedFolder::has(const std::string& file) const { return is_present(partial_ / file); }

int UnfinishedFolder::begin(const JobStamp& stamp, bool resume) {
    if (names_standard_output(path_)) {
        if (resume) throw InputError("standard output cannot be continued; name a folder for --resume");
        pipe_ = OutputFile::standard_output();
        return stamp.range.first;
    }
    open(stamp, resume);
    read_journal(stamp);
    // Rewritten, so that it contains no partial line.
    journal_ = OutputFile::create(partial_ / journal_file);
    for (std::size_t i = 0; i < areas_.size(); ++i)
        journal_.write(journal_line(areas_[i], support_areas_[i]));
    return stamp.range.first + static_cast<int>(areas_.size());
}

/// Takes over the layers that have both a file and recorded areas.
void UnfinishedFolder::read_journal(const JobStamp& stamp) {
    areas_.clear();
    support_areas_.clear();
    std::ifstream in(partial_ / journal_file);
    std::string line;
    for (int layer = stamp.range.first; layer < stamp.range.last; ++layer) {
        if (!is_present(partial_ / file_name(layer)) || !std::getline(in, line)) return;
        const auto areas = nlohmann::json::parse(shallow_json(line), nullptr, false);
        if (!areas.is_array() || areas.size() != 2 || !areas[0].is_number() || !areas[1].is_number()) return;
        areas_.push_back(areas[0]);
        support_areas_.push_back(areas[1]);
    }
}

void UnfinishedFolder::write(int layer, std::span<const std::byte> bytes, const LayerProduct& product) {
    if (names_standard_output(path_)) {
        pipe_.write(bytes);
        return;
    }
    write_whole_file(partial_ / file_name(layer), bytes);
    journal_.write(journal_line(product.area, product.support_area));
    areas_.push_back(product.area);
    support_areas_.push_back(product.support_area);
}

void UnfinishedFolder::end(nlohmann::ordered_json job) {
    if (names_standard_output(path_)) {
        pipe_.close();
        return;
    }
    if (!areas_.empty()) job["areas"] = areas_;
    const auto is_some = [](double area) { return area > 0; };
    if (std::any_of(support_areas_.begin(), support_areas_.end(), is_some))
        job["support_areas"] = support_areas_;
    write_whole_file(partial_ / job_file, job.dump(2) + "\n");
    journal_.close();
    std::error_code ignored;  // files that stay behind do no harm
    fs::remove(partial_ / stamp_file, ignored);
    fs::remove(partial_ / journal_file, ignored);
    if (is_present(path_)) {
        // The old folder is renamed first and removed last, so that one of the two always exists.
        fs::path old = path_;
        old += ".replaced";
        rename_output(path_, old);
        rename_output(partial_, path_);
        remove_ours(old);
    } else {
        rename_output(partial_, path_);
    }
}

nlohmann::ordered_json describe_job(const Job& job, LayerRange range, const std::string& extension) {
    const auto point = [](dvec3 p) { return nlohmann::ordered_json{p.x, p.y, p.z}; };
    nlohmann::ordered_json json{
        {"format", "lamella-layers"},
        {"version", 1},
        {"name", job.name},
        {"identity", job.identity},
        {"unit", "mm"},
        {"layer_height", layer_heights_json(job.layers)},
        {"layer_count", job.layers.count()},
        {"first_layer", range.first},
        {"last_layer", range.last},
        {"files", "%05d" + extension},
        {"first_plane", job.plane(0) - job.z0()},
        {"part_bounds", {{"lo", point(job.bounds.lo)}, {"hi", point(job.bounds.hi)}}}};
    if (!job.notes.empty()) json["notes"] = job.notes;
    return json;
}

}  // namespace lamella
