// Gradients from four samples, projection by Newton's method, and cubes culled by bounds on the distance.
#include "procedural/skin/surface_walk.h"
#include "procedural/voronoi/rounding.h"

#include <array>

#include "engine/base/error.h"

namespace lamella {
namespace {

constexpr int max_steps = 8;

/// The corners of a tetrahedron around the origin.
constexpr std::array<std::array<double, 3>, 4> tetrahedron{
    {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};

/// Recursion over cubes that the surface may pass through.
struct SurfaceWalk {
    const Field& body;
    double margin;
    const std::function<bool(const LatticeCube&)>& divide;
    const std::function<void(const LatticeCube&)>& visit;

    void enter(const LatticeCube& cube) const {
        const Box box = cube.box();
        const double reach = 0.5 * diagonal(box) * rounding_margin + margin;
        if (std::abs(body.value_within(box.center(), 2 * reach)) > reach) return;
        if (!divide(cube)) return visit(cube);
        for (int octant = 0; octant < 8; ++octant) {
            enter({cube.index * std::int64_t{2} + glm::i64vec3(octant & 1, (octant >> 1) & 1, octant >> 2),
                   cube.side / 2});
        }
    }
};

}  // namespace

std::optional<dvec3> rising(const Field& body, dvec3 p, double step) {
    dvec3 slope(0);
    for (const auto& corner : tetrahedron) {
        const dvec3 way(corner[0], corner[1], corner[2]);
        slope += way * body.value(p + way * step);
    }
    const double length = std::sqrt(glm::dot(slope, slope));
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    return slope / length;
}

std::optional<SurfaceFoot> foot_on_surface(const Field& body, dvec3 p, double precision) {
    SurfaceFoot foot{p, {}};
    for (int step = 0; step < max_steps; ++step) {
        const double value = body.value(foot.place);
        const auto normal = rising(body, foot.place, precision);
        if (!normal || !std::isfinite(value)) return std::nullopt;
        foot.normal = *normal;
        if (std::abs(value) <= precision * 1e-3) return foot;
        foot.place -= *normal * value;
    }
    if (std::abs(body.value(foot.place)) > precision) return std::nullopt;
    return foot;
}

void walk_surface(const Field& body, double largest, double margin,
                  const std::function<bool(const LatticeCube&)>& divide,
                  const std::function<void(const LatticeCube&)>& visit) {
    const Box bounds = grown(body.bounds(), margin);
    if (bounds.empty() || !std::isfinite(diagonal(bounds)))
        throw InputError("a surface to put windows on needs a body of finite size");
    const auto index = [&](double v) { return static_cast<std::int64_t>(std::floor(v / largest)); };
    const glm::i64vec3 lo(index(bounds.lo.x), index(bounds.lo.y), index(bounds.lo.z));
    const glm::i64vec3 hi(index(bounds.hi.x), index(bounds.hi.y), index(bounds.hi.z));
    const SurfaceWalk walk{body, margin, divide, visit};
    for (std::int64_t k = lo.z; k <= hi.z; ++k) {
        for (std::int64_t j = lo.y; j <= hi.y; ++j) {
            for (std::int64_t i = lo.x; i <= hi.x; ++i) walk.enter({{i, j, k}, largest});
        }
    }
}

}  // namespace lamella
