// OutputFile on POSIX file descriptors.
#include "printers/archive/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "engine/base/error.h"

namespace lamella {
namespace {

[[noreturn]] void throw_errno(const char* what, const std::filesystem::path& path) {
    if (errno == EPIPE)
        throw FaultError(path.string() + ": its reader has gone before all of it was written");
    throw FaultError(std::string("cannot ") + what + " " + path.string() + ": " +
                     std::generic_category().message(errno));
}

int open_or_fail(const std::filesystem::path& path, int flags) {
    const int descriptor = ::open(path.c_str(), flags | O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) throw_errno("open", path);
    return descriptor;
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path path, int descriptor, std::uint64_t size)
    : path_(std::move(path)), descriptor_(descriptor), size_(size) {}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    std::swap(size_, other.size_);
    return *this;
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

OutputFile OutputFile::create(const std::filesystem::path& path) {
    return {path, open_or_fail(path, O_TRUNC), 0};
}

OutputFile OutputFile::continue_at(const std::filesystem::path& path, std::uint64_t size) {
    OutputFile file(path, open_or_fail(path, 0), size);
    if (::ftruncate(file.descriptor_, static_cast<off_t>(size)) != 0) throw_errno("shorten", path);
    if (::lseek(file.descriptor_, 0, SEEK_END) < 0) throw_errno("continue", path);
    return file;
}

OutputFile OutputFile::standard_output() {
    const std::filesystem::path name = "standard output";
    const int descriptor = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
    if (descriptor < 0) throw_errno("open", name);
    return {name, descriptor, 0};
}

void OutputFile::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw_errno("write", path_);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        size_ += static_cast<std::uint64_t>(written);
    }
}

void OutputFile::rewrite_start(std::string_view text) {
    for (off_t at = 0; !text.empty();) {
        const ssize_t written = ::pwrite(descriptor_, text.data(), text.size(), at);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw_errno("write", path_);
        text.remove_prefix(static_cast<std::size_t>(written));
        at += written;
    }
}

void OutputFile::sync() {
    // Pipes and devices cannot be synced, and do not need it.
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) throw_errno("store", path_);
}

void OutputFile::close() {
    if (descriptor_ >= 0 && ::close(std::exchange(descriptor_, -1)) != 0) throw_errno("close", path_);
}

void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    std::filesystem::path unfinished = path;
    unfinished += ".tmp";
    OutputFile file = OutputFile::create(unfinished);
    file.write(bytes);
    file.close();
    rename_output(unfinished, path);
}

void write_whole_file(const std::filesystem::path& path, std::string_view text) {
    write_whole_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

bool names_standard_output(const std::filesystem::path& path) { return path == "-"; }

bool is_present(const std::filesystem::path& path) {
    std::error_code error;
    return std::filesystem::exists(std::filesystem::symlink_status(path, error));
}

void rename_output(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::error_code error;
    std::filesystem::rename(from, to, error);
    if (error) {
        throw FaultError("cannot rename " + from.string() + " to " + to.string() + ": " + error.message());
    }
}

}  // namespace lamella
