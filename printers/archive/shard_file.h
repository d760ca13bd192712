// Shards: files with some rendered layers of a job, to be joined with the other layers later.
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

/// Makes a back-end that packs the layers rendered by `renderer` into a shard. `settings` (everything besides
/// the job that decides the layers' bytes) is recorded in the shard. An interrupted shard can be resumed like
/// any other output.
std::unique_ptr<Backend> make_shard_writer(std::unique_ptr<Backend> renderer,
                                           const std::filesystem::path& path, std::string settings,
                                           bool force);

/// A finished shard, open for reading. Any thread may read layers.
class ShardFile {
  public:
    /// Opens a shard and indexes its layers. Throws InputError if the file is not a shard or is damaged.
    explicit ShardFile(std::filesystem::path path);

    const std::filesystem::path& path() const { return path_; }
    const JobStamp& stamp() const { return stamp_; }
    /// Returns the packed product of a layer of the shard's range. Throws InputError if its bytes are
    /// damaged.
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
    std::vector<Place> places_;  ///< indexed by layer, from the first of the range
    mutable std::mutex reading_;
    mutable std::ifstream file_;
};

/// Opens the shards of one job and sorts them. Each layer of `wanted.range` is in exactly one of them. Throws
/// InputError for a shard of another job, and for a layer that no shard or several shards have.
std::vector<std::unique_ptr<ShardFile>> open_shards(const std::vector<std::string>& paths,
                                                    const JobStamp& wanted);

}  // namespace lamella
