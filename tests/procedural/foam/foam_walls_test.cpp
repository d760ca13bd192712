// Walls of lattices with known faces, and of random seeds against the faces that nearest seeds tell.
#include "procedural/foam/foam_walls.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "procedural/voronoi/counter_hash.h"
#include "tests/engine/field/gradings.h"
#include "tests/procedural/voronoi/cell_among.h"

namespace foam_walls_test {

using namespace lamella;
using lamella::test::cell_among;

namespace {

std::vector<Seed> cubic(int n) {
    std::vector<Seed> seeds;
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) seeds.push_back({dvec3(x, y, z), {0, seeds.size()}});
    return seeds;
}

std::vector<Seed> random_seeds(int count, std::int64_t sample) {
    std::vector<Seed> seeds;
    for (int i = 0; i < count; ++i) {
        const CounterHash hash(78, 0, i, sample, 0);
        seeds.push_back({4.0 * dvec3(hash.uniform(0), hash.uniform(1), hash.uniform(2)), {0, seeds.size()}});
    }
    return seeds;
}

std::vector<FoamPiece> pieces_of_list(const std::vector<Seed>& seeds, const WallSettings& walls,
                                      double beam) {
    std::vector<FoamPiece> pieces;
    VoronoiCell cell;
    WallMaker maker(BeamMaker(NodeRadius(beam)), walls);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        if (cell_among(seeds, i, 20, cell)) maker.append(cell, seeds[i], seeds, pieces);
    }
    return pieces;
}

std::vector<RoundTriangle> walls_in(const std::vector<FoamPiece>& pieces, const Box& box) {
    std::vector<RoundTriangle> walls;
    for (const FoamPiece& piece : pieces) {
        const auto* wall = std::get_if<RoundTriangle>(&piece);
        if (wall && box.contains(wall->corners[0]) && box.contains(wall->corners[1]) &&
            box.contains(wall->corners[2]))
            walls.push_back(*wall);
    }
    return walls;
}

std::vector<Beam> beams_of(const std::vector<FoamPiece>& pieces) {
    std::vector<Beam> beams;
    for (const FoamPiece& piece : pieces) {
        if (const auto* beam = std::get_if<Beam>(&piece)) beams.push_back(*beam);
    }
    return beams;
}

double area(const std::vector<RoundTriangle>& walls) {
    double sum = 0;
    for (const RoundTriangle& t : walls) {
        sum += 0.5 * glm::length(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]));
    }
    return sum;
}

WallSettings walls(double radius, Graded window = 0.0) { return {NodeRadius(radius), std::move(window), 0}; }

}  // namespace

TEST_CASE("a cubic lattice has the faces of its dual cubes, each walled once", "[foam_walls]") {
    // The cubes with corners 0.5 .. 3.5: three directions of 4 planes with 9 squares.
    const Box inside{dvec3(0.4), dvec3(3.6)};
    for (const bool graded : {false, true}) {
        WallSettings settings = walls(0.05);
        if (graded) settings.radius = {steady_function([](dvec3 p) { return 0.05 + 0.001 * p.x; }, 0.001), 1};
        CHECK(area(walls_in(pieces_of_list(cubic(5), settings, 0.1), inside)) == Approx(108));
    }
    for (const double open : {0.3, 0.8}) {
        const auto ring = walls_in(pieces_of_list(cubic(5), walls(0.05, open), 0.1), inside);
        CHECK(area(ring) == Approx(108 * (1 - open * open)));
    }
    CHECK(walls_in(pieces_of_list(cubic(5), walls(0.05, 1.0), 0.1), inside).empty());
    CHECK(walls_in(pieces_of_list(cubic(5), walls(0), 0.1), inside).empty());
}

TEST_CASE("a wall's edges are made only where they show", "[foam_walls]") {
    const auto seeds = random_seeds(60, 1);
    const std::size_t frame = beams_of(pieces_of_list(seeds, walls(0), 0.1)).size();
    // Beams that hold the walls' rims, and beams that do not.
    CHECK(beams_of(pieces_of_list(seeds, walls(0.1), 0.1)).size() == frame);
    CHECK(beams_of(pieces_of_list(seeds, walls(0.11), 0.1)).size() > 3 * frame);
    // A thickness that is linear in space has no crests; one with a ridge has.
    WallSettings linear = walls(0), ridged = walls(0);
    linear.radius = {steady_function([](dvec3 p) { return 0.3 + 0.01 * p.x; }, 0.01), 0.6};
    ridged.radius = {steady_function([](dvec3 p) { return 0.8 - 0.02 * std::abs(p.x - 2); }, 0.02), 0.9};
    CHECK(beams_of(pieces_of_list(seeds, linear, 1)).size() == frame);
    CHECK(beams_of(pieces_of_list(seeds, ridged, 1)).size() > frame);
}

TEST_CASE("walls hang on the beams' nodes, to the bit", "[foam_walls]") {
    const auto seeds = random_seeds(80, 2);
    const auto pieces = pieces_of_list(seeds, walls(0.05), 0.1);
    std::set<std::array<double, 3>> nodes;
    for (const Beam& beam : beams_of(pieces)) {
        nodes.insert({beam.a.x, beam.a.y, beam.a.z});
        nodes.insert({beam.b.x, beam.b.y, beam.b.z});
    }
    const auto fans = walls_in(pieces, {dvec3(0.5), dvec3(3.5)});
    CHECK(fans.size() > 200);
    for (const RoundTriangle& t : fans) {
        for (const dvec3& corner : t.corners) CHECK(nodes.count({corner.x, corner.y, corner.z}) == 1);
    }
}

TEST_CASE("walls with windows are solid where a face is, but for the face shrunk about its middle",
          "[foam_walls]") {
    constexpr double open = 0.6, radius = 0.01;
    const auto seeds = random_seeds(40, 3);
    const auto pieces = pieces_of_list(seeds, walls(radius, open), 0.011);
    const Box core{dvec3(1), dvec3(3)};
    /// The pair of nearest seeds of a point, and by how much the third is farther.
    struct Nearest {
        std::size_t first, second;
        double room;
    };
    const auto nearest = [&](dvec3 p) {
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t i = 0; i < seeds.size(); ++i)
            order.emplace_back(glm::distance(p, seeds[i].position), i);
        std::sort(order.begin(), order.end());
        return Nearest{std::min(order[0].second, order[1].second), std::max(order[0].second, order[1].second),
                       order[2].first - order[1].first};
    };
    const auto onto_face = [&](dvec3 p, std::size_t a, std::size_t b) {
        const dvec3 normal = glm::normalize(seeds[b].position - seeds[a].position);
        return p - normal * glm::dot(normal, p - (seeds[a].position + seeds[b].position) * 0.5);
    };
    // Points of the faces by rejection, gathered by face; their mean is the face's centroid.
    std::map<std::pair<std::size_t, std::size_t>, std::vector<dvec3>> faces;
    for (int i = 0; i < 400000; ++i) {
        const CounterHash hash(79, 0, i, 0, 0);
        const dvec3 p = core.lo + core.size() * dvec3(hash.uniform(0), hash.uniform(1), hash.uniform(2));
        const Nearest at = nearest(p);
        const dvec3 foot = onto_face(p, at.first, at.second);
        if (glm::distance(p, foot) > 0.02) continue;
        const Nearest on = nearest(foot);
        if (on.first == at.first && on.second == at.second) faces[{at.first, at.second}].push_back(foot);
    }
    int solid = 0, empty = 0;
    for (const auto& face : faces) {
        const auto pair = face.first;
        const std::vector<dvec3>& points = face.second;
        if (points.size() < 1200) continue;
        dvec3 middle(0);
        for (const dvec3& p : points) middle += p / static_cast<double>(points.size());
        // Faces that leave the box are known in part only: their middle is not that of their points.
        Box box;
        for (const dvec3& p : points) box.include(p);
        if (!Box{core.lo + 0.03, core.hi - 0.03}.contains(box.lo) ||
            !Box{core.lo + 0.03, core.hi - 0.03}.contains(box.hi))
            continue;
        for (std::size_t k = 0; k < points.size(); k += 5) {
            const dvec3 p = points[k];
            const auto in_face = [&](double share) {
                const Nearest at = nearest(onto_face(middle + (p - middle) / share, pair.first, pair.second));
                return at.first == pair.first && at.second == pair.second;
            };
            double value = infinity;
            for (const FoamPiece& piece : pieces) value = std::min(value, signed_distance(piece, p));
            if (in_face(open - 0.12)) {
                CHECK(value > 0);
                ++empty;
            } else if (!in_face(open + 0.1)) {
                CHECK(value <= 1e-9);
                ++solid;
            }
        }
    }
    CHECK(empty > 100);
    CHECK(solid > 100);
}

TEST_CASE("a window that its rim would close is not made", "[foam_walls]") {
    // The half widths of the squares are 0.5.
    const Box inside{dvec3(0.4), dvec3(3.6)};
    CHECK(area(walls_in(pieces_of_list(cubic(5), walls(0.1, 0.19), 0.2), inside)) == Approx(108));
    CHECK(area(walls_in(pieces_of_list(cubic(5), walls(0.1, 0.21), 0.2), inside)) < 107);
}

}  // namespace foam_walls_test
