// What a part is made of, place by place: against closed forms, and against the same part without its frame.
#include <cmath>
#include <cstring>

#include "tests/app/commands/mentions.h"
#include "tests/app/server/running_server.h"

namespace structure_test {

using namespace lamella;

namespace {

using Json = nlohmann::ordered_json;

/// A volume that the server sends.
struct Volume {
    Json head;
    std::string bytes;
    int nx = 0, ny = 0, nz = 0, channels = 0;
    double voxel = 0;

    int at(int x, int y, int z, int channel) const {
        const auto in = [](int number) { return static_cast<std::size_t>(number); };
        const std::size_t voxel_place = (in(z)*in(ny) + in(y)) * in(nx) + in(x);
        return static_cast<unsigned char>(bytes[voxel_place * in(channels) + in(channel)]);
    }
    dvec3 middle(int x, int y, int z) const {
        const auto lo = [&](std::size_t k) { return head["lo"][k].get<double>(); };
        return {lo(0) + (x + 0.5) * voxel, lo(1) + (y + 0.5) * voxel, lo(2) + (z + 0.5) * voxel};
    }
    template <typename Visit>
    void for_each(Visit visit) const {
        for (int z = 0; z < nz; ++z)
            for (int y = 0; y < ny; ++y)
                for (int x = 0; x < nx; ++x) visit(x, y, z);
    }
};

Volume volume(const RunningServer& server, const std::string& path) {
    const auto reply = server.send("GET", path);
    REQUIRE(reply->status == 200);
    std::uint32_t length = 0;
    std::memcpy(&length, reply->body.data(), sizeof length);
    Volume found;
    found.head = Json::parse(reply->body.substr(4, length));
    found.bytes = reply->body.substr(4 + length);
    found.nx = found.head["size"][0];
    found.ny = found.head["size"][1];
    found.nz = found.head["size"][2];
    found.channels = found.head["channels"];
    found.voxel = (found.head["hi"][0].get<double>() - found.head["lo"][0].get<double>()) / found.nx;
    REQUIRE(static_cast<std::int64_t>(found.bytes.size()) ==
            std::int64_t{found.nx} * found.ny * found.nz * found.channels);
    return found;
}

/// The byte of a distance, positive inside.
double byte_of(double inside, double voxel) {
    return 128 + 127 * std::clamp(inside / (2 * voxel), -1.0, 1.0);
}

const std::string ball =
    "[part]\nshape = \"sphere\"\nradius = 6\n[layers]\nheight = 0.2\n[printer]\nprofile = "
    "\"generic-4k\"\n[foam]\ncell = 3\nbeam = 0.4\n";

}  // namespace

TEST_CASE("skin and solid regions lie where their closed forms are", "[server]") {
    const RunningServer server;
    const std::string recipe =
        ball +
        "[skin]\nthickness = 0.9\n[[field]]\nname = \"core\"\nkind = \"sphere\"\nradius = "
        "2\nat = [1, 0, 0]\n[[region]]\nfield = \"core\"\nmake = \"solid\"\n";
    const std::string id = server.build(recipe);
    const Json job = server.json("GET", "/api/jobs/" + id);
    CHECK(job["structure"] == Json{"skin", "solid", "foam"});
    const Volume found = volume(server, "/api/jobs/" + id + "/structure?n=40");
    CHECK(found.head["parts"] == job["structure"]);
    REQUIRE(found.channels == 3);
    int near = 0, off = 0;
    found.for_each([&](int x, int y, int z) {
        if (found.at(x, y, z, 0) == 0) return;
        ++near;
        const dvec3 p = found.middle(x, y, z);
        const double skin = byte_of(length(p) - 5.1, found.voxel);
        const double core = byte_of(2 - length(p - dvec3(1, 0, 0)), found.voxel);
        off += std::abs(found.at(x, y, z, 0) - skin) > 1 || found.at(x, y, z, 1) != 1 ||
               std::abs(found.at(x, y, z, 2) - core) > 1;
    });
    CHECK(near > 10000);
    CHECK(off == 0);
}

TEST_CASE("a frame is what the part lacks without it", "[server]") {
    const RunningServer server;
    const std::string with = server.build(ball + "[frame]\nbeam = 0.4\n");
    CHECK(server.json("GET", "/api/jobs/" + with)["structure"] == Json{"frame", "foam"});
    const Volume found = volume(server, "/api/jobs/" + with + "/structure?n=96");
    const Volume solid = volume(server, "/api/jobs/" + with + "/volume?n=96");
    const Volume without = volume(server, "/api/jobs/" + server.build(ball) + "/volume?n=96");
    int framed = 0, missed = 0, inside = 0, wrong = 0;
    solid.for_each([&](int x, int y, int z) {
        if (solid.at(x, y, z, 0) < 255) return;
        const bool is_frame = found.at(x, y, z, 1) > 128;
        if (without.at(x, y, z, 0) == 0) {
            ++framed;
            missed += !is_frame;
        }
        if (length(solid.middle(x, y, z)) < 6 - 3 * 0.4) {
            ++inside;
            wrong += is_frame;
        }
    });
    CHECK(framed > 1000);
    CHECK(inside > 1000);
    CHECK(missed <= framed / 50);  // joints that leave the surface
    CHECK(wrong <= inside / 50);
}

TEST_CASE("a part of one thing has no structure", "[server]") {
    const RunningServer server;
    const std::string id = server.build(ball);
    CHECK(server.json("GET", "/api/jobs/" + id)["structure"] == Json::array());
    const Json refused = server.json("GET", "/api/jobs/" + id + "/structure", {}, 400);
    CHECK(mentions(refused["message"].get<std::string>(), "nothing can be told apart"));
}

TEST_CASE("graded numbers lie where their formulas put them", "[server]") {
    const RunningServer server;
    const std::string recipe =
        "[part]\nshape = \"box\"\nsize = [20, 8, 8]\nturn = [0, 0, 90]\n[layers]\nheight = 0.2\n"
        "[printer]\nprofile = \"generic-4k\"\n[[grading]]\nname = \"along\"\nkind = \"formula\"\n"
        "formula = \"x * x\"\n[foam]\ncell = \"3 + 0.05 * x\"\nbeam = 0.4\n";
    const std::string id = server.build(recipe);
    CHECK(server.json("GET", "/api/jobs/" + id)["numbers"] ==
          Json{{{"name", "foam.cell"}, {"unit", "mm"}}, {{"name", "along"}, {"unit", ""}}});
    const auto check = [&](const std::string& name, double lo, double hi, auto number) {
        const Volume found = volume(server, "/api/jobs/" + id + "/numbers?n=40&of=" + name);
        const auto end = [&](const char* which) { return found.head["scale"][which].get<double>(); };
        CHECK(end("lo") == Approx(lo).margin(0.05 * (hi - lo)));
        CHECK(end("hi") == Approx(hi).margin(0.07 * (hi - lo)));
        int near = 0, off = 0;
        found.for_each([&](int x, int y, int z) {
            const int code = found.at(x, y, z, 0);
            if (code == 0) return;
            ++near;
            // The part was turned: y of the job is x of the recipe.
            const double share = (number(found.middle(x, y, z).y) - end("lo")) / (end("hi") - end("lo"));
            off += std::abs(code - (3 + 252 * std::clamp(share, 0.0, 1.0))) > 1;
        });
        CHECK(near > 1000);
        CHECK(off == 0);
    };
    check("foam.cell", 2.5, 3.5, [](double x) { return 3 + 0.05 * std::clamp(x, -10.0, 10.0); });
    check("along", 0, 100, [](double x) { return x * x; });
    CHECK(mentions(server.json("GET", "/api/jobs/" + id + "/numbers?of=foam.beam", {}, 400)["message"]
                       .get<std::string>(),
                   "accepted: foam.cell, along"));
}

}  // namespace structure_test
