// JobArchive: a ZIP archive of masks and descriptions, read entry by entry within bounds.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lamella {

/// Open for reading, by libzip. Reads are serialised, so it may be shared by threads.
class JobArchive {
  public:
    /// Throws InputError when it cannot be opened as a ZIP archive.
    explicit JobArchive(const std::string& path);

    const std::string& path() const { return path_; }
    /// Names of all entries, as they stand in the directory.
    std::vector<std::string> names() const;
    bool has(const std::string& name) const;
    /// The content of an entry, its checksum compared. Throws InputError when it is missing, damaged, or
    /// unpacks to more than `most` bytes.
    std::string read(const std::string& name, std::size_t most) const;

  private:
    struct Open;
    std::string path_;
    std::shared_ptr<Open> open_;
};

}  // namespace lamella
