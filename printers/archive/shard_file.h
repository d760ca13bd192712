// Shards: layers of a job that were rendered by themselves, packed into a file, to be joined with others.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/layers/backend.h"
#include "printers/archive/job_stamp.h"

namespace lamella {

/// A back-end that packs what `renderer` renders into a file, which `settings` (what decides the layers'
/// bytes besides the job) is noted in. It is continued as other files are.
std::unique_ptr<Backend> make_shard_writer(std::unique_ptr<Backend> renderer,
                                           const std::filesystem::path& path, std::string settings,
                                           bool force);

/// A finished shard. Any thread may read layers.
class ShardFile {
  public:
    /// Finds the layers. Throws InputError for a file that is no shard, or a damaged one.
    explicit ShardFile(std::filesystem::path path);

    const std::filesystem::path& path() const { return path_; }
    const JobStamp& stamp() const { return stamp_; }
    /// The packed product of a layer of its range. Throws InputError where its bytes are damaged.
    std::string layer(int index) const;

  private:
    struct Place {
        std::uint64_t at, size;
        std::uint32_t crc;
    };
    [[noreturn]] void refuse(const std::string& what) const;
    void read_stamp();

    std::filesystem::path path_;
    JobStamp stamp_;
    std::vector<Place> places_;  ///< by layer, from the range's first
    mutable std::mutex reading_;
    mutable std::ifstream file_;
};

/// The shards of one job in order: each layer of `range` is in exactly one. Throws InputError for shards of
/// another job than the stamp's, and for layers that none has or several have.
std::vector<std::unique_ptr<ShardFile>> open_shards(const std::vector<std::string>& paths,
                                                    const JobStamp& wanted);

}  // namespace lamella
