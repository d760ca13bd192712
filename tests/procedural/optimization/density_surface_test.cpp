// The surface of densities: closed, on the level, and as large as the shape.
#include "procedural/optimization/density_surface.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/mesh/mesh_field.h"
#include "recipe/build/build_fields.h"

namespace density_surface_test {

using namespace lamella;

namespace {

/// Densities that are linear in the distance from a ball, 0.5 on it; elements of 1 mm.
DensityGrid ball(int n, dvec3 middle, double radius) {
    DensityGrid grid{{n, n, n}, {}, {}};
    grid.density.resize(grid.place({0, 0, n}));
    for (std::size_t i = 0; i < grid.density.size(); ++i) {
        const dvec3 centre = dvec3(grid.element(i)) + 0.5;
        grid.density[i] = std::clamp(0.5 + 0.2 * (radius - length(centre - middle)), 0.0, 1.0);
    }
    return grid;
}

}  // namespace

TEST_CASE("the surface of a ball's densities is closed, and distances from it are the ball's",
          "[optimization]") {
    constexpr int n = 20;
    const dvec3 middle(10.3, 9.8, 10.1);
    constexpr double radius = 7;
    const TriangleMesh mesh = density_surface(ball(n, middle, radius), Box{dvec3(0), dvec3(n)}, 0.5, 2);
    const SolidMesh solid = close_mesh(mesh);
    CHECK(solid.caps == 0);
    CHECK(solid.oriented_manifold);
    CHECK(solid.notes.empty());
    DensityGrid grid = ball(n, middle, radius);
    grid.use.assign(grid.density.size(), ElementUse::free);
    CHECK(enclosed_volume(mesh) == Approx(solid_volume(grid, 0.5) * n * n * n).epsilon(0.005));
    const FieldPtr field = make_mesh_field(solid);
    for (const dvec3 way : {dvec3(1, 0, 0), dvec3(0, -0.6, 0.8), dvec3(-0.48, 0.6, 0.64)}) {
        for (const double from : {-5.0, -2.0, -0.5, 0.5, 2.0})
            CHECK(field->value(middle + way * (radius + from)) == Approx(from).margin(0.05));
    }
}

TEST_CASE("a surface that reaches the box goes on beyond it, and a plate is a prism", "[optimization]") {
    DensityGrid half{{8, 6, 1}, {}, {}};
    half.density.resize(half.place({0, 0, 1}));
    for (std::size_t i = 0; i < half.density.size(); ++i)
        half.density[i] = half.element(i).x < 4 ? 0.55 : 0.45;
    const TriangleMesh mesh = density_surface(half, Box{dvec3(0), dvec3(16, 12, 3)}, 0.5, 2);
    const SolidMesh solid = close_mesh(mesh);
    CHECK(solid.oriented_manifold);
    const FieldPtr field = make_mesh_field(solid);
    for (double y = 0; y <= 12; y += 1.5) {
        for (double z = 0; z <= 3; z += 0.75) {
            CHECK(field->value({7.9, y, z}) < 0);
            CHECK(field->value({-0.5, y, z}) < 0);  // a quarter of an element beyond the box
            CHECK(field->value({8.1, y, z}) > 0);
        }
    }
    half.density.assign(half.density.size(), 0.0);
    CHECK(density_surface(half, Box{dvec3(0), dvec3(16, 12, 3)}, 0.5, 2).triangles.empty());
}

}  // namespace density_surface_test
