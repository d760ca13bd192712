// Makes the body: shapes at the origin, fields looked up by name; both are scaled.
#include "recipe/build/build_body.h"

#include "engine/base/error.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "procedural/lattice/tpms.h"

namespace lamella {

namespace {

FieldPtr gyroid_block(const Box& block, double period, double thickness) {
    TpmsSettings settings;
    settings.period = make_constant_grading(period);
    settings.thickness = make_constant_grading(thickness);
    settings.region = block;
    return make_intersection({make_box(block), make_tpms(settings)});
}

FieldPtr shape_body(const PartRecipe& part, const glm::dmat3& axes) {
    const double k = part.scale;
    if (part.shape == Shape::none) {
        throw InputError("part: no body is given; accepted: a mesh file, a shape or a field");
    }
    if (part.shape == Shape::gyroid) {
        const dvec3 half = part.size * (k / 2);
        FieldPtr block = gyroid_block(Box{-half, half}, k * part.period, k * part.thickness);
        return axes == glm::dmat3(1) ? block : make_transform(std::move(block), axes, dvec3(0));
    }
    return make_shape(part.shape, {k * part.radius, k * part.size, k * part.height, k * part.tube},
                      {axes, {}});
}

FieldPtr named_body(const Recipe& recipe, Gradings& gradings, std::optional<MeshReport>& report,
                    const glm::dmat3& axes) {
    for (const FieldRecipe& field : recipe.fields) {
        if (field.name != recipe.part.field) continue;
        FieldPtr body = build_field(field, gradings, std::nullopt, report, axes);
        const double k = recipe.part.scale;
        return k == 1 ? body : make_transform(std::move(body), glm::dmat3(k), dvec3(0));
    }
    throw InputError("part.field: no [[field]] is named \"" + recipe.part.field + "\"");
}

}  // namespace

FieldPtr build_body(const Recipe& recipe, Gradings& gradings, std::optional<MeshReport>& report,
                    const glm::dmat3& axes) {
    const PartRecipe& part = recipe.part;
    if (!part.mesh.empty())
        return read_solid({part.mesh, part.unit, part.scale, {axes, {}}}, report, gradings.inputs());
    return part.field.empty() ? shape_body(part, axes) : named_body(recipe, gradings, report, axes);
}

}  // namespace lamella
