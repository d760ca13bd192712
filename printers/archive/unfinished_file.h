// UnfinishedFile: an output file that grows as NAME.partial and is renamed when complete.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "printers/archive/job_stamp.h"
#include "printers/archive/output_file.h"
#include "printers/archive/output_lock.h"

namespace lamella {

/// Writes NAME.partial layer by layer, and a journal NAME.partial.journal: the job's stamp on the first line,
/// then a line per complete layer with the size of the file after it. An interrupted run is resumed after the
/// last complete layer, even if it stopped in the middle of one.
///
/// The path "-" is standard output: only the file's bytes, no journal, no resumption.
class UnfinishedFile {
  public:
    /// `force` allows a finished file of that name to be replaced and an unfinished one to be discarded.
    UnfinishedFile(std::filesystem::path path, bool force);

    /// Opens the file and returns the first missing layer. With `resume`, an unfinished file of the same job
    /// is truncated after its last complete layer. Throws InputError if the output exists, finished or not,
    /// and may not be replaced or resumed; FaultError if it cannot be created.
    int begin(const JobStamp& stamp, bool resume);
    /// Returns true if `begin` found an unfinished file whose prologue is complete.
    bool resumed() const { return resumed_; }
    /// Calls read(state) with the state that the last complete layer (or the prologue) passed to `commit`, or
    /// with null if there is none. Throws InputError if `read` fails to parse it.
    template <typename Read>
    void restore(const Read& read) const {
        try {
            read(history_.empty() ? nlohmann::ordered_json() : history_.back());
        } catch (const nlohmann::json::exception&) {
            throw damaged_journal();
        }
    }
    /// Returns the error for a journal whose content is invalid.
    InputError damaged_journal() const;
    /// Returns the states passed to all calls of `commit` before the point of resumption, in order.
    const std::vector<nlohmann::ordered_json>& history() const { return history_; }
    /// Appends the text of everything before layer `next`. `state` holds what a run resumed here must know.
    void commit(std::string_view text, int next, const nlohmann::ordered_json& state = nullptr);
    /// Overwrites bytes at the beginning of the file with as many others, after the last layer.
    void rewrite_start(std::string_view text) { file_.rewrite_start(text); }
    /// Appends the end of the file and renames the file.
    void end(std::string_view text);

  private:
    bool read_journal(const JobStamp& stamp, int& next, std::uint64_t& size);

    std::filesystem::path path_;
    std::filesystem::path partial_;
    std::filesystem::path journal_path_;
    bool force_;
    bool resumed_ = false;
    std::vector<nlohmann::ordered_json> history_;
    std::string records_;  // records of the resumed journal
    OutputFile file_;
    OutputFile journal_;
    OutputLock lock_;
};

}  // namespace lamella
