// The print check on a real model: nothing is found in it, and every fault that is planted is, where it was
// put.
#include "engine/checks/print_check.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "engine/io/mesh_reader.h"
#include "engine/mesh/mesh_field.h"
#include "engine/mesh/mesh_repair.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/surveys/island_scenes.h"

namespace print_check_test {

using namespace lamella;

namespace {

constexpr double h = 0.2, pitch = 0.08, pi = 3.14159265358979;

FieldPtr model(const std::string& file) {
    MeshFile read = read_mesh(std::string(LAMELLA_SOURCE_DIR) + "/tests/models/good/" + file, {});
    return make_mesh_field(close_mesh(std::move(read.mesh)));
}

/// A toy brick, 32 x 64 x 28 mm with its lower corner in the origin, open below: walls of three millimetres
/// stand on the bed.
FieldPtr brick() {
    static const FieldPtr field = [] {
        const FieldPtr read = model("toybrick.stl");
        return make_transform(read, glm::dmat3(1), -read->bounds().lo);
    }();
    return field;
}

FieldPtr box(dvec3 lo, dvec3 hi) { return make_box({lo, hi}); }
FieldPtr with(const FieldPtr& a, const FieldPtr& b) { return make_union({a, b}); }

/// A filament printer that bridges the brick's roof, with all checks that matter for it and more.
PrintCheckOptions filament() {
    PrintCheckOptions options;
    options.limits.verdicts.fill(Severity::fail);
    for (const Check off : {Check::sheets, Check::cups})
        options.limits.verdicts[static_cast<std::size_t>(off)] = Severity::off;
    options.limits.bridge = 24;
    options.limits.overhang = h;
    options.pitch = pitch;
    return options;
}

PrintCheckOptions only(Check check) {
    PrintCheckOptions options = filament();
    options.limits.verdicts.fill(Severity::off);
    options.limits.verdicts[static_cast<std::size_t>(check)] = Severity::fail;
    return options;
}

CheckReport check(const FieldPtr& part, const PrintCheckOptions& options, int threads = 0,
                  const FieldPtr& supports = nullptr, double layer_height = h) {
    Job job = scenes::job_of(part, part->bounds(), layer_height);
    job.supports = supports;
    PrintCheck checks(job, options);
    survey_layers(job, checks, {threads});
    return checks.report();
}

const CheckResult& result(const CheckReport& report, Check check) {
    for (const CheckResult& result : report.results) {
        if (result.check == check) return result;
    }
    throw std::logic_error("not looked for");
}

/// The one fault of this kind.
Fault the_fault(const FieldPtr& part, const PrintCheckOptions& options, Check kind) {
    const CheckReport report = check(part, options);
    CHECK(!report.passed());
    const CheckResult& found = result(report, kind);
    REQUIRE(found.count == 1);
    CHECK(found.total == Approx(found.worst.front().size));
    return found.worst.front();
}

void check_near(dvec3 a, dvec3 b) {
    CHECK(std::abs(a.x - b.x) <= pitch);
    CHECK(std::abs(a.y - b.y) <= pitch);
    CHECK(std::abs(a.z - b.z) <= h);
}

/// Whether all but these kinds pass.
void check_others_pass(const CheckReport& report, std::vector<Check> but) {
    for (const CheckResult& result : report.results) {
        INFO("check " << static_cast<int>(result.check));
        if (std::find(but.begin(), but.end(), result.check) == but.end()) CHECK(result.count == 0);
    }
}

}  // namespace

TEST_CASE("a brick without faults passes every check", "[check]") {
    const CheckReport report = check(brick(), filament());
    CHECK(report.results.size() == 11);
    check_others_pass(report, {});
    CHECK(report.passed());
    // Upside down, as a vat would print it: no cups, but what was the inner roof stands on its studs.
    CHECK(report.volume == Approx(28000).epsilon(0.4));
}

TEST_CASE("a ball beside the part is a second piece", "[check]") {
    const dvec3 at(40, 20, 10.1);
    const FieldPtr part = with(brick(), make_sphere(at, 2));
    const Fault fault = the_fault(part, only(Check::connectivity), Check::connectivity);
    check_near(fault.at, at);
    CHECK(fault.size == Approx(4.0 / 3 * pi * 8).epsilon(0.02));
    CHECK(fault.first_layer == 41);
    CHECK(fault.end_layer == 60);
    check_others_pass(check(part, filament()), {Check::connectivity, Check::islands, Check::overhangs});
}

TEST_CASE("a pin that hangs down begins as an island", "[check]") {
    // An arm out of the wall, and a pin below its end.
    const FieldPtr arm = box({30, 30, 18}, {38, 32, 20}), pin = box({36, 30, 12}, {38, 32, 19});
    const Fault fault = the_fault(with(brick(), with(arm, pin)), only(Check::islands), Check::islands);
    check_near(fault.at, {37, 31, 12.1});
    CHECK(fault.layer == 60);
    CHECK(fault.end_layer == 61);
    CHECK(fault.size == Approx(4).epsilon(0.05));
    CHECK(fault.box.size().x == Approx(2).margin(pitch));
    CHECK(fault.box.size().y == Approx(2).margin(2 * pitch));
}

TEST_CASE("a shelf hangs, and one on a gusset does not", "[check]") {
    const FieldPtr shelf = box({31, 30, 15}, {36, 40, 17});
    const Fault fault = the_fault(with(brick(), shelf), only(Check::overhangs), Check::overhangs);
    check_near(fault.at, {34, 35, 15.1});
    CHECK(fault.layer == 75);
    CHECK(fault.end_layer == 76);
    CHECK(fault.size == Approx(40).epsilon(0.02));
    const FieldPtr gusset = make_intersection(
        {box({31, 30, 8}, {36, 40, 17}), make_half_space({1, 0, -1}, 19.5 / std::sqrt(2.0))});
    check_others_pass(check(with(brick(), gusset), filament()), {});
}

TEST_CASE("slopes steeper than allowed by a quarter are found, and others are not", "[check]") {
    // A wall that leans over by `lean` for each unit of height.
    const auto leaning = [](double lean) {
        const double norm = std::sqrt(1 + lean * lean);
        return make_intersection({box({0, 0, 0}, {40, 10, 10}), make_half_space({1, 0, -lean}, 10 / norm),
                                  make_half_space({-1, 0, lean}, -2 / norm)});
    };
    for (const double turn : {0.0, 30.0, 45.0, 90.0}) {
        const double c = std::cos(turn * pi / 180), s = std::sin(turn * pi / 180);
        const glm::dmat3 about_z(c, s, 0, -s, c, 0, 0, 0, 1);
        const auto count = [&](double lean) {
            const FieldPtr part = make_transform(leaning(lean), about_z, dvec3(0));
            return result(check(part, only(Check::overhangs)), Check::overhangs).count;
        };
        INFO("turned by " << turn);
        CHECK(count(0.9) == 0);
        CHECK(count(1) == 0);
        CHECK(count(1.35) == 1);
    }
    // The same in thin layers, of which many are followed at once.
    PrintCheckOptions options = only(Check::overhangs);
    constexpr double thin = 0.05;
    options.limits.overhang = thin;
    CHECK(result(check(leaning(1), options, 0, nullptr, thin), Check::overhangs).count == 0);
    const CheckReport report = check(leaning(1.35), options, 0, nullptr, thin);
    const CheckResult& found = result(report, Check::overhangs);
    REQUIRE(found.count == 1);
    const double followed = 8 * pitch + thin;  // over which a slope has to go on to be known
    CHECK(found.worst.front().first_layer * thin <= followed + 2 * thin);
    CHECK(found.worst.front().end_layer * thin == Approx(10).margin(2 * thin));
}

TEST_CASE("a bar between two towers is too long a bridge", "[check]") {
    const FieldPtr towers = with(box({-3, 5, 0}, {0.1, 8, 34}), box({31.9, 5, 0}, {35, 8, 34})),
                   bar = box({-3, 5, 32}, {35, 8, 34});
    const FieldPtr part = with(brick(), with(towers, bar));
    const Fault fault = the_fault(part, only(Check::bridges), Check::bridges);
    check_near(fault.at, {16, 6.5, 32.1});
    CHECK(fault.layer == 160);
    CHECK(fault.size == Approx(31.8).margin(3 * h));
    check_others_pass(check(part, filament()), {Check::bridges});
}

TEST_CASE("a bridge is as long as it is in the best direction", "[check]") {
    for (const double turn : {0.0, 17.0, 45.0, 80.0}) {
        const double c = std::cos(turn * pi / 180), s = std::sin(turn * pi / 180);
        const glm::dmat3 about_z(c, s, 0, -s, c, 0, 0, 0, 1);
        // Two walls 12 apart and 40 long under a roof.
        const FieldPtr house = make_transform(
            with(with(box({0, 0, 0}, {2, 40, 6}), box({14, 0, 0}, {16, 40, 6})), box({0, 0, 5}, {16, 40, 6})),
            about_z, dvec3(0));
        PrintCheckOptions options = only(Check::bridges);
        options.limits.bridge = 10;
        INFO("turned by " << turn);
        const Fault fault = the_fault(house, options, Check::bridges);
        // Directions are 14 degrees apart at most; on either side a step is held.
        CHECK(fault.size > 12 - 2 * h - 4 * pitch);
        CHECK(fault.size < 12 / std::cos(7.2 * pi / 180) + 2 * pitch);
    }
}

TEST_CASE("a fin thinner than a bead is too thin, and one as thick is not, whichever way it stands",
          "[check]") {
    const auto fin = [](double thickness, double turn) {
        const double c = std::cos(turn * pi / 180), s = std::sin(turn * pi / 180);
        const glm::dmat3 about_z(c, s, 0, -s, c, 0, 0, 0, 1);
        const double half = thickness / 2;
        return make_transform(box({0, -half, 0}, {8, half, 6}), about_z, dvec3(31, 30, 0));
    };
    const Fault fault = the_fault(with(brick(), fin(0.2, 0)), only(Check::thickness), Check::thickness);
    CHECK(std::abs(fault.at.y - 30) <= pitch);
    CHECK(fault.at.x > 32);
    CHECK(fault.at.x < 39);
    CHECK(fault.first_layer == 0);
    CHECK(fault.end_layer == 30);
    // Of the seven millimetres that stand out, the slack is not counted.
    CHECK(fault.size == Approx(0.2 * 6 * (7 - 0.4)).epsilon(0.25));
    check_others_pass(check(with(brick(), fin(0.2, 0)), filament()), {Check::thickness});
    for (const double turn : {-60.0, -45.0, -13.0, 0.0, 5.0, 30.0, 45.0, 71.0}) {
        INFO("turned by " << turn);
        CHECK(result(check(fin(0.2, turn), only(Check::thickness)), Check::thickness).count == 1);
        CHECK(result(check(fin(0.4, turn), only(Check::thickness)), Check::thickness).count == 0);
    }
}

TEST_CASE("what is too thin in thin layers is known to a layer", "[check]") {
    constexpr double thin = 0.025;
    const FieldPtr part = with(box({0, 0, 0}, {10, 10, 6}), box({10, 4.9, 2}, {16, 5.1, 5}));
    for (const Check kind : {Check::thickness, Check::gaps}) {
        const FieldPtr solid = kind == Check::thickness ? part
                                                        : make_difference(box({0, 0, 0}, {18, 10, 6}),
                                                                          box({8, 4.9, 2}, {20, 5.1, 5}));
        const CheckReport report = check(solid, only(kind), 0, nullptr, thin);
        const CheckResult& found = result(report, kind);
        REQUIRE(found.count == 1);
        const Fault& fault = found.worst.front();
        CHECK(std::abs(fault.at.y - 5) <= pitch);
        CHECK(fault.first_layer == 80);
        CHECK(fault.end_layer == 200);
        CHECK(std::abs((fault.layer + 0.5) * thin - fault.at.z) <= 1e-9);
        CHECK(fault.runs.front().layer == fault.layer);
        CHECK(fault.box.size().z == Approx(3));
    }
    // A part of a single layer is looked at, too.
    CHECK(result(check(box({0, 0, 0}, {8, 0.2, thin}), only(Check::thickness), 0, nullptr, thin),
                 Check::thickness)
              .count == 1);
}

TEST_CASE("a floor is too thin upright only where the process asks", "[check]") {
    const FieldPtr part = with(brick(), box({31, 10, 0}, {45, 24, 0.6}));
    CHECK(result(check(part, only(Check::thickness)), Check::thickness).count == 0);
    PrintCheckOptions upright = only(Check::thickness);
    upright.limits.thickness = upright.limits.thickness_up = 1.2;
    const Fault fault = the_fault(part, upright, Check::thickness);
    CHECK(fault.at.x > 33);
    CHECK(fault.at.x < 45);
    CHECK(fault.first_layer == 0);
    CHECK(fault.end_layer == 3);
}

TEST_CASE("what is thin upright is found where layers lie closer than rows", "[check]") {
    constexpr double fine = 0.025;  // three layers, of which one is looked at, lie within a row's width
    const FieldPtr part = with(box({0, 0, 0}, {6, 6, 4}), box({5, 1, 2}, {9, 5, 2.6}));
    PrintCheckOptions upright = only(Check::thickness);
    upright.limits.thickness = upright.limits.thickness_up = 1.2;
    const CheckReport report = check(part, upright, 0, nullptr, fine);
    REQUIRE(result(report, Check::thickness).count == 1);
    const Fault& fault = result(report, Check::thickness).worst.front();
    CHECK(std::abs(fault.first_layer - 80) <= 3);
    CHECK(std::abs(fault.end_layer - 104) <= 3);
    CHECK(fault.at.z == Approx((fault.layer + 0.5) * fine));
    CHECK(fault.at.x > 6);
    CHECK(fault.at.x < 9);
    CHECK(fault.box.lo.z == Approx(2).margin(3 * fine));
    CHECK(fault.box.hi.z == Approx(2.6).margin(3 * fine));
    CHECK(fault.size > 1.8 * 4 * 0.6);
    CHECK(fault.size < 3.2 * 4 * 0.7);
    const FieldPtr stout = with(box({0, 0, 0}, {6, 6, 4}), box({5, 1, 2}, {9, 5, 3.3}));
    CHECK(result(check(stout, upright, 0, nullptr, fine), Check::thickness).count == 0);
}

TEST_CASE("a slot that is too narrow is a gap, a wide one is not", "[check]") {
    const FieldPtr block = box({31, 10, 0}, {45, 24, 10});
    const auto slotted = [&](double width) {
        const double half = width / 2;
        return with(brick(), make_difference(block, box({38 - half, 5, 4}, {38 + half, 20, 11})));
    };
    const Fault fault = the_fault(slotted(0.2), only(Check::gaps), Check::gaps);
    CHECK(std::abs(fault.at.x - 38) <= pitch);
    CHECK(fault.at.y > 10);
    CHECK(fault.at.y < 20);
    CHECK(fault.first_layer == 20);
    CHECK(fault.end_layer == 50);
    CHECK(fault.size == Approx(0.2 * 6 * (10 - 0.4)).epsilon(0.15));
    check_others_pass(check(slotted(0.45), filament()), {});
}

TEST_CASE("a stalk under a heavy head is a neck, a stout one is not", "[check]") {
    const auto headed = [&](double radius) {
        const FieldPtr stalk = make_cylinder({8, 8, 26}, {8, 8, 36}, radius);
        return with(brick(), with(stalk, make_sphere({8, 8, 40}, 7)));
    };
    const Fault fault = the_fault(headed(0.35), only(Check::necks), Check::necks);
    CHECK(std::abs(fault.at.x - 8) <= pitch);
    CHECK(std::abs(fault.at.y - 8) <= pitch);
    CHECK(fault.at.z > 28);
    CHECK(fault.at.z < 34);
    CHECK(result(check(headed(0.8), only(Check::necks)), Check::necks).count == 0);
}

TEST_CASE("a bubble is a cavity, and one with a hole is not", "[check]") {
    const FieldPtr block = with(brick(), box({31, 10, 0}, {45, 24, 14})),
                   bubble = make_sphere({38, 17, 7.1}, 4);
    const Fault fault = the_fault(make_difference(block, bubble), only(Check::cavities), Check::cavities);
    check_near(fault.at, {38, 17, 7.1});
    CHECK(fault.size == Approx(4.0 / 3 * pi * 64).epsilon(0.01));
    CHECK(fault.box.size().x == Approx(8).margin(pitch));
    const FieldPtr drained =
        make_difference(block, with(bubble, make_cylinder({38, 17, 7}, {50, 17, 7}, 0.5)));
    check_others_pass(check(drained, only(Check::cavities)), {});
}

TEST_CASE("a cup is what the vat's film closes off", "[check]") {
    const FieldPtr block = box({0, 0, 0}, {14, 14, 10});
    // A blind hole from above is one, with the volume below its rim; a slit in its wall lets air in.
    const FieldPtr pot = make_difference(block, make_cylinder({7, 7, 2}, {7, 7, 11}, 4));
    const Fault fault = the_fault(pot, only(Check::cups), Check::cups);
    check_near(fault.at, {7, 7, 2.1});
    CHECK(fault.size == Approx(pi * 16 * 8).epsilon(0.01));
    const FieldPtr vented = make_difference(pot, box({7, 6.5, 2}, {15, 7.5, 3}));
    CHECK(result(check(vented, only(Check::cups)), Check::cups).count == 0);
    // From below the bed closes it.
    const FieldPtr hood = make_difference(block, make_cylinder({7, 7, -1}, {7, 7, 8}, 4));
    CHECK(the_fault(hood, only(Check::cups), Check::cups).size == Approx(pi * 16 * 8).epsilon(0.01));
    check_others_pass(check(make_difference(hood, box({7, 6.5, 0}, {15, 7.5, 1})), only(Check::cups)), {});
    // A closed bubble is a cavity, not a cup.
    check_others_pass(check(make_difference(block, make_sphere({7, 7, 5}, 4)), only(Check::cups)), {});
}

TEST_CASE("what the machine does not reach is told", "[check]") {
    PrintCheckOptions options = only(Check::build_volume);
    options.limits.build_volume = {30, 70, 40};
    const Fault fault = the_fault(brick(), options, Check::build_volume);
    CHECK(fault.size == Approx(2).margin(pitch));
    CHECK(fault.at.x == Approx(32).margin(pitch));
    options.limits.build_volume = {40, 70, 20};
    CHECK(the_fault(brick(), options, Check::build_volume).size == Approx(8).margin(h));
    options.limits.build_volume = {32.01, 64.01, 28.01};
    check_others_pass(check(brick(), options), {});
}

TEST_CASE("layers without anything are told", "[check]") {
    const FieldPtr part = with(brick(), box({10, 10, 30}, {20, 20, 32}));
    const Fault fault = the_fault(part, only(Check::empty_layers), Check::empty_layers);
    CHECK(fault.first_layer == 140);
    CHECK(fault.end_layer == 150);
    CHECK(fault.size == Approx(10 * h));
    CHECK(fault.at.z == Approx(28.1));
}

TEST_CASE("a sheet in pieces is told of layer by layer", "[check]") {
    const FieldPtr part = with(brick(), box({40, 10, 0}, {45, 20, 3}));
    const CheckReport report = check(part, only(Check::sheets));
    const CheckResult& sheets = result(report, Check::sheets);
    // The brick has loose rings under its roof, too: those of the brick alone are what the box adds to.
    const CheckReport alone = check(brick(), only(Check::sheets));
    const CheckResult& of_brick = result(alone, Check::sheets);
    CHECK(sheets.total - of_brick.total == Approx(50 * 15).epsilon(0.01));
    CHECK(sheets.worst.size() == 10);
}

TEST_CASE("blades that rows cut to pieces are no islands where they climb out of a block", "[check]") {
    const FieldPtr block = box(dvec3(-4, -4, 0), dvec3(0.5, 4, 8));
    const FieldPtr blade = box(dvec3(0, -0.015, 0), dvec3(6, 0.015, 1));
    const PrintCheckOptions islands = only(Check::islands);
    for (const double degrees : {-80, -60, -30, -10, 3, 15, 45, 75, 90}) {
        const dvec3 along(std::cos(degrees * pi / 180), std::sin(degrees * pi / 180), 0.3);
        const dvec3 x = glm::normalize(along), y = glm::normalize(glm::cross(dvec3(0, 0, 1), x));
        const glm::dmat3 turn(x, y, glm::cross(x, y));
        const FieldPtr part = with(block, make_transform(blade, turn, dvec3(0, 0, 2)));
        INFO(degrees << " degrees");
        CHECK(check(part, islands, 0, nullptr, 0.05).passed());
        // The same a little beside the block begins in the air, and rows see it before it leans against that.
        const FieldPtr apart = with(block, make_transform(blade, turn, dvec3(0.52, 0, 2) + 0.02 * x));
        if (std::abs(degrees) < 60 && degrees != 3) CHECK(!check(apart, islands, 0, nullptr, 0.05).passed());
    }
}

TEST_CASE("a beam that comes down to a point of its own begins in the air", "[check]") {
    const FieldPtr post = make_cylinder(dvec3(0), dvec3(0, 0, 6), 1),
                   beam = make_round_cone({dvec3(0, 0, 5.5), 0.3, dvec3(9, 0, 4.5), 0.2});
    const CheckReport report = check(with(post, beam), only(Check::islands), 0, nullptr, 0.05);
    const CheckResult& islands = result(report, Check::islands);
    REQUIRE(islands.count == 1);
    CHECK(islands.worst.front().layer == 86);  // the ball at its end reaches down to 4.3 mm
}

TEST_CASE("supports hold what hangs", "[check]") {
    const FieldPtr shelf = with(brick(), box({31, 30, 15}, {36, 40, 17})),
                   ball = make_sphere({40, 20, 10}, 2);
    const FieldPtr post = make_cylinder({35, 35, 0}, {35, 35, 15}, 1),
                   row = with(make_cylinder({34.5, 32, 0}, {34.5, 32, 15}, 0.5),
                              make_cylinder({34.5, 38, 0}, {34.5, 38, 15}, 0.5));
    PrintCheckOptions options = only(Check::overhangs);
    options.limits.support_spacing = 4;
    CHECK(check(shelf, options, 0, row).passed());
    options.limits.support_spacing = 1.5;
    CHECK(!check(shelf, options, 0, row).passed());
    // A tip may end below what it holds by the gap that supports keep.
    const FieldPtr short_post = make_cylinder({40, 20, 0}, {40, 20, 7.6}, 0.5);
    PrintCheckOptions islands = only(Check::islands);
    CHECK(!check(with(brick(), ball), islands, 0, short_post).passed());
    islands.limits.support_gap = 0.4;
    CHECK(check(with(brick(), ball), islands, 0, short_post).passed());
}

namespace {

/// Everything that is looked for, on a part that has some of it.
PrintCheckOptions all_checks() {
    PrintCheckOptions options = filament();
    options.limits.verdicts.fill(Severity::fail);
    options.limits.thickness_up = options.limits.gap_up = 0.8;
    options.limits.thickness = 3.4;
    return options;
}
FieldPtr faulty_part() { return with(brick(), make_sphere({36, 20, 10}, 6)); }

void check_same(const CheckReport& one, const CheckReport& other) {
    REQUIRE(one.results.size() == check_count);
    REQUIRE(other.results.size() == check_count);
    CHECK(one.volume == other.volume);
    for (std::size_t k = 0; k < check_count; ++k) {
        const CheckResult &a = one.results[k], &b = other.results[k];
        CHECK(a.count == b.count);
        CHECK(a.total == b.total);
        REQUIRE(a.worst.size() == b.worst.size());
        for (std::size_t i = 0; i < a.worst.size(); ++i) {
            CHECK(a.worst[i].at == b.worst[i].at);
            CHECK(a.worst[i].size == b.worst[i].size);
            CHECK(a.worst[i].runs == b.worst[i].runs);
        }
    }
}

/// A check whose layers all travel as parcels to it, from another that renders them.
class Carried : public Backend {
  public:
    Carried(const PrintCheck& renderer, PrintCheck& check) : renderer_(renderer), check_(check) {}
    int open(const Job& job, LayerRange range, bool resume) override {
        return check_.open(job, range, resume);
    }
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto arrived = check_.empty_product();
        unpack(pack(*renderer_.render(layer)), *arrived);
        return arrived;
    }
    void write(const Layer& layer, LayerProduct& product) override { check_.write(layer, product); }
    void finish() override { check_.finish(); }

  private:
    const PrintCheck& renderer_;
    PrintCheck& check_;
};

}  // namespace

TEST_CASE("the report is the same by any number of threads", "[check]") {
    const FieldPtr part = faulty_part();
    check_same(check(part, all_checks(), 1), check(part, all_checks(), 4));
}

TEST_CASE("a check says the same of layers that were rendered elsewhere", "[check]") {
    const FieldPtr part = faulty_part();
    const FieldPtr post = make_cylinder({36, 20, 0}, {36, 20, 4}, 1);
    for (const FieldPtr& supports : {FieldPtr(), post}) {
        Job job = scenes::job_of(part, part->bounds(), h);
        job.supports = supports;
        const PrintCheck renderer(job, all_checks());
        PrintCheck checks(job, all_checks());
        Carried carried(renderer, checks);
        survey_layers(job, carried, {});
        check_same(checks.report(), check(part, all_checks(), 0, supports));
    }
}

TEST_CASE("a checked layer that is damaged on its way is refused", "[check]") {
    Job job = scenes::job_of(faulty_part(), faulty_part()->bounds(), h);
    job.supports = make_cylinder({36, 20, 0}, {36, 20, 4}, 1);
    PrintCheckOptions options = all_checks();
    const PrintCheck checks(job, options);
    const Layer layer(job, 10);
    const std::string whole = pack(*checks.render(layer));
    const auto arrives = [&](const std::string& bytes, const PrintCheck& at) {
        unpack(bytes, *at.empty_product());
    };
    CHECK_NOTHROW(arrives(whole, checks));
    for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 500)
        CHECK_THROWS_AS(arrives(whole.substr(0, size), checks), FaultError);
    CHECK_THROWS_AS(arrives(whole + '\0', checks), FaultError);
    // Counts and starts of rows, which a reader would follow out of the lists.
    const std::size_t areas = 2 * sizeof(double) + 1;
    for (std::size_t at = areas; at < areas + 512; ++at) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x40);
        CHECK_THROWS_AS(arrives(damaged, checks), FaultError);
    }
    // Other limits want other labels, another pitch other rows.
    CHECK_THROWS_AS(arrives(whole, PrintCheck(job, only(Check::thickness))), FaultError);
    options.pitch = 2 * pitch;
    CHECK_THROWS_AS(arrives(whole, PrintCheck(job, options)), FaultError);
}

namespace {

/// Lines of a display with its middle over a part's, every few of them `pitch` apart.
RowBand display_lines(const Box& bounds, Axis axis, double along_sign, double across_sign) {
    const int along = axis == Axis::x ? 0 : 1, side = 2000;
    const double pixel = pitch / 2;
    RowBand lines{.axis = axis, .along_pitch = along_sign * pixel, .across_pitch = across_sign * pixel};
    lines.along_origin = bounds.center()[along] - side / 2 * lines.along_pitch;
    lines.across_origin = bounds.center()[1 - along] - side / 2 * lines.across_pitch;
    lines.count = lines.hi = side;
    lines.sub = 2;
    lines.step = 4;
    return lines;
}

}  // namespace

TEST_CASE("rows on a display's lines show the same faults, whichever way they run", "[check]") {
    const FieldPtr part =
        with(with(make_difference(brick(), make_sphere({1.5, 30, 10}, 0.65)), make_sphere({40, 20, 10}, 4)),
             box({38, 40, 6}, {38.3, 60, 9}));
    PrintCheckOptions options = all_checks();
    options.limits.build_volume = {40, 70, 40};
    options.limits.thickness = options.limits.thickness_up = 0.8;
    options.pitch = pitch;
    const CheckReport expected = check(part, options);
    CHECK(result(expected, Check::connectivity).count == 2);
    CHECK(result(expected, Check::build_volume).count == 1);
    CHECK(result(expected, Check::cavities).count == 1);
    CHECK(result(expected, Check::islands).count == 2);
    const auto tells_of_plate = [](Check check) {
        return check == Check::islands || check == Check::thickness;
    };
    for (const Axis axis : {Axis::x, Axis::y}) {
        for (const double along_sign : {1.0, -1.0}) {
            for (const double across_sign : {1.0, -1.0}) {
                options.lines = display_lines(part->bounds(), axis, along_sign, across_sign);
                const CheckReport report = check(part, options);
                CHECK(report.volume == Approx(expected.volume).epsilon(1e-3));
                REQUIRE(report.results.size() == check_count);
                for (std::size_t k = 0; k < check_count; ++k) {
                    const CheckResult &a = report.results[k], &b = expected.results[k];
                    INFO("check " << k << ", axis " << static_cast<int>(axis));
                    CHECK(a.count == b.count);
                    // The plate of 0.3 mm is three rows wide or four.
                    CHECK(a.total ==
                          Approx(b.total).epsilon(tells_of_plate(report.results[k].check) ? 0.25 : 0.05));
                }
                for (const Check kind : {Check::connectivity, Check::cavities})
                    check_near(result(report, kind).worst.front().at,
                               result(expected, kind).worst.front().at);
                CHECK(result(report, Check::build_volume).worst.front().at.x == Approx(44).margin(pitch));
            }
        }
    }
}

TEST_CASE("limits that make no sense are refused", "[check]") {
    PrintCheckOptions options = only(Check::thickness);
    options.limits.thickness = pitch;
    CHECK_THROWS_WITH(check(brick(), options), Catch::Contains("least thickness of 0.08"));
    options = only(Check::overhangs);
    options.limits.overhang = 0;
    CHECK_THROWS_WITH(check(brick(), options), Catch::Contains("overhang of 0"));
    options = filament();
    options.pitch = 1e-5;
    CHECK_THROWS_AS(check(brick(), options), InputError);
    Job job = scenes::job_of(brick(), brick()->bounds(), h);
    PrintCheck checks(job, filament());
    CHECK_THROWS_AS(checks.open(job, {3, 10}, false), InputError);
}

}  // namespace print_check_test
