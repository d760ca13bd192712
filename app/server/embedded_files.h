// Files that ship within the program.
#pragma once

#include <span>
#include <string_view>

namespace lamella {

struct EmbeddedFile {
    std::string_view name;  ///< without a folder
    std::string_view text;
};

/// Returns recipes to begin with, by name. Generated from files of examples/ when the program is built.
std::span<const EmbeddedFile> example_recipes();

/// Returns the description of the HTTP interface, openapi.json.
std::span<const EmbeddedFile> interface_files();

/// Returns the files of the studio's page; none when the program was built without it. Generated from
/// studio/dist.
std::span<const EmbeddedFile> page_files();

}  // namespace lamella
