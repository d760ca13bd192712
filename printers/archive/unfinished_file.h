// A single output file that grows under the name NAME.partial and gets its own name when complete.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "printers/archive/job_stamp.h"
#include "printers/archive/output_file.h"

namespace lamella {

/// Writes NAME.partial layer by layer, and beside it NAME.partial.journal: the job's stamp on the first line,
/// then a line for each complete layer with the size of the file behind it. A run that stops anywhere, in the
/// middle of a layer included, is continued from the last complete one.
///
/// The path "-" is standard output: nothing but the bytes themselves, no journal, nothing to continue.
class UnfinishedFile {
  public:
    /// `force` lets a finished file of that name be replaced and an unfinished one be discarded.
    UnfinishedFile(std::filesystem::path path, bool force);

    /// Opens the file and returns the first missing layer. With `resume`, an unfinished file of the same job
    /// is cut behind its last complete layer. Throws InputError when the output exists, finished or not, and
    /// may not be replaced or continued; FaultError when it cannot be made.
    int begin(const JobStamp& stamp, bool resume);
    /// True when begin found an unfinished file whose prologue is complete.
    bool resumed() const { return resumed_; }
    /// Calls read(state) with what the last complete layer (or the prologue) handed to `commit`, null when
    /// there is none. Throws InputError where `read` does not find what it wants there.
    template <typename Read>
    void restore(const Read& read) const {
        try {
            read(history_.empty() ? nlohmann::ordered_json() : history_.back());
        } catch (const nlohmann::json::exception&) {
            throw damaged_journal();
        }
    }
    /// What to say of a journal that does not hold what it should.
    InputError damaged_journal() const;
    /// What was handed to every `commit` before the place where begin continues, in order.
    const std::vector<nlohmann::ordered_json>& history() const { return history_; }
    /// Appends the text of what lies before layer `next`, which is complete with it. `state` is what a run
    /// that continues here has to know.
    void commit(std::string_view text, int next, const nlohmann::ordered_json& state = nullptr);
    /// Replaces bytes at the beginning by as many others, once all layers are there.
    void rewrite_start(std::string_view text) { file_.rewrite_start(text); }
    /// Appends the end of the file and gives it its name.
    void end(std::string_view text);

  private:
    bool read_journal(const JobStamp& stamp, int& next, std::uint64_t& size);

    std::filesystem::path path_;
    std::filesystem::path partial_;
    std::filesystem::path journal_path_;
    bool force_;
    bool resumed_ = false;
    std::vector<nlohmann::ordered_json> history_;
    std::string records_;  // of the journal that is continued
    OutputFile file_;
    OutputFile journal_;
};

}  // namespace lamella
