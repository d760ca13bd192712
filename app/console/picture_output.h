// Writes pictures to files that appear when complete.
#pragma once

#include <string>

#include "engine/base/picture.h"

namespace lamella {

/// Throws InputError, beginning with the option's name, for a file whose ending is no format of pictures.
void check_is_picture(const std::string& option, const std::string& path);

/// Writes a picture in the format of the file's ending. Throws FaultError when this fails.
void write_picture(const std::string& path, const Picture& picture);

}  // namespace lamella
