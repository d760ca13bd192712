// Makes shapes in place; bounds and places formulas.
#include "recipe/build/build_fields.h"

#include <cmath>
#include <utility>

#include "engine/base/box_image.h"
#include "engine/base/error.h"
#include "engine/base/whole_file.h"
#include "engine/formula/formula_field.h"
#include "engine/formula/formula_vm.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "procedural/volume/volumetric_model.h"
#include "procedural/voronoi/stretch.h"
#include "recipe/result_dependents.h"

namespace lamella {

namespace {

FieldPtr placed(FieldPtr solid, const Placement& place) {
    if (place.axes == glm::dmat3(1) && place.at == dvec3(0)) return solid;
    return make_transform(std::move(solid), place.axes, place.at);
}

template <Shape shape>
FieldPtr shape_field(const FieldBuildContext& making) {
    const FieldRecipe& field = making.recipe;
    return make_shape(shape, {field.radius, field.size, field.height, field.tube}, making.place);
}

FieldPtr mesh_field(const FieldBuildContext& making) {
    const FieldRecipe& field = making.recipe;
    return read_solid({field.file, field.unit, field.scale, making.place}, making.report,
                      making.gradings.inputs());
}

/// Bounds a formula's inside by the recipe's box, or else the box around the part, or else the result of a
/// search.
FieldPtr bounded(const FieldBuildContext& making, GradedFormula formula) {
    Box bounds;
    if (!making.recipe.bounds.empty()) {
        for (const auto& corner : making.recipe.bounds) bounds.include({corner[0], corner[1], corner[2]});
    } else if (making.within) {
        const glm::dmat3 back = glm::transpose(making.place.axes);
        bounds = image_of(*making.within, back, -(back * making.place.at));
    } else {
        bounds = formula_bounds(formula.formula, formula.others);
    }
    return placed(make_formula_field(formula.formula, std::move(formula.others), bounds), making.place);
}

FieldPtr formula_field(const FieldBuildContext& making) {
    return bounded(making, making.gradings.formula_of(making.recipe.formula));
}

FieldPtr vm_field(const FieldBuildContext& making) {
    const std::string& file = making.recipe.file;
    return bounded(making, {read_vm(whole_file(file, "a .vm file"), file), {}});
}

FieldPtr package_field(const FieldBuildContext& making) {
    const FieldRecipe& field = making.recipe;
    if (!field.function.empty() && !field.object.empty()) {
        throw InputError(field.where +
                         ".object: cannot be combined with a function; accepted: object or function");
    }
    VolumetricModel model(field.file);
    if (!field.function.empty()) {
        PlacedFormula function = model.function(field.function);
        return bounded(making, {std::move(function.formula), std::move(function.others)});
    }
    if (!field.bounds.empty()) {
        throw InputError(
            field.where +
            ".bounds: objects have their own bounds; accepted: bounds only together with a function");
    }
    return placed(field.object.empty() ? model.built() : model.object(field.object), making.place);
}

FieldPtr host_field(const FieldBuildContext& making) {
    return placed(making.recipe.host.pointer, making.place);
}

}  // namespace

glm::dmat3 exact_axes(dvec3 degrees) {
    // Rotation by right angles yields 1e-17 instead of 0, which would prevent the closed forms of
    // axis-parallel shapes.
    constexpr double rounding = 1e-15;
    glm::dmat3 axes = turned_axes(degrees);
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            double& entry = axes[column][row];
            if (std::abs(entry) < rounding) entry = 0;
        }
    }
    return axes;
}

std::span<const FieldBuilder> field_builders() {
    static const std::vector<FieldBuilder> list{
        {{"formula", {"formula"}, {"bounds", "at", "turn"}}, formula_field},
        {{"vm", {"file"}, {"bounds", "at", "turn"}}, vm_field},
        {{"mesh", {"file"}, {"unit", "scale", "at", "turn"}}, mesh_field},
        {{"3mf", {"file"}, {"object", "function", "bounds", "at", "turn"}}, package_field},
        {{std::string(host_kind), {}, {"at", "turn"}}, host_field},
        {{std::string(optimized_kind), {}, {}},
         [](const FieldBuildContext& making) {
             return placed(making.gradings.result().dense, making.place);
         }},
        {{"sphere", {"radius"}, {"at"}}, shape_field<Shape::sphere>},
        {{"box", {"size"}, {"at", "turn"}}, shape_field<Shape::box>},
        {{"cylinder", {"radius", "height"}, {"at", "turn"}}, shape_field<Shape::cylinder>},
        {{"capsule", {"radius", "height"}, {"at", "turn"}}, shape_field<Shape::capsule>},
        {{"torus", {"radius", "tube"}, {"at", "turn"}}, shape_field<Shape::torus>}};
    return list;
}

FieldPtr build_field(const FieldRecipe& field, Gradings& gradings, const std::optional<Box>& within,
                     std::optional<MeshReport>& report, const glm::dmat3& axes) {
    for (const FieldBuilder& builder : field_builders()) {
        if (builder.kind.word != field.kind) continue;
        const Placement place{axes * exact_axes(field.turn), axes * field.at};
        return builder.make({field, gradings, within, place, report});
    }
    throw InputError(field.where + ": kind " + field.kind + " is unknown");
}

FieldPtr make_shape(Shape shape, const ShapeSizes& sizes, const Placement& place) {
    const dvec3 half = sizes.size / 2.0;
    const dvec3 end = place.axes * dvec3(0, 0, sizes.height / 2);
    const bool upright = place.axes == glm::dmat3(1);
    switch (shape) {
        case Shape::sphere:
            return make_sphere(place.at, sizes.radius);
        case Shape::box:
            return upright ? make_box(Box{place.at - half, place.at + half})
                           : make_turned_box(Box{-half, half}, place.axes, place.at);
        case Shape::cylinder:
            return make_cylinder(place.at - end, place.at + end, sizes.radius);
        case Shape::capsule: {
            const dvec3 ball = place.axes * dvec3(0, 0, sizes.height / 2 - sizes.radius);
            return make_round_cone({place.at - ball, sizes.radius, place.at + ball, sizes.radius});
        }
        case Shape::torus:
            return upright ? make_torus(place.at, sizes.radius, sizes.tube)
                           : make_turned_torus(sizes.radius, sizes.tube, place.axes, place.at);
        case Shape::gyroid:
        case Shape::none:
            break;
    }
    throw InputError("this shape cannot be made from sizes");
}

}  // namespace lamella
