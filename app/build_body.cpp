// Meshes are read and closed, shapes are placed at the origin, formulas are given a box.
#include "app/build_body.h"

#include "engine/csg.h"
#include "engine/error.h"
#include "engine/formula_field.h"
#include "engine/formula_vm.h"
#include "engine/mesh_field.h"
#include "engine/mesh_reader.h"
#include "engine/mesh_repair.h"
#include "engine/primitives.h"
#include "engine/whole_file.h"
#include "procedural/tpms.h"

namespace lamella {

namespace {

void scale_mesh(TriangleMesh& mesh, double factor) {
    for (dvec3& vertex : mesh.vertices) vertex *= factor;
}

FieldPtr mesh_body(const PartRecipe& part, std::optional<MeshReport>& report) {
    MeshReadOptions options;
    options.unit_mm = millimetres(part.unit);
    MeshFile file = read_mesh(part.mesh, options);
    if (part.scale != 1) scale_mesh(file.mesh, part.scale);
    MeshReport& found = report.emplace();
    found.path = part.mesh;
    found.notes = std::move(file.notes);
    SolidMesh solid = close_mesh(std::move(file.mesh), part.mesh);
    found.vertices = solid.mesh.vertices.size();
    found.triangles = solid.mesh.triangles.size();
    found.caps = solid.caps;
    found.oriented_manifold = solid.oriented_manifold;
    found.volume = enclosed_volume(solid.mesh);
    found.notes.insert(found.notes.end(), solid.notes.begin(), solid.notes.end());
    return make_mesh_field(std::move(solid));
}

FieldPtr gyroid_block(const Box& block, double period, double thickness) {
    TpmsSettings settings;
    settings.period = make_constant_grading(period);
    settings.thickness = make_constant_grading(thickness);
    settings.region = block;
    return make_intersection({make_box(block), make_tpms(settings)});
}

FieldPtr shape_body(const PartRecipe& part) {
    const double k = part.scale;
    const double radius = k * part.radius;
    const dvec3 half = part.size * (k / 2);
    const dvec3 end{0, 0, k * part.height / 2};
    switch (part.shape) {
        case Shape::sphere:
            return make_sphere(dvec3(0), radius);
        case Shape::box:
            return make_box(Box{-half, half});
        case Shape::cylinder:
            return make_cylinder(-end, end, radius);
        case Shape::capsule: {
            const dvec3 ball = end - dvec3(0, 0, radius);
            return make_round_cone({-ball, radius, ball, radius});
        }
        case Shape::torus:
            return make_torus(dvec3(0), radius, k * part.tube);
        case Shape::gyroid:
            return gyroid_block(Box{-half, half}, k * part.period, k * part.thickness);
        case Shape::none:
            break;
    }
    throw InputError("part: no body is given; accepted: a mesh file, a shape or a field");
}

/// The inside of a formula within the box that the recipe gives, or that a search finds.
FieldPtr bounded(const FieldRecipe& field, GradedFormula formula) {
    Box bounds;
    for (const auto& corner : field.bounds) bounds.include({corner[0], corner[1], corner[2]});
    if (field.bounds.empty()) bounds = formula_bounds(formula.formula, formula.others);
    return make_formula_field(formula.formula, std::move(formula.others), bounds);
}

FieldPtr formula_body(const FieldRecipe& field, Gradings& gradings) {
    return bounded(field, gradings.formula_of(field.formula));
}

FieldPtr vm_body(const FieldRecipe& field, Gradings& /*gradings*/) {
    return bounded(field, {read_vm(whole_file(field.file, "a .vm file"), field.file), {}});
}

FieldPtr field_body(const FieldRecipe& field, Gradings& gradings) {
    for (const FieldBuilder& builder : field_builders()) {
        if (builder.kind.word == field.kind) return builder.make(field, gradings);
    }
    throw InputError(field.where + ": kind " + field.kind + " is unknown");
}

FieldPtr named_body(const Recipe& recipe, Gradings& gradings) {
    for (const FieldRecipe& field : recipe.fields) {
        if (field.name != recipe.part.field) continue;
        FieldPtr body = field_body(field, gradings);
        const double k = recipe.part.scale;
        return k == 1 ? body : make_transform(std::move(body), glm::dmat3(k), dvec3(0));
    }
    throw InputError("part.field: no [[field]] is named \"" + recipe.part.field + "\"");
}

}  // namespace

std::span<const FieldBuilder> field_builders() {
    static const std::vector<FieldBuilder> list{{{"formula", {"formula"}, {"bounds"}}, formula_body},
                                                {{"vm", {"file"}, {"bounds"}}, vm_body}};
    return list;
}

FieldPtr build_body(const Recipe& recipe, Gradings& gradings, std::optional<MeshReport>& report) {
    const PartRecipe& part = recipe.part;
    if (!part.mesh.empty()) return mesh_body(part, report);
    return part.field.empty() ? shape_body(part) : named_body(recipe, gradings);
}

double enclosed_volume(const TriangleMesh& mesh) {
    double six_volumes = 0;
    const dvec3 origin = mesh.vertices.empty() ? dvec3(0) : mesh.vertices.front();
    for (const auto& triangle : mesh.triangles) {
        const dvec3 a = mesh.vertices[triangle[0]] - origin;
        const dvec3 b = mesh.vertices[triangle[1]] - origin;
        const dvec3 c = mesh.vertices[triangle[2]] - origin;
        six_volumes += glm::dot(a, glm::cross(b, c));
    }
    return six_volumes / 6;
}

}  // namespace lamella
