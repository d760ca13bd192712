// Pictures of a job as files carry them: small, in given sizes.
#pragma once

#include <string>

#include "engine/base/picture.h"

namespace lamella {

/// A smaller square of a square picture: each pixel the mean of what it covers.
Picture shrunk(const Picture& picture, int size);

/// The picture in the middle of a larger one, its edges drawn on to the sides.
Picture centred(const Picture& picture, int width, int height);

/// A PNG file of 8 bits a channel.
std::string png_file(const Picture& picture);

/// Two bytes a pixel, the higher first: five bits of red, six of green, five of blue.
std::string rgb565(const Picture& picture);

}  // namespace lamella
