// A folder with one file a layer that grows under the name NAME.partial and gets its own name when complete.
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

namespace lamella {

/// Writes NAME.partial/00000.png and so on, each file whole or absent, the layers' areas in a journal beside
/// them, and job.json at the end. Files are
/// numbered by the layer's index, so that the folders of two ranges hold the files of the whole.
///
/// The path "-" is standard output: the files one after another, without job.json.
class UnfinishedFolder {
  public:
    /// `extension` includes the dot. `force` lets a finished folder that holds nothing but a job of ours be
    /// replaced, and an unfinished one be discarded.
    UnfinishedFolder(std::filesystem::path path, std::string extension, bool force);

    /// Makes the folder and returns the first missing layer. Throws as UnfinishedFile::begin does.
    int begin(const JobStamp& stamp, bool resume);
    /// Writes the file of a layer, the next one.
    void write(int layer, std::span<const std::byte> bytes, const LayerProduct& product);

    /// For folders whose files are not one a layer: makes the folder and returns what the last `commit` noted
    /// down, null when there is none. Throws as begin does.
    nlohmann::ordered_json open(const JobStamp& stamp, bool resume);
    /// Writes a file, and then notes down what a run that continues here has to know.
    void commit(const std::string& file, std::string_view text, const nlohmann::ordered_json& state);
    bool has(const std::string& file) const;
    /// Writes job.json, which marks the folder complete, with the areas of layers that were written one by
    /// one, and gives the folder its name.
    void end(nlohmann::ordered_json job);
    /// Name of a layer's file, "00042.png".
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
    std::vector<double> areas_, support_areas_;  ///< of the layers that are there, mm^2
    OutputFile pipe_;                            ///< standard output where that is asked for
    JobStamp stamp_;
};

/// What every job.json says: format, name, identity, layers, range, file names, heights, bounds.
nlohmann::ordered_json describe_job(const Job& job, LayerRange range, const std::string& extension);

}  // namespace lamella
