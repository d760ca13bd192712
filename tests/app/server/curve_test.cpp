// Curves over the layers: islands of boxes that float, and times of beads and of exposures.
#include <cmath>

#include "tests/app/commands/boxes_mesh.h"
#include "tests/app/commands/mentions.h"
#include "tests/app/server/running_server.h"

namespace curve_test {

using namespace lamella;

namespace {

using Json = nlohmann::ordered_json;

const std::string boxes =
    "[part]\nmesh = \"boxes.obj\"\n[layers]\nheight = 0.2\n[printer]\nprofile = \"generic-4k\"\n";

/// A column of 10 mm with a roof, two boxes that begin in layer 15 and one that begins in layer 26.
std::vector<Box> floating() {
    return {{{-2, -2, 0}, {2, 2, 9}},
            {{-8, -8, 8.4}, {8, 8, 10}},
            {{4, 4, 3}, {6, 6, 6}},
            {{-6, 4, 3}, {-4, 6, 4}},
            {{-6, -6, 5.2}, {-4, -4, 9}}};
}

}  // namespace

TEST_CASE("the curve of islands counts what begins with nothing below", "[server]") {
    const RunningServer server;
    write(server.folder() / "boxes.obj", boxes_obj(floating()));
    const std::string curve = "/api/jobs/" + server.build(boxes) + "/curve/islands";
    const Json all = server.json("GET", curve + "?values=400");
    CHECK(all["layers_a_value"] == 1);
    REQUIRE(all["islands"].size() == 50);
    for (int k = 0; k < 50; ++k) {
        INFO("layer " << k);
        CHECK(all["islands"][static_cast<std::size_t>(k)] == (k == 15 ? 2 : k == 26 ? 1 : 0));
    }
    const Json tens = server.json("GET", curve + "?values=5");
    CHECK(tens["layers_a_value"] == 10);
    CHECK(tens["islands"] == Json{0, 2, 1, 0, 0});
}

TEST_CASE("what supports hold is no island", "[server]") {
    const RunningServer server;
    write(server.folder() / "boxes.obj",
          boxes_obj({{{-2, -2, 0}, {2, 2, 8}}, {{-8, -8, 6}, {8, 8, 8}}, {{4, 4, 2}, {7, 7, 6.5}}}));
    const auto islands = [&](const std::string& more) {
        const Json curve = server.json("GET", "/api/jobs/" + server.build(boxes + more) + "/curve/islands");
        int sum = 0;
        for (const Json& one : curve["islands"]) sum += one.get<int>();
        return sum;
    };
    CHECK(islands("") == 1);
    CHECK(islands("[support]\ntip = 0.5\n") == 0);
    CHECK(islands("[support]\ntip = 0.5\ngap = 0.3\n") == 0);
}

TEST_CASE("times of resin are exposures and moves", "[server]") {
    const RunningServer server;
    const std::string ball = "[part]\nshape = \"sphere\"\nradius = 2\n[layers]\nheight = 0.2\n[printer]\n";
    const std::string resin = ball +
                              "profile = \"generic-4k\"\nexposure = 2\nfirst_exposure = 20\n"
                              "first_layers = 3\nfade_layers = 5\n";
    const Json curve = server.json("GET", "/api/jobs/" + server.build(resin) + "/curve/time");
    REQUIRE(curve["seconds"].size() == 20);
    const auto seconds = [&](std::size_t k) { return curve["seconds"][k].get<double>(); };
    const double moves = seconds(19) - 2;
    CHECK(moves > 0);
    for (std::size_t k = 0; k < 20; ++k) {
        const double faded =
            std::clamp((static_cast<double>(k) - 2) / 6, 0.0, 1.0);  // the sixth step is full
        INFO("layer " << k);
        CHECK(seconds(k) - moves == Approx(20 - 18 * faded));
    }
    for (const char* other : {"laser-k40", "grbl-laser", "binder-jet-300"}) {
        INFO(other);
        const std::string job = server.build(ball + "profile = \"" + other + "\"\n");
        const Json refused = server.json("GET", "/api/jobs/" + job + "/curve/time", {}, 400);
        CHECK(mentions(refused["message"].get<std::string>(), "no time of its layers is known"));
    }
}

TEST_CASE("times of beads are those of their paths", "[server]") {
    const RunningServer server;
    const std::string job = "/api/jobs/" + server.build(
                                               "[part]\nshape = \"sphere\"\nradius = 3\n[layers]\nheight = "
                                               "0.2\n[printer]\nprofile = \"marlin\"\n");
    const Json curve = server.json("GET", job + "/curve/time?values=10");
    CHECK(curve["layers_a_value"] == 3);
    REQUIRE(curve["seconds"].size() == 10);
    for (int i = 0; i < 10; ++i) {
        const Json paths = server.json("GET", job + "/layers/" + std::to_string(3 * i + 1) + "/paths");
        CHECK(curve["seconds"][static_cast<std::size_t>(i)] == paths["seconds"]);
    }
}

}  // namespace curve_test
