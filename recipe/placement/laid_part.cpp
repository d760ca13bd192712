// A mesh is turned vertex by vertex, as a recipe's is, and given to the job as a field of the host.
#include "recipe/placement/laid_part.h"

#include <utility>

#include "engine/mesh/mesh_field.h"
#include "recipe/build/build_supports.h"
#include "recipe/placement/part_placement.h"
#include "recipe/recipe_kinds.h"

namespace lamella {

LaidPart::LaidPart(const Recipe& recipe) {
    recipe_.part = recipe.part;
    recipe_.part.lay_on = recipe_.part.turn = dvec3(0);
    recipe_.fields = recipe.fields;
    recipe_.gradings = recipe.gradings;
    recipe_.layers.height = recipe.layers.height;
    recipe_.printer = recipe.printer;
    recipe_.support = recipe.support == SupportKind::none ? SupportKind::pillars : recipe.support;
    const PartRecipe& part = recipe_.part;
    if (part.mesh.empty()) return;
    std::optional<MeshReport> report;
    mesh_ = read_closed_mesh({part.mesh, part.unit, part.scale, {part_axes(part), {}}}, report);
}

FieldPtr LaidPart::body(dvec3 lay_on) const {
    PartRecipe part = recipe_.part;
    const glm::dmat3 mirror = part_axes(part);
    part.lay_on = lay_on;
    const glm::dmat3 axes = part_axes(part);
    if (mesh_) {
        SolidMesh turned = *mesh_;
        for (dvec3& vertex : turned.mesh.vertices) vertex = axes * glm::transpose(mirror) * vertex;
        return make_mesh_field(std::move(turned));
    }
    Gradings gradings(recipe_);
    std::optional<MeshReport> report;
    return build_body(recipe_, gradings, report, axes);
}

double LaidPart::support_volume(dvec3 lay_on, int threads, const CancelToken* cancel) const {
    Recipe recipe = recipe_;
    if (mesh_) {
        FieldRecipe& field = recipe.fields.emplace_back();
        field.name = "laid part";
        field.kind = host_kind;
        field.host.pointer = body(lay_on);
        recipe.part = PartRecipe();
        recipe.part.field = field.name;
    } else {
        recipe.part.lay_on = lay_on;
    }
    BuiltJob built = build_job(recipe, {.threads = threads, .cancel = cancel});
    SupportOptions planning;
    planning.plans.clear();
    planning.threads = threads;
    planning.cancel = cancel;
    add_supports(recipe, built, planning);
    return lamella::support_volume(built.job);
}

}  // namespace lamella
