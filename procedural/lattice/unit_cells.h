// Unit cells: named lists of the struts that a lattice repeats in each of its cells.
#pragma once

#include <string_view>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// A straight strut between two points of the unit cube [0, 1]^3.
struct Strut {
    dvec3 a;
    dvec3 b;
    friend bool operator==(const Strut&, const Strut&) = default;
};

/// Returns the struts of a named cell. Struts on the cube's border are listed once for each cell that shares
/// them, so they appear on all its sides. "cubic": the 12 edges. "bcc": the 8 half diagonals of the cube.
/// "fcc": the 24 half diagonals of the faces. "octet": fcc and the 12 edges of the octahedron of the faces'
/// centres (Deshpande, Fleck and Ashby, J. Mech. Phys. Solids 49, 2001). Throws InputError with this list for
/// another name.
std::vector<Strut> unit_cell(std::string_view name);

/// Minimum length of a strut, in cells.
inline constexpr double min_strut = 1e-3;

/// Throws InputError for an empty list, more than 64 struts, a strut shorter than min_strut, or one outside
/// the unit cube.
void check_unit_cell(const std::vector<Strut>& struts);

}  // namespace lamella
