// OutputFile: an unbuffered file writer whose errors name the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace lamella {

/// A file that is open for writing. Every operation throws FaultError with the path and the system's reason.
/// A process that exceeds its file size limit gets the signal SIGXFSZ; ignore the signal to get the
/// FaultError instead.
class OutputFile {
  public:
    OutputFile() = default;
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&& other) noexcept;
    ~OutputFile();

    /// Creates the file, or empties an existing one.
    static OutputFile create(const std::filesystem::path& path);
    /// Opens the file, truncates it to `size` bytes and appends from there.
    static OutputFile continue_at(const std::filesystem::path& path, std::uint64_t size);
    /// Returns standard output. It does not support `rewrite_start`.
    static OutputFile standard_output();

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }
    /// Overwrites existing bytes at the beginning of the file.
    void rewrite_start(std::string_view text);
    /// Returns the number of bytes in the file.
    std::uint64_t size() const { return size_; }
    /// Waits until the bytes are on the storage medium.
    void sync();
    void close();

  private:
    OutputFile(std::filesystem::path path, int descriptor, std::uint64_t size);

    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// Writes a file under a temporary name beside `path` and renames it, so that `path` is complete or absent.
void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_whole_file(const std::filesystem::path& path, std::string_view text);

/// Returns true for "-", the path that stands for standard output.
bool names_standard_output(const std::filesystem::path& path);

/// Returns true if a file of that name exists, including a dangling link.
bool is_present(const std::filesystem::path& path);

/// Renames a file, replacing any file of the new name. Throws FaultError.
void rename_output(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace lamella
