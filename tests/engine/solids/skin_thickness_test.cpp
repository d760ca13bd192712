// The thickness of skins on real models, against the distance to every triangle, asked of the runs
// themselves.
#include <catch2/catch.hpp>
#include <random>

#include "engine/field/slice_context.h"
#include "engine/io/mesh_reader.h"
#include "engine/mesh/mesh_field.h"
#include "engine/mesh/mesh_repair.h"
#include "engine/mesh/triangle_tree.h"
#include "engine/solids/shell.h"
#include "tests/engine/field/gradings.h"

namespace skin_thickness_test {

using namespace lamella;

namespace {

constexpr double pitch = 0.025;
constexpr double half_sample = pitch / 2;

SolidMesh model(const std::string& name) {
    const std::string path = std::string(LAMELLA_SOURCE_DIR) + "/" + name;
    return close_mesh(read_mesh(path).mesh, path);
}

/// Points on the surface, evenly by area, each with its triangle's outward unit normal.
struct SurfacePointAndNormal {
    dvec3 place;
    dvec3 normal;
};
class Surface {
  public:
    explicit Surface(const TriangleMesh& mesh) : mesh_(mesh) {
        for (const auto& t : mesh.triangles) {
            const dvec3 n = glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
            sums_.push_back((sums_.empty() ? 0 : sums_.back()) + glm::length(n));
        }
    }
    SurfacePointAndNormal draw(std::mt19937& random) const {
        std::uniform_real_distribution<double> share(0, 1);
        const auto found = std::upper_bound(sums_.begin(), sums_.end() - 1, share(random) * sums_.back());
        const auto& t = mesh_.triangles[static_cast<std::size_t>(found - sums_.begin())];
        double a = share(random), b = share(random);
        if (a + b > 1) a = 1 - a, b = 1 - b;
        const dvec3 u = corner(t, 1) - corner(t, 0), v = corner(t, 2) - corner(t, 0);
        return {corner(t, 0) + u * a + v * b, glm::normalize(glm::cross(u, v))};
    }

  private:
    dvec3 corner(const std::array<std::uint32_t, 3>& t, std::size_t k) const { return mesh_.vertices[t[k]]; }
    const TriangleMesh& mesh_;
    std::vector<double> sums_;
};

/// The distance to the nearest of all triangles, one by one.
double brute_distance(const TriangleMesh& mesh, dvec3 p) {
    double least = infinity;
    for (const auto& t : mesh.triangles) {
        // What the corners' spheres leave out cannot be nearer.
        const dvec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
        const dvec3 off =
            glm::max(glm::max(glm::min(a, glm::min(b, c)) - p, p - glm::max(a, glm::max(b, c))), dvec3(0));
        if (glm::dot(off, off) >= least * least) continue;
        least = std::min(least, closest_point(p, a, b, c).distance);
    }
    return least;
}

/// Whether the triangles wind round a point: the sum of the signs of their crossings with the ray towards +x.
bool brute_inside(const TriangleMesh& mesh, dvec3 p) {
    int winding = 0;
    for (const auto& t : mesh.triangles) {
        const dvec3 a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p, c = mesh.vertices[t[2]] - p;
        const double u = b.y * c.z - b.z * c.y, v = c.y * a.z - c.z * a.y, w = a.y * b.z - a.z * b.y;
        const bool positive = u > 0 && v > 0 && w > 0, negative = u < 0 && v < 0 && w < 0;
        if ((positive || negative) && (u * a.x + v * b.x + w * c.x) * (u + v + w) > 0)
            winding += positive ? 1 : -1;
    }
    return winding != 0;
}

/// Whether the runs of the line through a point, in its own slice, hold the point.
bool solid_at(const Field& field, dvec3 p, Axis axis) {
    const double along = axis == Axis::x ? p.x : p.y, across = axis == Axis::x ? p.y : p.x;
    // The point lies in the middle of a pixel, and its line on it.
    const RowBand band{axis, along - 2.5 * pitch, pitch, across - pitch / 2, pitch, 0, 1, 1, 0, 5};
    SliceContext context;
    Scratch scratch;
    RunRows rows;
    context.slice(field, p.z).runs(band, scratch, rows);
    const int u = 5 * run_unit / 2;
    for (const Run& run : rows.line(0)) {
        if (run.begin <= u && u < run.end) return true;
    }
    return false;
}

struct Counts {
    std::size_t straight = 0;  ///< probes whose depth is the true distance
    std::size_t creased = 0;   ///< ... and those that some other place of the surface is nearer to
    std::size_t wrong = 0;
};

/// Probes at depths about a skin's thickness below (or above) random points of the surface. A probe is judged
/// by its true distance and side, so creases and thin parts count as they should.
Counts probe(const SolidMesh& solid, double thickness, SkinSide side, std::size_t points, unsigned seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    const FieldPtr skin = make_filled_body(make_mesh_field(solid), nullptr, thickness, side);
    const double inner = side == SkinSide::inside    ? thickness
                         : side == SkinSide::centred ? thickness / 2
                                                     : 0,
                 outer = thickness - inner;
    const Surface surface(solid.mesh);
    Counts counts;
    for (std::size_t k = 0; k < points; ++k) {
        const auto [place, normal] = surface.draw(random);
        const bool inward = side == SkinSide::inside || (side == SkinSide::centred && k % 2 == 0);
        const double t = inward ? inner : outer;
        // Just short of the thickness, just beyond it, and anywhere up to twice as deep.
        const double depths[] = {t - 1.02 * half_sample, t + 1.02 * half_sample, 2 * t * share(random)};
        const double depth = depths[k % 3];
        const dvec3 p = place + normal * (inward ? -depth : depth);
        const double distance = brute_distance(solid.mesh, p);
        const bool inside = brute_inside(solid.mesh, p);
        const double reach = inside ? inner : outer;
        if (std::abs(distance - reach) < half_sample || distance < half_sample) continue;
        (std::abs(distance - depth) < 1e-9 ? counts.straight : counts.creased) += 1;
        const bool expected = distance < reach;
        if (solid_at(*skin, p, k % 2 == 0 ? Axis::x : Axis::y) != expected) {
            ++counts.wrong;
            UNSCOPED_INFO("at " << p.x << ", " << p.y << ", " << p.z << ": distance " << distance
                                << (inside ? " inside" : " outside"));
        }
    }
    return counts;
}

const char* const models[] = {"examples/models/koala_mm.obj", "tests/models/good/fish_mm.obj",
                              "tests/models/good/featuretype.stl"};

}  // namespace

TEST_CASE("a skin is solid to its thickness and not beyond, at 10,000 points of three models") {
    for (const char* name : models) {
        const SolidMesh solid = model(name);
        const dvec3 size = solid.mesh.bounds().size();
        const double thickness = std::min(size.x, std::min(size.y, size.z)) / 20;
        unsigned seed = 100;
        for (const SkinSide side : {SkinSide::inside, SkinSide::outside, SkinSide::centred}) {
            INFO(name << ", side " << static_cast<int>(side) << ", thickness " << thickness);
            const std::size_t points = side == SkinSide::inside ? 10'000 : 2'000;
            const Counts counts = probe(solid, thickness, side, points, ++seed);
            CHECK(counts.wrong == 0);
            CHECK(counts.straight > points / 4);
            CHECK(counts.creased > points / 50);
        }
    }
}

TEST_CASE("a skin thicker than the part fills it and goes no farther") {
    for (const char* name : models) {
        const SolidMesh solid = model(name);
        const dvec3 size = solid.mesh.bounds().size();
        const double thickness = std::min(size.x, std::min(size.y, size.z)) / 2.5;
        INFO(name << ", thickness " << thickness);
        constexpr std::size_t points = 500;
        const Counts counts = probe(solid, thickness, SkinSide::inside, points, 200);
        CHECK(counts.wrong == 0);
        CHECK(counts.creased > points / 4);
    }
}

}  // namespace skin_thickness_test
