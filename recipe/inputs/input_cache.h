// InputCache: what several builds know of the same files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <map>
#include <mutex>

#include "recipe/inputs/read_solid.h"

namespace lamella {

/// Keeps the solids and hashes of files for a program that builds one recipe after another: a file is read
/// again once its size or the time of its last change differs. Thread-safe.
class InputCache {
  public:
    struct Solid {
        FieldPtr field;
        MeshReport report;
    };

    /// Keeps the `most` solids that were used last.
    explicit InputCache(std::size_t most = 3) : most_(most) {}

    /// Throws as read_solid().
    Solid solid(const SolidSource& source);
    /// Returns hash_file(path). Throws as that.
    std::string hash(const std::string& path);

  private:
    /// Tells one state of a file from another.
    struct FileState {
        explicit FileState(const std::string& path);
        bool operator==(const FileState&) const = default;

        std::uintmax_t bytes;
        std::filesystem::file_time_type changed;
    };
    struct KeptSolid {
        SolidSource source;
        FileState state;
        Solid solid{};
    };
    struct KeptHash {
        FileState state;
        std::string hash;
    };

    std::size_t most_;
    std::mutex mutex_;
    std::list<KeptSolid> solids_;  // the one used last first
    std::map<std::string, KeptHash> hashes_;
};

}  // namespace lamella
