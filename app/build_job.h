// From a recipe to a job: reads the mesh, builds the field graph, and looks up the back-end.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/recipe.h"
#include "engine/layer.h"
#include "engine/mesh.h"
#include "procedural/voronoi_foam.h"

namespace lamella {

/// What was found in the mesh file.
struct MeshReport {
    std::string path;
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t caps = 0;            ///< triangles added to close holes
    bool oriented_manifold = false;  ///< closed and consistently oriented
    double volume = 0;               ///< enclosed, mm^3
    std::vector<std::string> notes;  ///< what was mended or left out
};

struct BuiltJob {
    Job job;
    FieldPtr body;                            ///< the part's outside, without foam and skin
    std::shared_ptr<const VoronoiFoam> foam;  ///< null without foam
    std::optional<MeshReport> mesh;           ///< empty for shapes
};

/// Throws InputError when the mesh is unreadable or the part is empty.
BuiltJob build_job(const Recipe& recipe);

/// The foam of a recipe, cells filling at least the region.
std::shared_ptr<const VoronoiFoam> build_foam(const FoamRecipe& foam, const Box& region);

/// Signed volume that a closed mesh encloses, mm^3.
double enclosed_volume(const TriangleMesh& mesh);

}  // namespace lamella
