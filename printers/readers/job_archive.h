// JobArchive: reads the entries of a ZIP archive, with a limit on their size.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lamella {

/// A ZIP archive open for reading by libzip. Reads are serialised, so several threads may share it.
class JobArchive {
  public:
    /// Throws InputError if the file cannot be opened as a ZIP archive.
    explicit JobArchive(const std::string& path);

    const std::string& path() const { return path_; }
    /// Returns the names of all entries, in the order of the directory.
    std::vector<std::string> names() const;
    bool has(const std::string& name) const;
    /// Returns the content of an entry and verifies its checksum. Throws InputError if the entry is missing,
    /// damaged, or unpacks to more than `most` bytes.
    std::string read(const std::string& name, std::size_t most) const;

  private:
    struct Open;
    std::string path_;
    std::shared_ptr<Open> open_;
};

}  // namespace lamella
