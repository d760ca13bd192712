// TemporaryFolder: a folder among the temporary files.
#pragma once

#include <filesystem>

namespace lamella {

/// A folder among the temporary files, which goes with this object.
class TemporaryFolder {
  public:
    /// Throws FaultError where none can be made.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace lamella
