// Elements spread evenly over a body or a surface, where no loads say where they have to be.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/cancel_token.h"
#include "procedural/elements/element_shape.h"
#include "procedural/elements/placed_element.h"

namespace lamella {

/// Points that stand for parts of a body or of its surface, over which elements are spread.
struct SpreadSites {
    double spacing = 1;           ///< mean distance of neighbours, mm
    bool is_flat = false;         ///< the body is a plate: elements turn about z only
    std::vector<dvec3> places{};  ///< mm
    /// Of a surface, in whose tangent planes elements lie with their xy plane; empty in a body.
    std::vector<dvec3> normals{};
    std::vector<double> sizes{};      ///< of their parts, relative
    std::vector<double> densities{};  ///< relative number of elements in parts of one size; at least 0
    /// Of the x axis of elements, unit vectors, tangents of a surface, by site. May be empty in a body:
    /// elements are as their shapes are given, or at random.
    std::vector<dvec3> ways{};

    std::size_t size() const { return places.size(); }
};

struct SpreadSettings {
    std::size_t count = 100;
    Interval scale{1, 1};     ///< limits of the scales, which are drawn evenly
    bool is_aligned = false;  ///< x axes follow the ways of the sites
    bool turns = true;        ///< turned at random about what is left free; false: as the ways or shapes are
    int rounds = 100;         ///< at most; fewer where nothing moves any more
    /// Elements whose shapes, scales and turns are taken, each as often as the others; may be empty. They are
    /// turned in the xy plane of a surface's tangent frame, or about z in a plate, and with the ways.
    std::span<const PlacedElement> example{};
    double variation = 0;  ///< spacing_variation() at which rounds end
    std::uint64_t seed = 1;
    const CancelToken* cancel = nullptr;  ///< may be null
};

/// Spreads elements such that their number follows the densities: by Lloyd's method, each element goes to the
/// centroid of the sites that are nearest to it, distances being measured in the halves of its shape's box,
/// so that long elements leave each other room at their ends; with an example, from middle to middle. Such
/// centroids are as dense as the weights of the sites to the power d / (d + 2) in d dimensions (Gersho 1979,
/// "Asymptotically optimal block quantization"), for which weights are higher powers. Each element gets a
/// shape at random, or that of an example, whose spacing may be as uneven. The same on any number of threads.
/// Throws InputError if all densities are 0, Interrupted when cancelled.
std::vector<PlacedElement> spread_elements(const SpreadSites& sites, std::span<const ElementShapePtr> shapes,
                                           const SpreadSettings& settings);

/// What elements cover of sites.
struct SpreadCover {
    double share = 0;    ///< of the sites that lie in an element
    double overlap = 0;  ///< share of the elements that lies in others
};
/// Adds the sizes of the sites in elements. Those whose normals point to the other side do not count.
SpreadCover cover_of(const SpreadSites& sites, std::span<const PlacedElement> elements,
                     std::span<const ElementShapePtr> shapes);

}  // namespace lamella
