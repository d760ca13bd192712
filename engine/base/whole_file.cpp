// Reads a file through the C library, block by block.
#include "engine/base/whole_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "engine/base/error.h"

namespace lamella {

std::string whole_file(const std::string& path, std::string_view expected) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        throw InputError(path + ": this is a folder; " + std::string(expected) + " was expected");
    }
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) throw InputError(path + ": cannot be opened (" + std::strerror(errno) + ")");
    std::string bytes;
    const auto size = std::filesystem::file_size(path, error);
    if (!error) bytes.reserve(static_cast<std::size_t>(size));
    char block[1U << 16U];
    while (const std::size_t got = std::fread(block, 1, sizeof block, file.get())) bytes.append(block, got);
    if (std::ferror(file.get()) != 0)
        throw FaultError(path + ": reading failed (" + std::strerror(errno) + ")");
    return bytes;
}

}  // namespace lamella
