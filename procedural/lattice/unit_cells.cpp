// The named cells, built from corners and face centres, and the check of a list.
#include "procedural/lattice/unit_cells.h"

#include <fmt/format.h>

#include "engine/base/error.h"

namespace lamella {
namespace {

constexpr std::size_t max_struts = 64;

dvec3 corner(int i) { return dvec3(i & 1, (i >> 1) & 1, i >> 2); }

/// Returns the centre of the face at the lower (0) or upper (1) end of an axis.
dvec3 face_center(int axis, int end) {
    dvec3 p(0.5);
    p[axis] = end;
    return p;
}

std::vector<Strut> cubic() {
    std::vector<Strut> struts;
    for (int i = 0; i < 8; ++i) {
        for (const int bit : {1, 2, 4}) {
            if ((i & bit) == 0) struts.push_back({corner(i), corner(i | bit)});
        }
    }
    return struts;
}

std::vector<Strut> bcc() {
    std::vector<Strut> struts;
    struts.reserve(8);
    for (int i = 0; i < 8; ++i) struts.push_back({dvec3(0.5), corner(i)});
    return struts;
}

std::vector<Strut> fcc() {
    std::vector<Strut> struts;
    for (int axis = 0; axis < 3; ++axis) {
        for (const int end : {0, 1}) {
            for (int i = 0; i < 8; ++i) {
                if (((i >> axis) & 1) == end) struts.push_back({face_center(axis, end), corner(i)});
            }
        }
    }
    return struts;
}

std::vector<Strut> octet() {
    std::vector<Strut> struts = fcc();
    for (int axis = 0; axis < 3; ++axis) {
        for (int end = 0; end < 4; ++end) {
            struts.push_back({face_center(axis, end & 1), face_center((axis + 1) % 3, end >> 1)});
        }
    }
    return struts;
}

bool in_unit_cube(dvec3 p) { return Box{dvec3(0), dvec3(1)}.contains(p); }

}  // namespace

std::vector<Strut> unit_cell(std::string_view name) {
    if (name == "cubic") return cubic();
    if (name == "bcc") return bcc();
    if (name == "fcc") return fcc();
    if (name == "octet") return octet();
    throw InputError(fmt::format("there is no unit cell \"{}\"; accepted: cubic, bcc, fcc, octet", name));
}

void check_unit_cell(const std::vector<Strut>& struts) {
    if (struts.empty()) throw InputError("the unit cell has no struts; give at least one");
    if (struts.size() > max_struts) {
        throw InputError(
            fmt::format("the unit cell has {} struts; accepted: at most {}", struts.size(), max_struts));
    }
    for (std::size_t i = 0; i < struts.size(); ++i) {
        const Strut& s = struts[i];
        const auto text = [&] {
            return fmt::format("strut {} of the unit cell, ({}, {}, {}) to ({}, {}, {}),", i + 1, s.a.x,
                               s.a.y, s.a.z, s.b.x, s.b.y, s.b.z);
        };
        if (!in_unit_cube(s.a) || !in_unit_cube(s.b)) {
            throw InputError(text() + " leaves the unit cube; accepted: coordinates from 0 to 1");
        }
        const dvec3 way = s.b - s.a;
        if (glm::dot(way, way) < min_strut * min_strut) {
            throw InputError(text() + fmt::format(" has no length; accepted: {} or more", min_strut));
        }
    }
}

}  // namespace lamella
