// Loads on a skin of finite elements.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "procedural/elasticity/elastic_solver.h"
#include "procedural/pattern/skin_elements.h"

namespace lamella {

/// An elastic body and the load cases on it. Lengths are in edges of an element, and the solid's modulus
/// is 1.
struct LoadedSkin {
    ElasticBody<3> body;
    std::vector<NodalVector<3, double>> cases;
};

/// Makes the loads on a skin, given how much of each element is solid, from 0 to 1, x fastest; elements with
/// 0 are not in the body.
using SkinLoads = std::function<LoadedSkin(const SkinElements& elements, std::span<const float> shares)>;

/// Returns a skin that is squeezed along x, along y and along z by forces on its outermost twentieths, and
/// one that stands under its own weight on its lowest twentieth. Forces are made to balance, as those of a
/// body that floats freely (inertia relief); nodes are held only against rigid motions. Elements that hang
/// together by corners and edges alone, or not at all, are left out, but the largest piece.
LoadedSkin squeezed_skin(const SkinElements& elements, std::span<const float> shares);

}  // namespace lamella
