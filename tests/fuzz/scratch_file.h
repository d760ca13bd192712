// A file of this process for readers that take a path, in memory where the system has such a folder.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace lamella {

/// A folder that is made at the first call; it stays when the fuzzer ends on a finding.
inline const std::filesystem::path& scratch_folder() {
    static const std::filesystem::path folder = [] {
        const std::filesystem::path memory = "/dev/shm";
        const auto root = std::filesystem::exists(memory) ? memory : std::filesystem::temp_directory_path();
        std::string pattern = (root / "lamella_fuzz_XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr) std::abort();
        return std::filesystem::path(pattern);
    }();
    return folder;
}

/// Writes the bytes to a file of this name in the scratch folder and returns its path.
inline std::string scratch_file(const std::string& name, std::string_view bytes) {
    const std::string path = (scratch_folder() / name).string();
    std::ofstream out(path, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
}

inline std::string scratch_file(const std::string& name, const std::uint8_t* data, std::size_t size) {
    return scratch_file(name, {reinterpret_cast<const char*>(data), size});
}

}  // namespace lamella
