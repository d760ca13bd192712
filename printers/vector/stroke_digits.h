// Numbers as single strokes: what an engraver follows, for fonts differ from machine to machine.
#pragma once

#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Width and height of a number (>= 0) whose digits are `height` mm high, mm.
dvec2 number_size(int number, double height);

/// The strokes of a number about a centre, y upwards, mm: open polylines, none drawn twice.
std::vector<std::vector<dvec2>> number_strokes(int number, dvec2 center, double height);

}  // namespace lamella
