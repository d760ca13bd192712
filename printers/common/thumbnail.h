// Thumbnails: scaling, padding and encoding of small pictures of a job.
#pragma once

#include <string>

#include "engine/base/picture.h"

namespace lamella {

/// Returns a smaller square version of a square picture. Each pixel is the mean of the area it covers.
Picture shrunk(const Picture& picture, int size);

/// Returns the picture centred in a larger one. The margins repeat the pixels of its edges.
Picture centred(const Picture& picture, int width, int height);

/// Encodes a picture as PNG, 8 bits per channel. `level` of compression: 1 is fast, 12 small.
std::string png_file(const Picture& picture, int level = 9);

/// Encodes a picture with two bytes per pixel, the higher first: five bits red, six green, five blue.
std::string rgb565(const Picture& picture);

}  // namespace lamella
