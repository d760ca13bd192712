// Discrete elements, as plain data: the shapes of which a part has copies, and how they are placed.
#pragma once

#include <string>

#include "recipe/graded_number.h"
#include "recipe/number_rows.h"

namespace lamella {

enum class ElementKind : unsigned char { stick, ring, outline, field };

/// A shape of which the part has copies; which copy gets which shape is left to chance.
struct ElementRecipe {
    std::string where;  ///< where the entry begins, for messages
    ElementKind kind = ElementKind::stick;
    double length = 0;     ///< of a stick; of an outline the longer side, 0: as it is given; mm
    double diameter = 0;   ///< of a ring, outside, mm
    double width = 0;      ///< of a stick, or of a ring's tube, mm
    NumberRows corners;    ///< of an outline, mm; empty: from the file
    std::string file;      ///< path of an SVG drawing with an outline
    double thickness = 0;  ///< of an outline, mm; on a skin that of the skin
    std::string field;     ///< name of a [[field]], whose origin is the middle of the copies
};

/// How copies are placed: such that they bear the loads, or evenly where there are none.
struct ElementsRecipe {
    int count = 100;
    double scale_min = 1, scale_max = 1;
    double overlap = 0.3;  ///< share of the copies' volume that lies in others or outside the body, at most
    bool turns = true;     ///< whether copies may turn
    GradedTriple along{};  ///< direction of the copies' x axis; 0: any
    GradedNumber density{1.0, ""};  ///< relative number of copies where no loads place them
    std::string example;            ///< path of a list of copies, after which others are spread
    std::int64_t seed = 1;
    double element = 0;  ///< edge of the finite elements, mm; 0: a third of the thinnest shape
    int dimensions = 3;  ///< 2: a plate in the xy plane, of prisms as high as the part
    int iterations = 100;
    double reach = 0;   ///< widest gap over which loose copies are joined, mm; 0: the thinnest shape
    double bridge = 0;  ///< width of bridges that join them, mm; 0: they are moved
};

}  // namespace lamella
