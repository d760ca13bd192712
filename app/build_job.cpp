// The glue between the recipe and the libraries: the only file of the app that makes fields.
#include "app/build_job.h"

#include <fmt/format.h>

#include "app/identity.h"
#include "engine/csg.h"
#include "engine/error.h"
#include "engine/mesh_field.h"
#include "engine/mesh_reader.h"
#include "engine/mesh_repair.h"
#include "engine/primitives.h"
#include "engine/shell.h"
#include "procedural/tpms.h"

namespace lamella {

namespace {

constexpr int most_layers = 10'000'000;

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
    throw InputError("part: no body is given; accepted: a mesh file or a shape");
}

/// The body itself, or filled with foam and skin.
FieldPtr part_of(const FieldPtr& body, const FieldPtr& foam, const std::optional<SkinRecipe>& skin) {
    if (!foam && !skin) return body;
    try {
        return make_filled_body(body, foam, skin ? skin->thickness : 0);
    } catch (const InputError& error) {
        throw InputError(std::string("skin.thickness / --skin: ") + error.what() +
                         "; accepted: a mesh, or another shape than this one");
    }
}

int layers_of(const Box& bounds, double layer_height) {
    const double height = bounds.size().z;
    if (height / layer_height > most_layers) {
        throw InputError(
            fmt::format("layers.height / --layer-height: {} mm cuts a part of {} mm into more than {} "
                        "layers; accepted: {} mm or more",
                        layer_height, height, most_layers, height / most_layers));
    }
    return count_layers(height, layer_height);
}

}  // namespace

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

std::shared_ptr<const VoronoiFoam> build_foam(const FoamRecipe& foam, const Box& region) {
    FoamSettings settings;
    settings.cell = foam.cell;
    settings.beam_radius = foam.beam;
    settings.seed = static_cast<std::uint64_t>(foam.seed);
    settings.region = region;
    return make_voronoi_foam(settings);
}

BuiltJob build_job(const Recipe& recipe) {
    BuiltJob built;
    built.body = recipe.part.mesh.empty() ? shape_body(recipe.part) : mesh_body(recipe.part, built.mesh);
    Job& job = built.job;
    job.bounds = built.body->bounds();
    const std::string where = recipe.part.mesh.empty() ? "part" : recipe.part.mesh;
    if (job.bounds.empty()) throw InputError(where + ": the part is empty; a solid with a volume is needed");
    if (recipe.foam) built.foam = build_foam(*recipe.foam, job.bounds);
    job.part = part_of(built.body, built.foam, recipe.skin);
    job.name = recipe.part.name;
    job.layer_height = recipe.layer_height;
    job.layer_count = layers_of(job.bounds, recipe.layer_height);
    job.identity = job_identity(recipe);
    return built;
}

}  // namespace lamella
