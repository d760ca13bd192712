// A file being written, unbuffered, with every failure reported by name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace lamella {

/// An open file for writing. Every operation throws FaultError with the path and the system's reason. A
/// process that exceeds its file size limit gets the signal SIGXFSZ; ignore it to see the FaultError instead.
class OutputFile {
  public:
    OutputFile() = default;
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&& other) noexcept;
    ~OutputFile();

    /// Makes the file, or empties it.
    static OutputFile create(const std::filesystem::path& path);
    /// Opens the file, cuts it to `size` bytes and goes on behind them.
    static OutputFile continue_at(const std::filesystem::path& path, std::uint64_t size);
    /// Standard output, of which nothing can be rewritten.
    static OutputFile standard_output();

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }
    /// Replaces bytes at the beginning, which exist already.
    void rewrite_start(std::string_view text);
    /// Bytes in the file.
    std::uint64_t size() const { return size_; }
    /// Waits until the bytes are on the medium.
    void sync();
    void close();

  private:
    OutputFile(std::filesystem::path path, int descriptor, std::uint64_t size);

    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// Writes a file under a temporary name beside `path` and renames it, so that `path` is whole or absent.
void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_whole_file(const std::filesystem::path& path, std::string_view text);

/// The path that stands for standard output: "-".
bool names_standard_output(const std::filesystem::path& path);

/// True when something of that name exists, a dangling link included.
bool is_present(const std::filesystem::path& path);

/// Renames, replacing a file of that name. Throws FaultError.
void rename_output(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace lamella
