// The foam with walls as a field: solid where nearest seeds say so, cells sealed or joined through windows.
#include "procedural/foam/closed_foam.h"

#include <catch2/catch.hpp>
#include <map>
#include <numeric>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "procedural/foam/voronoi_foam.h"
#include "procedural/voronoi/counter_hash.h"
#include "tests/engine/field/gradings.h"

namespace closed_foam_test {

using namespace lamella;

namespace {

ClosedFoamSettings settings(Graded wall, Graded window = 0.0, double beam = 0.08, double cell = 1.5) {
    ClosedFoamSettings s;
    s.foam.cell = cell;
    s.foam.beam_radius = beam;
    s.foam.seed = 17;
    s.foam.region = {dvec3(0), dvec3(6)};
    s.wall = std::move(wall);
    s.window = std::move(window);
    return s;
}

dvec3 random_point(const Box& box, std::int64_t i) {
    const CounterHash hash(24, 0, i, 0, 0);
    return box.lo + box.size() * dvec3(hash.uniform(0), hash.uniform(1), hash.uniform(2));
}

Graded sloping_wall() {
    return steady_function([](dvec3 p) { return std::max(0.0, 0.12 * (p.x - 1.5)); }, 0.12);
}

Graded rising_window() {
    return steady_function([](dvec3 p) { return std::min(1.0, std::max(0.0, p.y / 5)); }, 0.2);
}

/// The foam on a cubic lattice of `n` points a side, read off the runs.
std::vector<bool> voxels(const Field& foam, int n, double pitch) {
    const auto side = static_cast<std::size_t>(n);
    std::vector<bool> solid(side * side * side);
    Scratch scratch;
    RunRows rows;
    for (int z = 0; z < n; ++z) {
        SliceContext context;
        const RowBand band{Axis::x, 0, pitch, 0, pitch, 0, n, 1, 0, n};
        context.slice(foam, (z + 0.5) * pitch).runs(band, scratch, rows);
        for (int y = 0; y < n; ++y) {
            for (const Run& run : rows.line(static_cast<std::size_t>(y))) {
                // A voxel is solid where its row is over at least half of it.
                for (int x = (run.begin + 128) / 256; x < (run.end + 128) / 256; ++x) {
                    solid[(static_cast<std::size_t>(z) * side + static_cast<std::size_t>(y)) * side +
                          static_cast<std::size_t>(x)] = true;
                }
            }
        }
    }
    return solid;
}

/// The voids of a voxel lattice that touch face to face, by size.
std::vector<int> voids(const std::vector<bool>& solid, int n) {
    std::vector<std::size_t> parent(solid.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto find = [&](std::size_t v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    const auto side = static_cast<std::size_t>(n);
    for (std::size_t v = 0; v < solid.size(); ++v) {
        if (solid[v]) continue;
        const std::size_t x = v % side, y = v / side % side, z = v / side / side;
        if (x > 0 && !solid[v - 1]) parent[find(v)] = find(v - 1);
        if (y > 0 && !solid[v - side]) parent[find(v)] = find(v - side);
        if (z > 0 && !solid[v - side * side]) parent[find(v)] = find(v - side * side);
    }
    std::map<std::size_t, int> sizes;
    for (std::size_t v = 0; v < solid.size(); ++v) {
        if (!solid[v]) ++sizes[find(v)];
    }
    std::vector<int> sorted;
    for (const auto& [root, size] : sizes) sorted.push_back(size);
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    return sorted;
}

}  // namespace

TEST_CASE("a closed foam is solid within half a wall of a face, and empty where all bisectors are far",
          "[closed_foam]") {
    constexpr double wall = 0.16, beam = 0.08;
    const ClosedFoam foam(settings(wall, 0.0, beam));
    const VoronoiFoam open(settings(wall, 0.0, beam).foam);
    const Box box{dvec3(1), dvec3(5)};
    const auto seeds = open.seeds_in(grown(box, 4));
    int solid = 0, empty = 0;
    for (int i = 0; i < 6000; ++i) {
        const dvec3 p = random_point(box, i);
        const auto own = std::min_element(seeds.begin(), seeds.end(), [&](const Seed& a, const Seed& b) {
            return glm::distance(p, a.position) < glm::distance(p, b.position);
        });
        double nearest = infinity;
        bool on_face = false;
        for (const Seed& other : seeds) {
            if (&other == &*own) continue;
            const dvec3 between = other.position - own->position,
                        middle = (own->position + other.position) * 0.5;
            const dvec3 normal = between / glm::length(between);
            const double height = glm::dot(normal, middle - p);
            nearest = std::min(nearest, height);
            // The foot on the bisector is a point of the face when no third seed is nearer to it.
            const dvec3 foot = p + normal * height;
            const bool of_face = std::none_of(seeds.begin(), seeds.end(), [&](const Seed& third) {
                return &third != &other && &third != &*own &&
                       glm::distance(foot, third.position) < glm::distance(foot, other.position);
            });
            on_face = on_face || (of_face && height < wall / 2 - 1e-9);
        }
        const double value = foam.value(p);
        if (on_face) REQUIRE(value < 0);
        if (nearest > std::max(wall / 2, beam) + 1e-9) REQUIRE(value > 0);
        // The nearest face gives the distance itself.
        if (nearest > std::max(wall / 2, beam) + 1e-9) REQUIRE(value >= nearest - wall / 2 - 1e-9);
        solid += on_face;
        empty += nearest > std::max(wall / 2, beam);
    }
    CHECK(solid > 1000);
    CHECK(empty > 1500);
}

TEST_CASE("the value is the least over all pieces, and the open foam is a part of it", "[closed_foam]") {
    for (const ClosedFoamSettings& s :
         {settings(0.1), settings(0.1, 0.5), settings(sloping_wall(), rising_window())}) {
        const ClosedFoam foam(s);
        const VoronoiFoam open(s.foam);
        const Box box{dvec3(0.5), dvec3(3.5)};
        const auto pieces = foam.pieces_touching(grown(box, 3));
        for (int i = 0; i < 300; ++i) {
            const dvec3 p = random_point(box, i);
            double expected = infinity;
            for (const FoamPiece& piece : pieces) expected = std::min(expected, signed_distance(piece, p));
            REQUIRE(foam.value(p) == expected);
            REQUIRE(foam.value(p) <= open.value(p));
        }
        const Interval range = foam.range(box);
        for (int i = 0; i < 100; ++i) CHECK(range.contains(foam.value(random_point(box, i))));
        CHECK(std::isnan(foam.value({std::nan(""), 0, 0})));
    }
}

TEST_CASE("a foam without walls, or with windows all over, is the open foam", "[closed_foam]") {
    for (const ClosedFoamSettings& s : {settings(0.0), settings(0.1, 1.0)}) {
        const ClosedFoam foam(s);
        const VoronoiFoam open(s.foam);
        for (int i = 0; i < 300; ++i) {
            const dvec3 p = random_point(foam.bounds(), i);
            REQUIRE(foam.value(p) == open.value(p));
        }
    }
}

TEST_CASE("the runs of a foam with walls are solid exactly where its value is negative", "[closed_foam]") {
    Scratch scratch;
    for (const ClosedFoamSettings& s :
         {settings(0.15), settings(0.15, 0.5), settings(0.3, 0.4, 0.03), settings(sloping_wall()),
          settings(sloping_wall(), rising_window(), 0.04)}) {
        const ClosedFoam foam(s);
        int solid = 0;
        for (int layer = 0; layer < 6; ++layer) {
            const double z = 0.31 + 0.9 * layer;
            SliceContext context;
            const RowBand band{layer % 2 == 0 ? Axis::x : Axis::y, 0, 0.03, 0.01, 0.21, 0, 28, 1, 0, 200};
            RunRows rows;
            context.slice(foam, z).runs(band, scratch, rows);
            for (int k = 0; k < 700; ++k) {
                const CounterHash hash(25, 0, k, layer, 0);
                const int l = static_cast<int>(28 * hash.uniform(0));
                const double u = std::floor(200 * 256 * hash.uniform(1)) + 0.5;
                const double along = band.along(u), across = band.line(l);
                const dvec3 p = band.axis == Axis::x ? dvec3(along, across, z) : dvec3(across, along, z);
                const double v = foam.value(p);
                if (std::abs(v) < 5e-4) continue;
                bool in_run = false;
                for (const Run& run : rows.line(static_cast<std::size_t>(l))) {
                    in_run = in_run || (run.begin <= u && u < run.end);
                }
                INFO("layer " << layer << ", " << p.x << ", " << p.y << ", " << p.z << ", value " << v);
                REQUIRE(in_run == (v < 0));
                solid += v < 0;
            }
        }
        CHECK(solid > 300);
    }
}

TEST_CASE("closed cells are sealed, and windows join them all", "[closed_foam]") {
    constexpr int n = 120;
    constexpr double pitch = 0.05;
    // Walls of three voxels seal; 6 mm hold 4 x 4 x 4 cells and what the border cuts.
    const auto sealed = voids(voxels(ClosedFoam(settings(0.16)), n, pitch), n);
    CHECK(sealed.size() > 64);
    CHECK(sealed.size() < 220);
    const int total = std::accumulate(sealed.begin(), sealed.end(), 0);
    CHECK(sealed.front() < total / 20);
    const auto joined = voids(voxels(ClosedFoam(settings(0.16, 0.6)), n, pitch), n);
    CHECK(joined.front() > 0.97 * std::accumulate(joined.begin(), joined.end(), 0));
}

TEST_CASE("the solid of thin walls is their area times their thickness", "[closed_foam]") {
    constexpr double wall = 0.02;
    const ClosedFoam foam(settings(wall, 0.0, 0.001));
    double area = 0;
    const Box box{dvec3(0.5), dvec3(5.5)};
    // Walls that the box cuts are cut by dense sampling of their triangles.
    for (const FoamPiece& piece : foam.pieces_touching(box)) {
        const auto* t = std::get_if<RoundTriangle>(&piece);
        if (!t) continue;
        const dvec3 u = t->corners[1] - t->corners[0], v = t->corners[2] - t->corners[0];
        int in = 0;
        constexpr int samples = 400;
        for (int k = 0; k < samples; ++k) {
            const CounterHash hash(26, 0, k, 0, 0);
            double a = hash.uniform(0), b = hash.uniform(1);
            if (a + b > 1) a = 1 - a, b = 1 - b;
            in += box.contains(t->corners[0] + u * a + v * b);
        }
        area += 0.5 * glm::length(glm::cross(u, v)) * in / samples;
    }
    int solid = 0;
    constexpr int samples = 150000;
    for (int i = 0; i < samples; ++i) solid += foam.value(random_point(box, i)) < 0;
    // Walls overlap along the edges, by a share of about the thickness over the cell.
    CHECK(125.0 * solid / samples == Approx(area * wall).epsilon(0.05));
    // 2.91 (cell volume)^(2/3) of face area a cell belongs to each cell of a Poisson foam; jittered seeds
    // have a little less.
    CHECK(area / 125 * 1.5 == Approx(2.8).epsilon(0.1));
}

TEST_CASE("the foam with walls does not depend on the region, the cache or the order of questions",
          "[closed_foam]") {
    ClosedFoamSettings wide = settings(0.12, 0.4), small = settings(0.12, 0.4);
    wide.foam.region = {dvec3(-20), dvec3(20)};
    small.foam.cache_bytes = 0;
    const ClosedFoam a(wide), b(small), c(settings(0.12, 0.4));
    const Box box{{1, 2, 3}, {4, 5, 4}}, other{{2, 2, 0}, {3, 6, 4}};
    const auto first = a.pieces_touching(box);
    CHECK(first.size() > 500);
    CHECK(first == b.pieces_touching(box));
    c.pieces_touching(other);
    CHECK(first == c.pieces_touching(box));
    for (int i = 0; i < 20; ++i) {
        const dvec3 p = random_point(box, i);
        CHECK(a.value(p) == b.value(p));
    }
    Scratch scratch;
    RunRows whole, part;
    SliceContext context;
    const SliceField& slice = context.slice(c, 2.2);
    RowBand band{Axis::x, 0, 0.03, 0, 0.03, 0, 200, 1, 0, 200};
    slice.runs(band, scratch, whole);
    band.count = 20;
    for (band.first = 0; band.first < 200; band.first += 20) {
        slice.runs(band, scratch, part);
        for (std::size_t l = 0; l < 20; ++l) {
            const auto got = part.line(l), expected = whole.line(static_cast<std::size_t>(band.first) + l);
            REQUIRE(std::equal(got.begin(), got.end(), expected.begin(), expected.end()));
        }
    }
}

TEST_CASE("growing a foam with walls shifts its value", "[closed_foam]") {
    for (const double window : {0.0, 0.5}) {
        const ClosedFoam foam(settings(0.12, window));
        const FieldPtr thicker = foam.offset(0.07);
        REQUIRE(thicker);
        for (int i = 0; i < 200; ++i) {
            const dvec3 p = random_point(foam.bounds(), i);
            CHECK(thicker->value(p) == Approx(foam.value(p) - 0.07).margin(1e-12));
        }
        CHECK(foam.offset(-0.1) == nullptr);
    }
}

TEST_CASE("walls and windows out of range are refused with a sentence", "[closed_foam]") {
    CHECK_THROWS_AS(ClosedFoam(settings(-0.1)), InputError);
    CHECK_THROWS_AS(ClosedFoam(settings(std::nan(""))), InputError);
    CHECK_THROWS_AS(ClosedFoam(settings(infinity)), InputError);
    CHECK_THROWS_AS(ClosedFoam(settings(0.1, -0.1)), InputError);
    CHECK_THROWS_AS(ClosedFoam(settings(0.1, 1.1)), InputError);
    CHECK_THROWS_AS(ClosedFoam(settings(0.1, std::nan(""))), InputError);
    const Graded unknown = steady_function([](dvec3 p) { return p.x > 3 ? std::nan("") : 0.1; }, infinity);
    CHECK_THROWS_AS(ClosedFoam(settings(unknown)), InputError);
    CHECK_THROWS_AS(ClosedFoam(settings(0.1, unknown)), InputError);
    CHECK_THROWS_WITH(ClosedFoam(settings(1.4)), Catch::Contains("at most 1.35 mm"));
    CHECK(make_closed_foam(settings(0.1))->metric() == Metric::bound);
}

}  // namespace closed_foam_test
