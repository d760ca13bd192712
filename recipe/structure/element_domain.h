// ElementDomain: a part as finite elements, for structural optimisation and analysis.
#pragma once

#include <vector>

#include "engine/base/cancel_token.h"
#include "procedural/optimization/density_map.h"
#include "recipe/build/build_regions.h"

namespace lamella {

/// A grid of elements that fits the body's sides; cubes, nearly. In two dimensions it is one layer of
/// elements in the xy plane, each as high as the body.
struct ElementDomain {
    int dimensions = 3;
    glm::ivec3 size{0};
    dvec3 edges{0};  ///< of an element, mm
    Box box;         ///< of the whole grid, mm
    std::vector<ElementUse> use;

    /// Number of elements that are not outside the body.
    std::size_t elements() const;
    double element_volume() const { return edges.x * edges.y * edges.z; }  ///< mm^3
    /// Return the shortest and longest edge among the dimensions, mm.
    double shortest_edge() const;
    double longest_edge() const;
    /// Returns the position of a node, mm; in two dimensions at half the body's height.
    dvec3 node(glm::ivec3 at) const;
    /// Returns the middle of an element, mm.
    dvec3 centre(glm::ivec3 at) const { return 0.5 * (node(at) + node(at + 1)); }
};

/// Divides the body into elements as [optimize] says: an element belongs to it if its centre does. Under an
/// overhang limit, which goes by steps of elements, they are cubes, and the grid may miss the body's sides by
/// up to a quarter of an element. Regions that are solid or empty, and a skin, prescribe elements. Throws
/// InputError when the body has no element or the elements need more memory than the machine has, Interrupted
/// when cancelled.
ElementDomain element_domain(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                             const CancelToken* cancel);

/// Returns the same body on another grid with the same middle, of elements `ratio` times as wide; in the
/// plane as high.
ElementDomain element_domain_of(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                                const ElementDomain& domain, glm::ivec3 size, double ratio,
                                const CancelToken* cancel);

/// Returns the elements of a grid whose centres are inside a field; 1 for those.
std::vector<std::uint8_t> elements_inside(const Field& field, const ElementDomain& domain,
                                          const CancelToken* cancel);

}  // namespace lamella
