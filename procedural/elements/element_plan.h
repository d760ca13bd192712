// ElementPlan: placed elements and what is known of them, and their file.
#pragma once

#include <filesystem>
#include <istream>
#include <ostream>
#include <vector>

#include "procedural/elements/element_pieces.h"

namespace lamella {

/// Elements as they were placed, and what is known of them. Compliances are 0 where no loads placed them.
struct ElementPlan {
    std::vector<PlacedElement> elements;
    std::vector<ElementBridge> bridges;
    std::size_t pieces = 0;              ///< before they were joined
    std::size_t moved = 0, dropped = 0;  ///< elements, to make one piece
    double volume = 0;                   ///< share of the body that they fill
    double compliance = 0;               ///< of their true shapes, N mm
    double full_compliance = 0;          ///< of the body as a solid, N mm
    double optimum = 0;                  ///< of the densities where the elements began, N mm
    double overlap = 0;                  ///< share of them that lies in others, where no loads placed them
    /// Of outlines that reach through a skin, mm at scale 1: the thinnest ones. Numbers of shapes count
    /// thicker ones, too: see skin_shapes().
    double thickness = 0;
};

/// Writes elements as lines of numbers that read back exactly: shape,x,y,z,qw,qx,qy,qz,scale. Places are in
/// mm; the quaternion turns the shape.
void write_elements(std::ostream& out, const std::vector<PlacedElement>& elements);

/// Writes a plan as write_complete_file() does: two lines of what is known, then elements, then bridges.
void write_element_plan(const std::filesystem::path& file, const ElementPlan& plan);

/// Reads what write_element_plan() writes. Throws InputError ("name: ...") for a file that is damaged or cut
/// off.
ElementPlan read_element_plan(std::istream& in, const std::string& name);

}  // namespace lamella
