// A mesh for each shape and each bridge.
#include "recipe/structure/element_copies.h"

#include <algorithm>

#include "engine/base/error.h"
#include "procedural/elements/element_surface.h"
#include "recipe/structure/build_elements.h"
#include "recipe/structure/place_elements.h"

namespace lamella {

namespace {

constexpr double tolerance = 0.01;  // of meshes, mm

TriangleMesh stick_mesh(double length, double width, bool is_flat, double height) {
    if (is_flat) return outline_surface({stick_outline(length, width, tolerance)}, height);
    return stick_surface(length, width, tolerance);
}

TriangleMesh mesh_of(const ElementRecipe& element, bool is_flat, double height) {
    switch (element.kind) {
        case ElementKind::stick:
            return stick_mesh(element.length, element.width, is_flat, height);
        case ElementKind::ring:
            if (is_flat)
                return outline_surface(ring_outline(element.diameter, element.width, tolerance), height);
            return ring_surface(element.diameter, element.width, tolerance);
        case ElementKind::outline:
            return outline_surface(element_outline(element), is_flat ? height : element.thickness);
        case ElementKind::field:
            break;
    }
    throw InputError("a [[field]] is no mesh; accepted: csv, or another kind of element");
}

MeshCopy copy_of(const PlacedElement& element, double middle, bool is_flat) {
    // In a plate all are as high as the part, whatever their scale.
    const double up = is_flat ? 1 : element.scale;
    const dvec3 at(element.at.x, element.at.y, is_flat ? middle : element.at.z);
    return {element.shape, element.turn * dvec3(element.scale, 0, 0),
            element.turn * dvec3(0, element.scale, 0), element.turn * dvec3(0, 0, up), at};
}

}  // namespace

ElementCopies element_copies(const Recipe& recipe, const ElementPlan& plan, Interval heights) {
    if (has_skin_of_elements(recipe))
        throw InputError("elements of a skin bend with it, no two alike; accepted: csv");
    const bool is_flat = recipe.elements->dimensions == 2;
    ElementCopies made;
    for (const ElementRecipe& element : recipe.element_shapes) {
        try {
            made.meshes.push_back(mesh_of(element, is_flat, heights.width()));
        } catch (const InputError& error) {
            throw InputError(element.where + ": " + error.what());
        }
    }
    const double middle = 0.5 * (heights.lo + heights.hi);
    for (const PlacedElement& element : plan.elements)
        made.copies.push_back(copy_of(element, middle, is_flat));
    for (const ElementBridge& bridge : plan.bridges) {
        const double width = recipe.elements->bridge, length = bridge_length(bridge, width);
        PlacedElement rod = bridge_rod(bridge);
        rod.shape = static_cast<std::uint32_t>(made.meshes.size());
        made.meshes.push_back(stick_mesh(length, width, is_flat, heights.width()));
        made.copies.push_back(copy_of(rod, middle, is_flat));
    }
    return made;
}

}  // namespace lamella
