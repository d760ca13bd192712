// Analyses by the server's interface: their figures are those of the commands, and they end when they are
// told to.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "app/jobs/design_volume.h"
#include "app/reports/modulus_paint.h"
#include "tests/app/commands/command_run.h"
#include "tests/app/commands/mentions.h"
#include "tests/app/server/running_server.h"

namespace analysis_test {

using namespace lamella;

namespace {

using Json = nlohmann::ordered_json;

/// Plans of this process lie in a folder of their own.
class OwnPlans {
  public:
    OwnPlans() {
        if (const char* value = std::getenv("XDG_CACHE_HOME")) before_ = value;
        setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
    }
    ~OwnPlans() {
        if (before_) {
            setenv("XDG_CACHE_HOME", before_->c_str(), 1);
        } else {
            unsetenv("XDG_CACHE_HOME");
        }
    }
    OwnPlans(const OwnPlans&) = delete;
    OwnPlans& operator=(const OwnPlans&) = delete;

  private:
    Folder folder_;
    std::optional<std::string> before_;
};

const std::string block =
    "[part]\nshape = \"box\"\nsize = [20, 20, 20]\n[layers]\nheight = 0.5\n[printer]\nprofile = "
    "\"prusa-sl1s\"\n[material]\nname = \"pla\"\n";
const std::string foam = block + "[foam]\ncell = 4\nbeam = 0.6\n";

/// A cantilever: held at one end, loaded at the other.
std::string cantilever(int elements, int iterations) {
    return "[part]\nshape = \"box\"\nsize = [40, 20, 2]\n[layers]\nheight = 0.5\n[printer]\nprofile = "
           "\"prusa-sl1s\"\n[material]\nname = \"pla\"\n[[load]]\nbox = [[20, -2, -1], [20, 2, 1]]\nforce = "
           "[0, -10, 0]\n[[anchor]]\nface = \"-x\"\n[optimize]\ndimensions = 2\nelements = " +
           std::to_string(elements) + "\nvolume = 0.4\niterations = " + std::to_string(iterations) + "\n";
}

std::string place_of(const Json& analysis) {
    return "/api/analyses/" + std::to_string(analysis["analysis"].get<int>());
}

/// Waits until an analysis has a property; returns its description then.
template <typename Property>
Json awaited(const RunningServer& server, const Json& analysis, const Property& has) {
    while (true) {
        const Json now = server.json("GET", place_of(analysis));
        if (has(now)) return now;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

bool has_ended(const Json& analysis) {
    return analysis["state"] != "waiting" && analysis["state"] != "running";
}

Json finished(const RunningServer& server, const Json& analysis) {
    return awaited(server, analysis, has_ended);
}

/// A volume as the server sends it.
struct ReceivedVolume {
    Json head;
    std::string bytes;

    explicit ReceivedVolume(const std::string& reply) {
        std::uint32_t length = 0;
        REQUIRE(reply.size() > sizeof length);
        std::memcpy(&length, reply.data(), sizeof length);
        head = Json::parse(reply.substr(sizeof length, length));
        bytes = reply.substr(sizeof length + length);
        REQUIRE(bytes.size() == head["size"][0].get<std::size_t>() * head["size"][1].get<std::size_t>() *
                                    head["size"][2].get<std::size_t>() * head["channels"].get<std::size_t>());
    }
    unsigned at(std::size_t i) const { return static_cast<unsigned char>(bytes[i]); }
    /// Returns the byte of the voxel at a place, mm.
    unsigned at_place(dvec3 p) const {
        std::size_t index = 0, stride = head["channels"].get<std::size_t>();
        for (int k = 0; k < 3; ++k) {
            const auto axis = static_cast<std::size_t>(k);
            const double lo = head["lo"][axis].get<double>(), hi = head["hi"][axis].get<double>();
            const auto size = head["size"][axis].get<std::size_t>();
            const double share = (p[k] - lo) / (hi - lo);
            index += stride * std::min(size - 1, static_cast<std::size_t>(share * static_cast<double>(size)));
            stride *= size;
        }
        return at(index);
    }
};

}  // namespace

TEST_CASE("a foam is homogenised as the command does", "[server]") {
    const RunningServer server;
    const std::string job = server.build(foam);
    const Json started =
        server.json("POST", "/api/jobs/" + job + "/homogenize", {{"rve", 32}, {"samples", 2}}, 202);
    CHECK(started["kind"] == "homogenize");
    const Json ended = finished(server, started);
    CHECK(ended["state"] == "done");
    CHECK(ended["share"] == 1.0);
    Json result = ended["result"];

    const Json directions = result["directions"];
    const auto polar = directions["polar"].get<std::size_t>(),
               around = directions["around"].get<std::size_t>();
    const auto young = directions["young"].get<std::vector<double>>();
    REQUIRE(young.size() == polar * around);
    const auto [least, greatest] = std::ranges::minmax_element(young);
    CHECK(*least >= result["E_least"].get<double>() * 0.999);
    CHECK(*greatest <= result["E_greatest"].get<double>() * 1.001);
    CHECK(*greatest - *least > 0.5 * (result["E_greatest"].get<double>() - result["E_least"].get<double>()));
    // The first of the middle ring looks along x: E there is 1 / S_xx.
    CHECK(young[polar / 2 * around] != young[polar / 2 * around + around / 8]);
    CHECK(young[0] == Approx(young[around / 2]));  // a ring at a pole is one direction
    CHECK(result["law"].size() > 2);
    CHECK(result["law"][0]["young"].get<double>() < result["law"].back()["young"].get<double>());

    const Folder folder;
    write(folder / "foam.toml", foam);
    const Outcome run = run_lamella("homogenize -q --rve 32 --samples 2 --json " + folder / "foam.toml");
    REQUIRE(run.code == 0);
    result.erase("directions");
    result.erase("law");
    CHECK(result == Json::parse(run.out));
}

TEST_CASE("a long homogenisation ends soon when it is stopped", "[server]") {
    const RunningServer server;
    const std::string job = server.build(foam);
    const Json started =
        server.json("POST", "/api/jobs/" + job + "/homogenize", {{"rve", 256}, {"samples", 16}}, 202);
    awaited(server, started, [](const Json& now) { return now["state"] == "running"; });
    const auto before = std::chrono::steady_clock::now();
    server.json("POST", place_of(started) + "/stop", Json::object());
    const Json ended = finished(server, started);
    CHECK(std::chrono::steady_clock::now() - before < std::chrono::seconds(20));
    CHECK(ended["state"] == "cancelled");
    CHECK(ended["result"].is_null());
}

TEST_CASE("what cannot be homogenised is told with the command's words", "[server]") {
    const RunningServer server;
    const auto message = [&](const std::string& recipe, const Json& asked, int status) {
        return server
            .json("POST", "/api/jobs/" + server.build(recipe) + "/homogenize", asked, status)["message"]
            .get<std::string>();
    };
    CHECK(mentions(message(block, Json::object(), 400), "[foam] is missing"));
    const std::string graded = block + "[foam]\ncell = \"4 + 0.02 * z\"\nbeam = 0.6\n";
    CHECK(mentions(message(graded, Json::object(), 400), "a sample stands for one place"));
    CHECK(mentions(message(foam, {{"rve", 1000}}, 400), "rve: accepted: a whole number from 0 to 256"));
    CHECK(mentions(message(foam, {{"samples", "two"}}, 400), "samples: accepted"));
    CHECK(mentions(message(foam, {{"session", 3}}, 400), "session: accepted: a text"));
    server.json("POST", "/api/jobs/none/homogenize", Json::object(), 404);
    server.json("GET", "/api/analyses/1", {}, 404);
    server.json("GET", "/api/analyses/one", {}, 404);
    server.json("POST", "/api/analyses/1/stop", Json::object(), 404);
}

TEST_CASE("a search tells its steps and ends with the command's report", "[server]") {
    const OwnPlans plans;
    const RunningServer server;
    const std::string recipe = cantilever(32, 12);
    CHECK(mentions(server.json("POST", "/api/jobs", {{"text", recipe}, {"searches", false}}, 428)["message"]
                       .get<std::string>(),
                   "has to be optimised first"));
    const Json started = server.json("POST", "/api/optimize", {{"text", recipe}}, 202);
    const Json ended = finished(server, started);
    CHECK(ended["state"] == "done");
    CHECK(ended["steps"].size() == 12);
    CHECK(ended["designs"].get<int>() >= 1);
    CHECK(ended["steps"].front()["compliance"].get<double>() >
          ended["steps"].back()["compliance"].get<double>());
    CHECK(ended["steps"] == ended["result"]["history"]);

    const Folder folder;
    write(folder / "part.toml", recipe);
    const Outcome run = run_lamella("optimize -q --json " + folder / "part.toml");
    REQUIRE(run.code == 0);
    CHECK(ended["result"] == Json::parse(run.out));

    // The part that is sliced is the design: both are solid at the same places.
    const std::string job =
        server.json("POST", "/api/jobs", {{"text", recipe}, {"searches", false}})["job"].get<std::string>();
    const ReceivedVolume part(server.send("GET", "/api/jobs/" + job + "/volume?n=64")->body);
    const ReceivedVolume design(server.send("GET", place_of(ended) + "/volume")->body);
    int solid = 0, alike = 0, places = 0;
    for (double x = -19.5; x < 20; x += 1) {
        for (double y = -9.5; y < 10; y += 1) {
            const bool is_solid = part.at_place({x, y, 0.1}) > 127;
            solid += is_solid ? 1 : 0;
            alike += is_solid == (design.at_place({x, y, 0.1}) > 127) ? 1 : 0;
            ++places;
        }
    }
    CHECK(solid == Approx(0.4 * places).epsilon(0.1));
    CHECK(alike > 0.9 * places);
    CHECK(design.at_place({-20.9, 0, 0}) == 0);
}

TEST_CASE("a search that is stopped keeps its best design, and goes on from there", "[server]") {
    const OwnPlans plans;
    const RunningServer server;
    const std::string recipe = cantilever(160, 10000) + "tolerance = 1e-9\n";
    const Json started = server.json("POST", "/api/optimize", {{"text", recipe}}, 202);
    awaited(server, started, [](const Json& now) { return now["steps"].size() >= 3 || has_ended(now); });
    const ReceivedVolume early(server.send("GET", place_of(started) + "/volume")->body);
    CHECK(std::ranges::any_of(early.bytes, [](char value) { return value != 0; }));
    const auto before = std::chrono::steady_clock::now();
    server.json("POST", place_of(started) + "/stop", Json::object());
    const Json ended = finished(server, started);
    CHECK(std::chrono::steady_clock::now() - before < std::chrono::seconds(20));
    CHECK(ended["state"] == "cancelled");
    CHECK(mentions(ended["message"].get<std::string>(), "best design so far"));
    CHECK(ended["result"]["compliance_nmm"].get<double>() > 0);
    CHECK(ended["result"]["history"].size() == ended["steps"].size());
    // A design that is not the end of a search is no plan.
    server.json("POST", "/api/jobs", {{"text", recipe}, {"searches", false}}, 428);

    const Json more = server.json("POST", "/api/optimize", {{"text", recipe}, {"resume", true}}, 202);
    awaited(server, more, [](const Json& now) { return !now["steps"].empty() || has_ended(now); });
    server.json("POST", place_of(more) + "/stop", Json::object());
    const Json longer = finished(server, more);
    CHECK(longer["result"]["history"].size() == ended["steps"].size() + longer["steps"].size());

    server.json("DELETE", place_of(more));
    server.json("GET", place_of(more), {}, 404);
    CHECK(server.send("GET", place_of(more) + "/volume")->status == 404);
}

TEST_CASE("what cannot be optimised is told at once, or by its analysis", "[server]") {
    const OwnPlans plans;
    const RunningServer server;
    CHECK(mentions(server.json("POST", "/api/optimize", {{"text", block}}, 400)["message"].get<std::string>(),
                   "[optimize] is missing"));
    const Json mistakes = server.json("POST", "/api/optimize",
                                      {{"text", cantilever(32, 5) + "penalty = -1\n"}}, 422)["mistakes"];
    REQUIRE(mistakes.size() == 1);
    CHECK(mentions(mistakes[0]["text"].get<std::string>(), "optimize.penalty"));
    server.json("POST", "/api/optimize", Json::object(), 400);
    server.json("POST", "/api/optimize", {{"text", cantilever(32, 5)}, {"resume", 1}}, 400);
    server.json("POST", "/api/jobs", {{"text", block}, {"searches", 1}}, 400);
    std::string loose = cantilever(32, 5);
    loose.replace(loose.find("face = \"-x\""), 11, "box = [[90, 0, 0], [91, 1, 1]]");
    const Json ended = finished(server, server.json("POST", "/api/optimize", {{"text", loose}}, 202));
    CHECK(ended["state"] == "failed");
    CHECK(mentions(ended["message"].get<std::string>(),
                   "line 13: anchor: its place holds nothing of the part"));
    CHECK(!mentions(ended["message"].get<std::string>(), server.folder().path().string()));
    CHECK(ended["result"].is_null());
}

TEST_CASE("analyses wait for each other, few of them, and end with the server", "[server]") {
    const OwnPlans plans;
    const auto before = std::chrono::steady_clock::now();
    {
        const RunningServer server;
        const std::string recipe = cantilever(200, 10000) + "tolerance = 1e-9\n";
        const Json first = server.json("POST", "/api/optimize", {{"text", recipe}}, 202);
        awaited(server, first, [](const Json& now) { return now["state"] == "running"; });
        Json second;
        for (int i = 0; i < 4; ++i) second = server.json("POST", "/api/optimize", {{"text", recipe}}, 202);
        CHECK(server.json("GET", place_of(second))["state"] == "waiting");
        server.json("POST", "/api/optimize", {{"text", recipe}}, 503);
        server.json("DELETE", place_of(second));
        const Json third = server.json("POST", "/api/optimize", {{"text", recipe}}, 202);
        CHECK(server.json("POST", place_of(third) + "/stop", Json::object())["state"] == "cancelled");
        CHECK(server.json("GET", place_of(first))["state"] == "running");
        server.json("POST", "/api/optimize", {{"text", recipe}}, 202);
    }
    CHECK(std::chrono::steady_clock::now() - before < std::chrono::seconds(60));
}

TEST_CASE("news of an analysis comes to its session", "[server]") {
    const OwnPlans plans;
    RunningServer server;
    const auto listener = server.state().events.listen("mine");
    const auto other = server.state().events.listen("another");
    server.json("POST", "/api/optimize", {{"text", cantilever(24, 4)}, {"session", "mine"}}, 202);
    int steps = 0;
    std::string text;
    do {
        text = listener->next(30);
        REQUIRE(mentions(text, "event: analysis"));
        const Json news = Json::parse(text.substr(text.find("data: ") + 6));
        CHECK(news["kind"] == "optimize");
        CHECK(news["count"].get<int>() >= steps);
        steps = news["count"].get<int>();
        CHECK(news["step"].is_null() == (steps == 0));
    } while (!mentions(text, "\"state\":\"done\""));
    CHECK(steps == 4);
    CHECK(mentions(other->next(1), ": still here"));
}

TEST_CASE("the modulus of a graded foam is told place by place", "[server]") {
    const RunningServer server;
    const std::string graded = block + "[foam]\ncell = \"4 + 0.1 * x\"\nbeam = 0.6\n";
    const Json facts = server.json("POST", "/api/jobs", {{"text", graded}});
    const std::string job = "/api/jobs/" + facts["job"].get<std::string>();
    const ReceivedVolume volume(server.send("GET", job + "/modulus?n=40")->body);
    CHECK(volume.head["channels"] == 1);
    CHECK(volume.head["scale"]["lo_mpa"] == facts["modulus"]["predicted_MPa"][0]);
    CHECK(volume.head["scale"]["hi_mpa"] == facts["modulus"]["predicted_MPa"][1]);
    CHECK(volume.head["scale"]["is_asked"] == false);
    // Small cells, at small x, are the stiff ones. What is away from the part has no code.
    unsigned left = 0, right = 0;
    for (double y = -9; y < 10; y += 0.5) {
        left = std::max(left, volume.at_place({-9.5, y, 0}));
        right = std::max(right, volume.at_place({9.5, y, 0}));
    }
    CHECK(left > 240);
    CHECK(right > 2);
    CHECK(right < 20);
    CHECK(std::ranges::count(volume.bytes, '\0') > 0);
    CHECK(std::ranges::none_of(volume.bytes, [](char code) { return code == 1 || code == 2; }));

    const auto grey = server.send("GET", job + "/frame.png?width=64&cut=-")->body;
    const auto painted = server.send("GET", job + "/frame.png?width=64&cut=-&paint=modulus")->body;
    CHECK(grey != painted);
    CHECK(server.send("GET", job + "/frame.png?width=64&cut=-&paint=none")->body == grey);
    server.json("GET", job + "/frame.png?paint=stress", {}, 400);
}

TEST_CASE("foam that cannot be as asked has codes of its own", "[server]") {
    const RunningServer server;
    // Beams as thin as 0.2 mm are stiffer than 0.01 MPa, beams as thick as 0.7 mm softer than 400 MPa.
    const std::string asked =
        block + "[foam]\ncell = 4\nmodulus = \"x < 0 ? 0.01 : 2000\"\nbeam_min = 0.2\nbeam_max = 0.7\n";
    const std::string job = "/api/jobs/" + server.build(asked);
    const ReceivedVolume volume(server.send("GET", job + "/modulus?n=32")->body);
    CHECK(volume.head["scale"]["is_asked"] == true);
    std::size_t softer = 0, stiffer = 0, on_scale = 0;
    for (std::size_t i = 0; i < volume.bytes.size(); ++i) {
        softer += volume.at(i) == ModulusCode::softer ? 1 : 0;
        stiffer += volume.at(i) == ModulusCode::stiffer ? 1 : 0;
        on_scale += volume.at(i) >= ModulusCode::least ? 1 : 0;
    }
    CHECK(softer > 1000);
    CHECK(stiffer > 1000);
    CHECK(on_scale == 0);
    server.json("GET", "/api/jobs/" + server.build(block) + "/modulus", {}, 400);
    CHECK(mentions(
        server
            .json("GET", "/api/jobs/" + server.build(block) + "/frame.png?paint=modulus", {}, 400)["message"]
            .get<std::string>(),
        "the foam's modulus is unknown"));
    const std::string two = asked + "[plate]\ncopies = 2\n";
    server.json("GET", "/api/jobs/" + server.build(two) + "/modulus", {}, 400);
}

TEST_CASE("designs of solids and of foams become volumes with a margin", "[server]") {
    const std::vector<ElementUse> use{ElementUse::free, ElementUse::outside, ElementUse::free,
                                      ElementUse::free};
    const SearchedDesign design{{4, 1, 1}, Box{dvec3(0), dvec3(4, 1, 1)}, &use, [] {
                                    return std::vector<double>{0.2, 1, 0.1, 0.3};
                                }};
    const ReceivedVolume solid(design_volume(design, false));
    CHECK(solid.head["size"] == Json({6, 3, 3}));
    CHECK(solid.head["lo"] == Json({-1.0, -1.0, -1.0}));
    CHECK(solid.at_place({0.5, 0.5, 0.5}) == 51);
    CHECK(solid.at_place({1.5, 0.5, 0.5}) == 0);
    CHECK(solid.at_place({-0.5, 0.5, 0.5}) == 0);
    const ReceivedVolume foamed(design_volume(design, true));  // 0.2 on average
    CHECK(foamed.at_place({0.5, 0.5, 0.5}) == Approx(127.5).margin(0.5));
    CHECK(foamed.at_place({2.5, 0.5, 0.5}) == 64);
    CHECK(foamed.at_place({3.5, 0.5, 0.5}) == 191);
}

}  // namespace analysis_test
