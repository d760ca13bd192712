// Supports of real models: everything held, nothing in the part, less material than pillars and dense
// columns.
#include <catch2/catch.hpp>
#include <functional>

#include "engine/io/mesh_reader.h"
#include "engine/mesh/mesh_field.h"
#include "engine/mesh/mesh_repair.h"
#include "procedural/scaffold/scaffold_synthesis.h"
#include "tests/engine/surveys/overhang_scenes.h"
#include "tests/procedural/scaffold/part_walk.h"
#include "tests/procedural/scaffold/scaffold_walk.h"

namespace scaffold_models_test {

using namespace lamella;

namespace {

constexpr double layer_height = 0.2, pixel = 0.2;  // mm

/// A model that ships with the sources, scaled and then turned.
struct Model {
    const char* file;
    double scale = 1;
    glm::dmat3 turn{1};
    std::size_t min_points = 50;
};

FieldPtr part_of(const Model& model) {
    MeshFile file = read_mesh(std::string(LAMELLA_SOURCE_DIR) + "/" + model.file, MeshReadOptions{});
    for (dvec3& vertex : file.mesh.vertices) vertex = model.turn * (vertex * model.scale);
    return make_mesh_field(close_mesh(std::move(file.mesh)));
}

Scaffold built(const std::vector<SupportPoint>& points, const Field& part, bool bridges) {
    ScaffoldShape shape;
    shape.bed = part.bounds().lo.z;
    shape.layer_height = layer_height;
    shape.bridges = bridges;
    return build_scaffold(points, part, shape);
}

void check_model(const Model& model) {
    const FieldPtr part = part_of(model);
    const OverhangSurveyOptions options;
    const OverhangSurvey survey =
        survey_overhangs(scenes::job_of(part, part->bounds(), layer_height), options);
    CHECK(survey.points.size() >= model.min_points);
    const Scaffold bridges = built(survey.points, *part, true);
    const Scaffold pillars = built(survey.points, *part, false);

    const Box box = unite(part->bounds(), unite(make_scaffold_field(bridges)->bounds(),
                                                make_scaffold_field(pillars)->bounds()));
    const LayerGrid grid(grown(box, 5 * pixel), bridges.shape.bed, layer_height, pixel);
    const std::vector<LayerPicture> layers = pictures_of(*part, grid);
    std::vector<double> volumes;
    for (const Scaffold* scaffold : {&bridges, &pillars}) {
        INFO(model.file << ": " << survey.points.size() << " points, " << scaffold->bars.size() << " bars, "
                        << scaffold->pillars.size() << " pillars");
        CHECK(scaffold->unheld.empty());
        const ScaffoldFindings found = ScaffoldWalk(*scaffold, *part, grid, layers, 0.225).run();
        INFO(found.where);
        CHECK(found.hanging == 0);
        CHECK(found.loose_bars == 0);
        CHECK(found.floating == 0);
        CHECK(found.in_part == 0);
        CHECK(found.long_bars == 0);
        CHECK(found.not_reached == 0);
        volumes.push_back(found.volume);

        PartWalk walk(grid, layers, options.limits);
        const PartFindings hangs = walk.run(held_places(*scaffold));
        INFO("the part hangs at " << hangs.where);
        CHECK(hangs.hanging > 100);
        CHECK(hangs.unheld == 0);
    }
    // On finer pixels, where the volume no longer depends on how they lie to the part.
    const LayerGrid fine(grown(part->bounds(), 5 * pixel), bridges.shape.bed, layer_height, pixel / 2);
    const double dense = DenseSupport(fine, pictures_of(*part, fine), options.limits).volume();
    INFO(model.file << ": bridges " << volumes[0] << ", pillars " << volumes[1] << ", dense " << dense
                    << " mm^3");
    CHECK(volumes[0] < volumes[1]);
    CHECK(volumes[0] <= dense / 3);
}

const glm::dmat3 leaning(dvec3(0.8, 0, -0.6), dvec3(0, 1, 0), dvec3(0.6, 0, 0.8));

}  // namespace

TEST_CASE("a koala stands on bridges", "[scaffold][models]") {
    check_model({"examples/models/koala_mm.obj"});
}

TEST_CASE("a fish stands on bridges", "[scaffold][models]") {
    check_model({"tests/models/good/fish_mm.obj"});
}

TEST_CASE("a cow stands on bridges", "[scaffold][models]") {
    check_model({"tests/models/good/spot_quads.obj", 30});
}

TEST_CASE("gears in a leaning frame stand on bridges", "[scaffold][models]") {
    check_model({"tests/models/good/cube_gears.3mf", 0.4, leaning});
}

TEST_CASE("a leaning torus stands on bridges", "[scaffold][models]") {
    check_model({"tests/models/good/torus.3mf", 2, leaning});
}

TEST_CASE("a leaning disc stands on bridges", "[scaffold][models]") {
    check_model({"tests/models/good/fixed_top.ply", 0.4, leaning, 30});
}

TEST_CASE("a leaning machine part stands on bridges", "[scaffold][models]") {
    check_model({"tests/models/good/featuretype.3mf", 0.4, leaning});
}

TEST_CASE("a model's scaffold does not depend on the number of threads", "[scaffold][models]") {
    const FieldPtr part = part_of({"tests/models/good/fish_mm.obj"});
    const OverhangSurvey survey =
        survey_overhangs(scenes::job_of(part, part->bounds(), layer_height), OverhangSurveyOptions{});
    ScaffoldShape shape;
    shape.bed = part->bounds().lo.z;
    const auto with_threads = [&](int threads) {
        SynthesisOptions options;
        options.threads = threads;
        return build_scaffold(survey.points, *part, shape, options);
    };
    const Scaffold one = with_threads(1);
    CHECK(one.bars.size() > 5);
    for (const int threads : {2, 4}) {
        const Scaffold many = with_threads(threads);
        CHECK(many.bars == one.bars);
        CHECK(many.pillars == one.pillars);
        CHECK(many.connectors == one.connectors);
        CHECK(many.unheld == one.unheld);
    }
}

}  // namespace scaffold_models_test
