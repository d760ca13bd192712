// Bodies made of boxes, as mesh files for recipes.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// An OBJ file of boxes, each closed in itself; where they overlap they are one body.
inline std::string boxes_obj(const std::vector<Box>& boxes) {
    std::string text;
    int first = 1;
    for (const Box& box : boxes) {
        for (int k = 0; k < 8; ++k) {
            text += fmt::format("v {} {} {}\n", k & 1 ? box.hi.x : box.lo.x, k & 2 ? box.hi.y : box.lo.y,
                                k & 4 ? box.hi.z : box.lo.z);
        }
        for (const auto& face :
             {"0231", "4576", "0154", "2673", "0462", "1375"}) {  // counter-clockwise from outside
            text += "f";
            for (int k = 0; k < 4; ++k) text += fmt::format(" {}", first + face[k] - '0');
            text += "\n";
        }
        first += 8;
    }
    return text;
}

/// A table top of 20 x 20 x 2 mm on a column of 5 x 5 mm, 12 mm high in all.
inline std::vector<Box> table() {
    return {{{-2.5, -2.5, 0}, {2.5, 2.5, 11}}, {{-10, -10, 10}, {10, 10, 12}}};
}

}  // namespace lamella
