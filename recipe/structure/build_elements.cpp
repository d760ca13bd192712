// One shape by its kind.
#include "recipe/structure/build_elements.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/base/error.h"
#include "engine/io/svg_outline.h"
#include "recipe/build/build_fields.h"

namespace lamella {

namespace {

ElementShapePtr field_shape_of(const ElementRecipe& element, Gradings& gradings) {
    for (const FieldRecipe& field : gradings.recipe().fields) {
        if (field.name != element.field) continue;
        std::optional<MeshReport> mesh;
        return make_field_shape(build_field(field, gradings, std::nullopt, mesh));
    }
    throw InputError(element.where + ".field: there is no [[field]] of that name");
}

}  // namespace

std::vector<std::vector<dvec2>> element_outline(const ElementRecipe& element) {
    constexpr double tolerance = 0.01;  // mm
    std::vector<std::vector<dvec2>> polygons(1);
    for (const auto& row : element.corners) polygons[0].emplace_back(row[0], row[1]);
    if (!element.file.empty()) polygons = read_svg_outlines(element.file, tolerance);
    Box bounds;
    for (const auto& polygon : polygons) {
        for (const dvec2 p : polygon) bounds.include(dvec3(p, 0));
    }
    const double longer = std::max(bounds.size().x, bounds.size().y);
    if (element.length > 0 && longer > 0) {
        for (auto& polygon : polygons) {
            for (dvec2& p : polygon) p *= element.length / longer;
        }
    }
    return polygons;
}

std::vector<ElementShapePtr> build_elements(const Recipe& recipe, std::optional<double> thickness,
                                            Gradings& gradings) {
    std::vector<ElementShapePtr> shapes;
    for (const ElementRecipe& element : recipe.element_shapes) {
        try {
            switch (element.kind) {
                case ElementKind::stick:
                    shapes.push_back(make_stick(element.length, element.width));
                    break;
                case ElementKind::ring:
                    shapes.push_back(make_ring(element.diameter, element.width));
                    break;
                case ElementKind::outline:
                    shapes.push_back(
                        make_outline(element_outline(element), thickness.value_or(element.thickness)));
                    break;
                case ElementKind::field:
                    shapes.push_back(field_shape_of(element, gradings));
                    break;
            }
        } catch (const InputError& error) {
            throw InputError(element.where + ": " + error.what());
        }
    }
    return shapes;
}

std::vector<ElementShapePtr> skin_shapes(const Recipe& recipe, double thickness, std::size_t steps,
                                         Gradings& gradings) {
    std::vector<ElementShapePtr> shapes = build_elements(recipe, thickness, gradings);
    for (std::size_t step = 1; step < steps; ++step) {
        thickness *= skin_step;
        for (std::size_t i = 0; i < recipe.element_shapes.size(); ++i) {
            const ElementRecipe& element = recipe.element_shapes[i];
            const bool is_outline = element.kind == ElementKind::outline;
            shapes.push_back(is_outline ? make_outline(element_outline(element), thickness) : shapes[i]);
        }
    }
    return shapes;
}

}  // namespace lamella
