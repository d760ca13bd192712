// A plate of sticks from a recipe: kept, cut, told of what cannot be.
#include "recipe/structure/place_elements.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <glm/gtc/constants.hpp>
#include <sstream>

#include "engine/base/error.h"
#include "engine/runs/streaming_components.h"
#include "procedural/voronoi/counter_hash.h"
#include "recipe/build/build_job.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/mentions.h"
#include "tests/app/commands/recipes.h"
#include "tests/engine/runs/plane_runs.h"

namespace place_elements_test {

using namespace lamella;

namespace {

std::string plate(const std::string& element, const std::string& keys) {
    return "[part]\nshape = \"box\"\nsize = [60, 24, 3]\n"
           "[[load]]\nbox = [[29, -12, -2], [30, -8, 2]]\nforce = [0, -10, 0]\n[[anchor]]\nface = \"-x\"\n"
           "[[element]]\n" +
           element + "[elements]\ndimensions = 2\n" + keys;
}

const std::string sticks = plate("length = 10\nwidth = 2.4\n", "count = 24\niterations = 40\n");

std::string told(const std::string& text) {
    try {
        build_job(recipe_of(text, "p.toml"));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a plate of sticks is one piece, the same at every height, and kept", "[elements]") {
    const Folder folder;
    OptimizeOptions options;
    options.plans = folder.path();
    int iterations = 0;
    options.on_elements = [&](const ElementIteration& done, int all) {
        CHECK(all == 40);
        iterations += done.index > 0 ? 1 : 0;
    };
    const Recipe recipe = recipe_of(sticks, "p.toml");
    const BuiltJob built = build_job(recipe, options);
    CHECK(iterations == 40);
    const ElementPlan& plan = *built.elements;
    CHECK(plan.elements.size() + plan.dropped == 24);
    CHECK(plan.volume > 0.2);
    CHECK(plan.volume < 24 * 22.8 / (60 * 24));
    CHECK(plan.compliance < 8 * plan.full_compliance);
    CHECK(plan.compliance > plan.full_compliance);
    const Box box = built.designed.bounds;
    const RowBand band = band_over(box, 0.05);
    const RunRows low = runs_at(*built.designed.part, -1.3, band),
                  high = runs_at(*built.designed.part, 1.4, band);
    CHECK(!low.runs().empty());
    CHECK(std::ranges::equal(low.runs(), high.runs()));
    const double area = static_cast<double>(low.total_length()) / run_unit * 0.05 * 0.05;
    CHECK(area / (60 * 24) == Approx(plan.volume).epsilon(0.02));

    const BuiltJob again = build_job(recipe, options);
    CHECK(iterations == 40);
    CHECK(again.elements->elements == plan.elements);
    CHECK(again.elements->compliance == plan.compliance);
    build_job(recipe_of(sticks + "seed = 2\n", "p.toml"), options);
    CHECK(iterations == 80);
}

TEST_CASE("a plan of elements that is damaged is refused", "[elements]") {
    const Folder folder;
    const std::filesystem::path file = folder.path() / "some.elements";
    const ElementPlan plan{
        .elements = {{.shape = 1, .at = {0.1, 2, -3}, .turn = {0.6, 0, 0.8, 0}, .scale = 1.5},
                     {.shape = 0, .at = {1.0 / 3, 0, 0}}},
        .bridges = {{{0.7, 0, 0}, {1, 2, 3}}},
        .pieces = 3,
        .moved = 2,
        .dropped = 1,
        .volume = 0.25,
        .compliance = 12.5,
        .full_compliance = 3.25,
        .optimum = 6,
        .overlap = 0.125,
        .thickness = 2.5};
    write_element_plan(file, plan);
    const std::string whole = contents(file);
    const auto read = [](const std::string& text) {
        std::istringstream in(text);
        return read_element_plan(in, "some");
    };
    const ElementPlan back = read(whole);
    CHECK(back.elements == plan.elements);
    CHECK(back.pieces == 3);
    CHECK(back.moved == 2);
    CHECK(back.dropped == 1);
    CHECK(back.optimum == 6);
    CHECK(back.bridges == plan.bridges);
    CHECK(back.overlap == 0.125);
    CHECK(back.thickness == 2.5);
    for (std::size_t cut = 0; cut + 1 < whole.size(); cut += 7)
        CHECK_THROWS_AS(read(whole.substr(0, cut)), InputError);
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = whole;
        const std::size_t at = text.find(from);
        REQUIRE(at != std::string::npos);
        return text.replace(at, from.size(), to);
    };
    CHECK_THROWS_AS(read(changed("2,1,3,2,1", "3,1,3,2,1")), InputError);  // fewer elements than announced
    CHECK_THROWS_AS(read(changed("2,1,3,2,1", "-2,1,3,2,1")), InputError);
    CHECK_THROWS_AS(read(changed("2,1,3,2,1", "2,2,3,2,1")), InputError);  // fewer bridges
    CHECK_THROWS_AS(read(changed("\n1,0.1", "\n1e12,0.1")), InputError);
    CHECK_THROWS_AS(read(changed("\n1,0.1", "\n0.5,0.1")), InputError);
    CHECK_THROWS_AS(read(changed("0.8", "0.9")), InputError);  // not a rotation
    CHECK_THROWS_AS(read(changed(",1.5\n", ",0\n")), InputError);
    CHECK_THROWS_AS(read(changed(",1.5\n", ";1.5\n")), InputError);
}

TEST_CASE("elements that cannot make the part are told why", "[elements]") {
    CHECK(mentions(told(plate("length = 80\nwidth = 2.4\n", "count = 24\n")),
                   "80 mm across, it is larger than the part, 60 mm"));
    CHECK(mentions(told(plate("length = 10\nwidth = 2.4\n", "count = 400\n")), "elements.count"));
    CHECK(mentions(told(plate("length = 10\nwidth = 2.4\n", "count = 400\n")), "smaller shapes"));
    CHECK(mentions(told(plate("length = 10\nwidth = 2.4\n", "count = 24\nelement = 3\n")),
                   "3 mm is too coarse for shapes 2.3"));
    // Two short sticks cannot reach from the wall to the load.
    CHECK(mentions(told(plate("length = 10\nwidth = 2.4\n", "count = 2\niterations = 5\n")),
                   "do not reach all loads and anchors"));
}

TEST_CASE("elements without loads are spread by their density and make one piece", "[elements]") {
    const std::string text =
        "[part]\nshape = \"box\"\nsize = [60, 30, 3]\n[[element]]\nkind = \"ring\"\ndiameter = 6\nwidth = "
        "1.2\n"
        "[elements]\ndimensions = 2\ncount = 36\ndensity = \"x > 0\"\n";
    const BuiltJob built = build_job(recipe_of(text, "p.toml"));
    const ElementPlan& plan = *built.elements;
    CHECK(plan.elements.size() + plan.dropped == 36);
    CHECK(plan.full_compliance == 0);
    CHECK(plan.overlap <= 0.3);
    for (const PlacedElement& element : plan.elements) CHECK(element.at.x > -1.5);
    const RowBand band = band_over(built.designed.bounds, 0.05);
    const RunRows rows = runs_at(*built.designed.part, 0.7, band);
    const double area = static_cast<double>(rows.total_length()) / run_unit * 0.05 * 0.05;
    CHECK(area / (60 * 30) == Approx(plan.volume).epsilon(0.05));
    CHECK(label_layer(rows, 0, Growth{}).components.size() == 1);

    CHECK(mentions(told(text + "overlap = 0.01\n"), "of the elements lies in others, more than 0.01"));
    std::string sparse = text;
    sparse.replace(sparse.find("count = 36"), 10, "count = 12");
    CHECK(mentions(told(sparse), "of 12 elements touch no others within elements.reach"));
}

TEST_CASE("elements are spread after an example", "[elements]") {
    const Folder folder;
    const std::string file = folder / "example.csv";
    const std::string half_turn = "0,0,0,0,0,0,0,1,1\n", quarter = "0,9,1,0,1,0,0,1,1\n";
    write(file, half_turn + quarter + quarter);
    OptimizeOptions options;
    options.plans = folder.path();
    const std::string text =
        "[part]\nshape = \"box\"\nsize = [60, 24, 3]\n[[element]]\nlength = 10\nwidth = 2.4\n"
        "[elements]\ndimensions = 2\ncount = 30\noverlap = 0.6\nbridge = 1\nreach = 20\nexample = \"" +
        file + "\"\n";
    const auto upright = [&] {
        const BuiltJob built = build_job(recipe_of(text, "p.toml"), options);
        std::size_t count = 0;
        for (const PlacedElement& element : built.elements->elements)
            count += std::abs((element.turn * dvec3(1, 0, 0)).y) > 0.99 ? 1 : 0;
        return std::pair(count, built.elements->elements.size() + built.elements->dropped);
    };
    CHECK(upright() == std::pair<std::size_t, std::size_t>(20, 30));
    write(file, half_turn + quarter);  // another plan
    CHECK(upright() == std::pair<std::size_t, std::size_t>(15, 30));
    write(file, half_turn + "0,9,1,0,1,0,0,1,0.5\n");
    CHECK(mentions(told(text), file + ":2: a scale of 0.5 is outside of elements.scale_min and scale_max"));
    write(file, "1" + half_turn.substr(1) + quarter);
    CHECK(mentions(told(text), file + ":1: there is no shape 1"));
    CHECK(mentions(told(sticks + "example = \"" + file + "\"\n"), "elements.example: loads decide where"));
}

TEST_CASE("a skin of elements is one piece over all of the body, bridged where it has to be", "[elements]") {
    const auto to_ball = [](dvec3 p) { return length(p) - 15; };
    const auto to_torus = [](dvec3 p) { return length(dvec2(length(dvec2(p)) - 12, p.z)) - 6; };
    const bool is_torus = GENERATE(false, true);
    const std::string text =
        (is_torus ? "[part]\nshape = \"torus\"\nradius = 12\ntube = 6\n"
                  : "[part]\nshape = \"sphere\"\nradius = 15\n") +
        std::string(
            "[skin]\nthickness = 1\npattern = \"elements\"\n"
            "[[element]]\nkind = \"outline\"\ncorners = [[-3, -1], [3, -1], [3, 1], [-3, 1]]\n"
            "[elements]\ncount = 110\nbridge = 0.8\nreach = 3\nalong = [1, 0, 1]\nscale_min = 0.8\nscale_max "
            "= 1.1\n");
    const BuiltJob built = build_job(recipe_of(text, "p.toml"));
    const ElementPlan& plan = *built.elements;
    CHECK(plan.elements.size() == 110);
    CHECK(plan.bridges.size() > 5);
    // The surface's share that is solid, by chance; inside of the shell there is nothing.
    int on_surface = 0, solid = 0;
    const CounterHash draw(1, 0, 0, 0, 0);
    const Box box = built.designed.bounds;
    for (std::uint64_t i = 0; i < 200'000; ++i) {
        const dvec3 p = box.lo + box.size() * dvec3(draw.uniform(3 * i), draw.uniform(3 * i + 1),
                                                    draw.uniform(3 * i + 2));
        const double distance = is_torus ? to_torus(p) : to_ball(p);
        const bool is_solid = built.designed.part->value(p) < 0;
        if (distance > 0 || distance < -1) REQUIRE(!is_solid);
        if (distance > 0 || distance < -0.1) continue;
        ++on_surface;
        solid += is_solid ? 1 : 0;
    }
    const double area =
        is_torus ? 4 * glm::pi<double>() * glm::pi<double>() * 12 * 6 : 4 * glm::pi<double>() * 15 * 15;
    double bridged = 0;
    for (const ElementBridge& bridge : plan.bridges)
        bridged += 0.8 * (length(bridge.to - bridge.from) + 0.8) / area;
    const double share = solid / static_cast<double>(on_surface);
    CHECK(share > plan.volume - 0.03);
    CHECK(share < plan.volume + bridged + 0.03);
    // One piece, by the runs of layers 0.1 mm thick.
    StreamingComponents components;
    std::vector<EndedComponent> ended;
    const RowBand band = band_over(box, 0.1);
    const auto layers = static_cast<int>(box.size().z / 0.1);
    for (int layer = 0; layer < layers; ++layer) {
        const RunRows rows = runs_at(*built.designed.part, box.lo.z + 0.05 + 0.1 * layer, band);
        components.add(label_layer(rows, layer, Growth{}), layer, {}, ended);
    }
    components.finish(ended);
    constexpr double crumb = 10 * run_unit;  // a hundredth of a cubic millimetre
    CHECK(std::ranges::count_if(ended, [](const EndedComponent& e) {
              return !e.joined && static_cast<double>(e.component.extent.length) > crumb;
          }) == 1);
}

TEST_CASE("elements do not hold together through a thin wall", "[elements]") {
    // Both sides of a board, 4 mm thick, whose edges get no elements: two skins that nothing joins.
    const std::string text =
        "[part]\nshape = \"box\"\nsize = [40, 30, 4]\n[skin]\nthickness = 1\npattern = \"elements\"\n"
        "[[element]]\nkind = \"outline\"\ncorners = [[-3, -1], [3, -1], [3, 1], [-3, 1]]\n"
        "[elements]\ncount = 150\nbridge = 0.8\nreach = 2\n";
    const std::string without_edges = "density = \"abs(z) > 1.9 and abs(x) < 16 and abs(y) < 11\"\n";
    const std::string wrong = told(text + without_edges);
    if (wrong.empty()) {
        const ElementPlan plan = *build_job(recipe_of(text + without_edges, "p.toml")).elements;
        CHECK(plan.dropped > 60);
        const auto above =
            std::ranges::count_if(plan.elements, [](const PlacedElement& e) { return e.at.z > 0; });
        CHECK((above == 0 || above == std::ssize(plan.elements)));
    } else {
        CHECK(mentions(wrong, "of 150 elements touch no others"));
    }
    // With the edges, both sides are one piece.
    const BuiltJob around = build_job(recipe_of(text, "p.toml"));
    CHECK(around.elements->dropped < 8);
}

}  // namespace place_elements_test
