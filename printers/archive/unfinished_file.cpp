// UnfinishedFile and its journal.
#include "printers/archive/unfinished_file.h"

#include <fstream>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/json_depth.h"

namespace lamella {
namespace fs = std::filesystem;
namespace {

fs::path with_suffix(fs::path path, const char* suffix) { return path += suffix; }

}  // namespace

UnfinishedFile::UnfinishedFile(fs::path path, bool force)
    : path_(std::move(path)),
      partial_(with_suffix(path_, ".partial")),
      journal_path_(with_suffix(partial_, ".journal")),
      force_(force) {
    if (path_.filename().empty()) throw InputError("'" + path_.string() + "' does not name an output file");
}

bool UnfinishedFile::read_journal(const JobStamp& stamp, int& next, std::uint64_t& size) {
    std::ifstream in(journal_path_);
    std::string line;
    if (!in || !std::getline(in, line)) {
        throw InputError(partial_.string() + " cannot be continued, its journal " + journal_path_.string() +
                         " is missing or empty; discard it with --force");
    }
    check_same_job(nlohmann::ordered_json::parse(shallow_json(line), nullptr, false), stamp, partial_);
    const std::uint64_t have = fs::file_size(partial_);
    bool found = false;
    // A truncated last line does not parse; a size beyond the file's end was never reached.
    while (std::getline(in, line)) {
        const auto record = nlohmann::ordered_json::parse(shallow_json(line), nullptr, false);
        if (!record.is_object() || !record.contains("next") || !record.contains("size")) break;
        if (!record["next"].is_number_integer() || !record["size"].is_number_unsigned()) break;
        const auto record_next = record["next"].get<std::int64_t>();
        const auto record_size = record["size"].get<std::uint64_t>();
        if (record_size > have || record_next < stamp.range.first || record_next > stamp.range.last) break;
        next = static_cast<int>(record_next);
        size = record_size;
        history_.push_back(record.value("state", nlohmann::ordered_json()));
        records_ += record.dump() + "\n";
        found = true;
    }
    return found;
}

int UnfinishedFile::begin(const JobStamp& stamp, bool resume) {
    if (names_standard_output(path_)) {
        if (resume) throw InputError("standard output cannot be continued; name a file for --resume");
        file_ = OutputFile::standard_output();
        return stamp.range.first;
    }
    if (fs::is_directory(path_)) throw InputError(path_.string() + " is a folder; name a file");
    if (is_present(path_) && !force_) {
        throw InputError(path_.string() + " exists already; choose another name or pass --force");
    }
    int next = stamp.range.first;
    std::uint64_t size = 0;
    if (is_present(partial_)) {
        lock_.take(partial_);
        if (resume) {
            resumed_ = read_journal(stamp, next, size);
        } else if (!force_) {
            throw InputError(partial_.string() +
                             " is left from a run that was stopped; continue it with --resume, or discard it "
                             "with --force");
        } else {
            std::error_code ignored;  // creating the files below reports the errors that matter
            fs::remove(partial_, ignored);
            fs::remove(journal_path_, ignored);
        }
    }
    // The journal is rewritten, so that a broken line in its middle cannot hide later lines. This happens
    // first, so that no file is ever without a journal.
    const std::string journal = to_json(stamp).dump() + "\n" + std::exchange(records_, {});
    write_whole_file(journal_path_, journal);
    file_ = OutputFile::continue_at(partial_, size);
    lock_.take(partial_);
    journal_ = OutputFile::continue_at(journal_path_, journal.size());
    return next;
}

InputError UnfinishedFile::damaged_journal() const {
    return InputError(journal_path_.string() + " is damaged; discard the unfinished output with --force");
}

void UnfinishedFile::commit(std::string_view text, int next, const nlohmann::ordered_json& state) {
    file_.write(text);
    if (names_standard_output(path_)) return;
    const nlohmann::ordered_json record = {{"next", next}, {"size", file_.size()}, {"state", state}};
    journal_.write(record.dump() + "\n");
}

void UnfinishedFile::end(std::string_view text) {
    file_.write(text);
    file_.sync();
    file_.close();
    if (names_standard_output(path_)) return;
    journal_.close();
    rename_output(partial_, path_);
    std::error_code ignored;  // a journal that stays behind does no harm
    fs::remove(journal_path_, ignored);
}

}  // namespace lamella
