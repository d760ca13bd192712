// UnfinishedFolder: a folder with one file per layer that grows as NAME.partial and is renamed when complete.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "printers/archive/job_stamp.h"
#include "printers/archive/output_file.h"
#include "printers/archive/output_lock.h"

namespace lamella {

/// Returns true if a path holds a finished output, a folder of layers or a file, and no unfinished one stands
/// beside it. Files do not say which job they are of.
bool is_finished_output(const std::filesystem::path& path);

/// Writes NAME.partial/00000.png and so on, each file complete or absent, a journal with the layers' areas
/// beside them, and job.json at the end. Files are numbered by layer index, so that the folders of two ranges
/// together hold the files of the whole job.
///
/// The path "-" is standard output: the files one after another, without job.json.
class UnfinishedFolder {
  public:
    /// `extension` includes the dot. `force` allows a finished folder to be replaced if it holds nothing but
    /// one of our jobs, and an unfinished one to be discarded.
    UnfinishedFolder(std::filesystem::path path, std::string extension, bool force);

    /// Creates the folder and returns the first missing layer. Throws as UnfinishedFile::begin does.
    int begin(const JobStamp& stamp, bool resume);
    /// Writes the file of the next layer.
    void write(int layer, std::span<const std::byte> bytes, const LayerProduct& product);

    /// Creates or resumes a folder whose files do not correspond to layers. Returns the state of the last
    /// `commit`, or null if there is none. Throws as begin does.
    nlohmann::ordered_json open(const JobStamp& stamp, bool resume);
    /// Writes a file, then records the state that a resumed run must know.
    void commit(const std::string& file, std::string_view text, const nlohmann::ordered_json& state);
    bool has(const std::string& file) const;
    /// Writes job.json, which marks the folder as complete and includes the areas of layers that were written
    /// one by one. Then renames the folder.
    void end(nlohmann::ordered_json job);
    /// Returns the name of a layer's file, such as "00042.png".
    std::string file_name(int layer) const;

  private:
    void check_replaceable() const;
    void remove_ours(const std::filesystem::path& folder) const;
    void note(const nlohmann::ordered_json& state);
    bool is_ours(const std::filesystem::path& file) const;
    void read_journal(const JobStamp& stamp);

    std::filesystem::path path_;
    std::filesystem::path partial_;
    std::string extension_;
    bool force_;
    OutputFile journal_;
    OutputLock lock_;
    std::vector<double> areas_, support_areas_;  ///< of the layers written so far, mm^2
    OutputFile pipe_;                            ///< standard output, if the path is "-"
    JobStamp stamp_;
};

/// Returns the fields common to every job.json: format, name, identity, layers, range, file names, heights,
/// bounds.
nlohmann::ordered_json describe_job(const Job& job, LayerRange range, const std::string& extension);

}  // namespace lamella
