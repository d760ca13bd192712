// Plans in files: read if they are whole, kept if they can be.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>

#include "engine/base/error.h"

namespace lamella {

/// Returns read(stream, name) of a file; nothing if it is not there or damaged: then the plan is made anew.
template <typename Read>
auto read_kept(const std::filesystem::path& file, const Read& read)
    -> std::optional<decltype(read(std::declval<std::istream&>(), std::string()))> {
    std::ifstream in(file, std::ios::binary);
    if (!in.is_open()) return std::nullopt;
    try {
        return read(in, file.string());
    } catch (const InputError&) {
        return std::nullopt;
    }
}

/// Calls write(file), in a folder that is made first. A plan that cannot be written is made again by the next
/// run.
template <typename Write>
void keep_if_possible(const std::filesystem::path& file, const Write& write) {
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    try {
        write(file);
    } catch (const FaultError&) {
    }
}

}  // namespace lamella
