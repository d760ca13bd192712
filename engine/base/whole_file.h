// Reads a file into memory.
#pragma once

#include <string>
#include <string_view>

namespace lamella {

/// Returns the bytes of a file. Throws InputError when it is a folder (`expected` names what it should be: "a
/// mesh file") or cannot be opened, FaultError when reading fails.
std::string whole_file(const std::string& path, std::string_view expected);

}  // namespace lamella
