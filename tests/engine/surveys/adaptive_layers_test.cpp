// Layers that adapt: cusps by closed forms and by the triangles of real models, counts by exhaustive search.
#include "engine/surveys/adaptive_layers.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "engine/io/mesh_reader.h"
#include "engine/mesh/mesh_field.h"
#include "engine/mesh/mesh_repair.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace adaptive_layers_test {

using namespace lamella;

namespace {

SlopeProfile slopes(const FieldPtr& solid, const AdaptiveLimits& limits, int threads = 0) {
    SlopeSurveyOptions options;
    options.step = limits.least / 2;
    options.pitch = std::max(solid->bounds().size().x, solid->bounds().size().y) / 256;
    options.threads = threads;
    return survey_slopes(solid, solid->bounds(), options);
}

LayerPlan layers_of(const FieldPtr& solid, const AdaptiveLimits& limits) {
    return adapt_layers(slopes(solid, limits), limits, 0, solid->bounds().size().z);
}

/// The largest cusp, where `flattest` is the greatest |z| of the normals between two heights over the bottom.
double cusp_by(const LayerPlan& layers, const std::function<double(double, double)>& flattest) {
    double most = 0;
    for (int i = 0; i < layers.count(); ++i)
        most = std::max(most, layers.height(i) * flattest(layers.bottom(i), layers.top(i)));
    return most;
}

/// The greatest |z| of the normals of triangles that reach into the space between two heights. Those that lie
/// level count where they are farther than a grain from both.
double flattest_triangle(const TriangleMesh& mesh, double bottom, double low, double high, double grain) {
    double most = 0;
    for (const auto& triangle : mesh.triangles) {
        const dvec3 a = mesh.vertices[triangle[0]], b = mesh.vertices[triangle[1]],
                    c = mesh.vertices[triangle[2]];
        const double least = std::min({a.z, b.z, c.z}) - bottom,
                     greatest = std::max({a.z, b.z, c.z}) - bottom;
        if (greatest <= low + grain || least >= high - grain) continue;
        const dvec3 normal = cross(b - a, c - a);
        const double length = glm::length(normal);
        if (length > 0) most = std::max(most, std::abs(normal.z) / length);
    }
    return most;
}

TriangleMesh model(const std::string& file) {
    return read_mesh(std::string(LAMELLA_SOURCE_DIR) + "/tests/models/good/" + file, {}).mesh;
}

}  // namespace

TEST_CASE("cusps on a ball and an ellipsoid stay within what was asked, by closed forms", "[adaptive]") {
    const AdaptiveLimits limits{0.05, 0.4, 0.06};
    const double a = 12, c = GENERATE(12.0, 7.0);
    glm::dmat3 squeeze(1);
    squeeze[2][2] = c / a;
    const FieldPtr solid = make_transform(make_sphere({0, 0, 0}, a), squeeze, dvec3(0));
    const LayerPlan layers = layers_of(solid, limits);
    const auto flatness = [&](double height) {
        const double z = height - c, across = a * std::sqrt(std::max(0.0, 1 - z * z / (c * c)));
        return std::abs(z) / (c * c) / std::hypot(across / (a * a), z / (c * c));
    };
    const double cusp = cusp_by(layers, [&](double low, double high) {
        return std::max(flatness(low), flatness(std::min(high, 2 * c)));
    });
    CHECK(cusp <= limits.cusp * 1.01);
    CHECK(layers.total() >= 2 * c - 1e-9);
    CHECK(layers.total() < 2 * c + limits.least);
    CHECK(layers.least_height() >= limits.least - 1e-9);
    CHECK(layers.greatest_height() <= limits.most + 1e-9);
    // Equal layers of such a cusp are as high as the cusp.
    CHECK(layers.count() < 0.75 * 2 * c / limits.cusp);
}

TEST_CASE("cusps on real models stay within what was asked, by their triangles", "[adaptive]") {
    const AdaptiveLimits limits{0.1, 0.3, 0.1};
    const std::string file = GENERATE("fish_mm.obj", "plate_holes.stl", "sphere_20mm.stl");
    INFO(file);
    const TriangleMesh mesh = model(file);
    const FieldPtr solid = make_mesh_field(close_mesh(mesh));
    const LayerPlan layers = layers_of(solid, limits);
    const double bottom = solid->bounds().lo.z, height = solid->bounds().size().z;
    constexpr double grain = 0.005;
    const double cusp = cusp_by(
        layers, [&](double low, double high) { return flattest_triangle(mesh, bottom, low, high, grain); });
    CHECK(cusp <= limits.cusp * 1.02);
    CHECK(layers.count() < height / limits.cusp);
    CHECK(std::abs(layers.total() - height) < limits.least);
}

TEST_CASE("layers end at level faces, and are as high as may be between", "[adaptive]") {
    const FieldPtr stairs =
        make_union({make_box({{0, 0, 0}, {30, 10, 1.23}}), make_box({{0, 0, 0}, {20, 10, 2.71}}),
                    make_box({{0, 0, 0}, {10, 10, 5}})});
    const AdaptiveLimits limits{0.1, 0.3, 0.05};
    const SlopeProfile profile = slopes(stairs, limits);
    REQUIRE(profile.levels.size() >= 3);
    const LayerPlan layers = adapt_layers(profile, limits, 0, 5);
    for (const double face : {1.23, 2.71, 5.0}) {
        double nearest = 1;
        for (int i = 0; i < layers.count(); ++i) nearest = std::min(nearest, std::abs(layers.top(i) - face));
        CHECK(nearest <= 0.0025 + 1e-9);
    }
    // 1.23, 1.48 and 2.29 mm in layers of 0.3 mm at most.
    CHECK(layers.count() == 5 + 5 + 8);
    CHECK(greatest_cusp(profile, layers, 0) < 1e-6);
}

TEST_CASE("no plan has fewer layers, nor less excess where none holds the limit", "[adaptive]") {
    std::mt19937_64 random(11);
    for (int round = 0; round < 200; ++round) {
        SlopeProfile profile;
        profile.step = 0.005;
        const int slabs = std::uniform_int_distribution(8, 24)(random);
        double flat = 0.5;
        for (int i = 0; i < slabs; ++i) {
            flat = std::clamp(flat + std::uniform_real_distribution(-0.4, 0.4)(random), 0.0, 0.95);
            profile.flattest.push_back(flat);
        }
        if (round % 2 == 0)
            profile.levels.push_back(0.001 * std::uniform_int_distribution(1, 5 * slabs - 1)(random));
        const AdaptiveLimits limits{0.01, 0.03, 0.012};
        const double top = 0.005 * slabs;
        const LayerPlan layers = adapt_layers(profile, limits, 0, top);
        // Exhaustively: the fewest layers in whole micrometres within the limit, or none.
        constexpr int never = 1 << 20;
        const int end = 5 * slabs;
        std::vector<int> fewest(static_cast<std::size_t>(end) + 1, never);
        fewest[0] = 0;
        for (int from = 0; from < end; ++from) {
            for (int height = 10; height <= 30 && from + height <= end; ++height) {
                const double low = 0.001 * from, high = 0.001 * (from + height);
                double most = 0;
                for (int i = 0; i < slabs; ++i) {
                    if (0.005 * i < high - 1e-9 && 0.005 * (i + 1) > low + 1e-9)
                        most = std::max(most, profile.flattest[static_cast<std::size_t>(i)]);
                }
                for (const double level : profile.levels)
                    if (level > low + 5e-4 && level < high - 5e-4) most = 1;
                if (0.001 * height * most > limits.cusp + 1e-9) continue;
                int& best = fewest[static_cast<std::size_t>(from + height)];
                best = std::min(best, fewest[static_cast<std::size_t>(from)] + 1);
            }
        }
        if (fewest.back() < never) {
            CHECK(layers.count() == fewest.back());
            CHECK(layers.total() == Approx(top));
            CHECK(greatest_cusp(profile, layers, 0) <= limits.cusp + 1e-9);
        } else {
            CHECK((greatest_cusp(profile, layers, 0) > limits.cusp || layers.total() > top + 1e-9));
        }
    }
}

TEST_CASE("where even the least height is too much, it is taken", "[adaptive]") {
    const AdaptiveLimits limits{0.1, 0.3, 0.02};
    const LayerPlan layers = layers_of(make_sphere({0, 0, 0}, 3), limits);
    CHECK(layers.height(0) == Approx(0.1));
    CHECK(layers.height(layers.count() - 1) == Approx(0.1));
    CHECK(layers.greatest_height() > 0.15);
}

TEST_CASE("threads change no slope", "[adaptive]") {
    const FieldPtr solid = make_mesh_field(close_mesh(model("fish_mm.obj")));
    const AdaptiveLimits limits;
    const SlopeProfile one = slopes(solid, limits, 1), four = slopes(solid, limits, 4);
    CHECK(one.flattest == four.flattest);
    CHECK(one.levels == four.levels);
}

}  // namespace adaptive_layers_test
