// Numbers drawn with single strokes for engravers, independent of the machine's fonts.
#pragma once

#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Returns the width and height of a number (>= 0) whose digits are `height` mm high, mm.
dvec2 number_size(int number, double height);

/// Returns the strokes of a number about a centre, y upwards, mm: open polylines, no stroke twice.
std::vector<std::vector<dvec2>> number_strokes(int number, dvec2 center, double height);

}  // namespace lamella
