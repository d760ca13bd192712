// Recipe: everything that decides a print, as plain data. The settings table (settings.h) says what is
// allowed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/geometry.h"
#include "printers/profile.h"

namespace lamella {

/// A body with a closed form, centred at the origin. `none`: the body is a mesh.
enum class Shape : unsigned char { none, sphere, box, cylinder, capsule, torus, gyroid };

/// What one unit of a mesh file is, for formats that do not say.
enum class LengthUnit : unsigned char { mm, cm, m, inch };

struct PartRecipe {
    std::string mesh;  ///< path of the mesh file; empty when a shape is asked for
    Shape shape = Shape::none;
    double radius = 0;     ///< sphere, cylinder, capsule; of the torus its centre circle, mm
    dvec3 size{0};         ///< box and gyroid, mm
    double height = 0;     ///< cylinder and capsule, end to end, mm
    double tube = 0;       ///< torus, radius of the tube, mm
    double period = 0;     ///< gyroid, mm
    double thickness = 0;  ///< gyroid, of the sheet, mm
    LengthUnit unit = LengthUnit::mm;
    double scale = 1;
    std::string name;  ///< empty: taken from the input
};

struct FoamRecipe {
    double cell = 0;        ///< mean cell diameter, mm
    double beam = 0;        ///< radius of the beams, mm
    std::int64_t seed = 1;  ///< of the random draws
};

struct SkinRecipe {
    double thickness = 0;  ///< mm, inward from the surface
};

/// Without foam and skin the part is solid; with foam alone it is bare foam cut by the body; with a skin
/// alone it is a hollow shell.
struct Recipe {
    PartRecipe part;
    std::optional<FoamRecipe> foam;
    std::optional<SkinRecipe> skin;
    double layer_height = 0.05;  ///< mm
    PrinterProfile printer;
};

/// Length of one unit, mm.
double millimetres(LengthUnit unit);

}  // namespace lamella
