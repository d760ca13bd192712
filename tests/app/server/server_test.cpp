// The server's interface: what is answered, and that layers are those of the command.
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <set>

#include "engine/layers/layer.h"
#include "printers/masks/png_writer.h"
#include "tests/app/commands/command_run.h"
#include "tests/app/commands/mentions.h"
#include "tests/app/server/running_server.h"

namespace server_test {

using namespace lamella;

namespace {

using Json = nlohmann::ordered_json;

constexpr double pi = 3.14159265358979;

const std::string ball =
    "[part]\nshape = \"sphere\"\nradius = 5\n[layers]\nheight = 0.1\n[printer]\nprofile = \"prusa-sl1s\"\n";
const std::string foam = ball + "[foam]\ncell = 2\nbeam = 0.3\n";

template <typename T>
T number_at(const std::string& bytes, std::size_t at) {
    T value{};
    REQUIRE(at + sizeof value <= bytes.size());
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

/// Waits for an output; returns its last description.
Json finished(const RunningServer& server, int output) {
    while (true) {
        const Json state = server.json("GET", "/api/outputs/" + std::to_string(output));
        if (state["state"] != "waiting" && state["state"] != "running") return state;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

}  // namespace

TEST_CASE("mistakes of recipes are told with their lines", "[server]") {
    const RunningServer server;
    const auto mistakes = [&](const std::string& text) {
        return server.json("POST", "/api/jobs", {{"text", text}}, 422)["mistakes"];
    };
    const Json two = mistakes("[part]\nshape = \"sphere\"\nradius = -1\n[foam]\ncel = 3\nbeam = 0.1\n");
    REQUIRE(two.size() >= 2);
    CHECK(two[0]["line"] == 3);
    CHECK(mentions(two[0]["text"].get<std::string>(), "part.radius: -1 is too small"));
    CHECK(two[1]["line"] == 5);
    CHECK(mistakes("[part\n")[0]["line"] == 1);
    const Json formula =
        mistakes("[part]\nshape = \"sphere\"\nradius = 5\n[foam]\ncell = \"2 + \"\nbeam = 0.3\n");
    CHECK(formula[0]["line"] == 5);
    CHECK(mentions(formula[0]["text"].get<std::string>(), "foam.cell"));
}

TEST_CASE("no file outside the folder is reached", "[server]") {
    const RunningServer server;
    write(server.folder() / "a.toml", ball);
    std::filesystem::create_directory_symlink("/etc", server.folder().path() / "link");
    for (const std::string path : {"/etc/passwd", "../a.stl", "x/../../a.stl", "link/passwd", ".."}) {
        INFO(path);
        const std::string recipe = "[part]\nmesh = \"" + path + "\"\n";
        CHECK(
            mentions(server.json("POST", "/api/jobs", {{"text", recipe}}, 400)["message"].get<std::string>(),
                     "lies outside the served folder"));
        server.json("PUT", "/api/recipe", {{"text", ball}, {"path", path + ".toml"}},
                    path == ".." ? 200 : 400);
        CHECK(server.send("POST", "/api/files?name=" + path, "solid")->status == 400);
    }
    const std::string machine =
        "[part]\nshape = \"sphere\"\nradius = 5\n[printer]\nprofile = \"/etc/machine.toml\"\n";
    server.json("POST", "/api/jobs", {{"text", machine}}, 400);
    const std::string job = server.build(ball);
    server.json("POST", "/api/jobs/" + job + "/outputs", {{"file", "../b.sl1"}}, 400);
    server.json("POST", "/api/jobs/" + job + "/outputs", {{"file", "b.gcode"}}, 400);
    server.json("POST", "/api/jobs/" + job + "/outputs", {{"file", "a.toml"}}, 400);
}

TEST_CASE("files that are sent are kept under their names, and none is lost", "[server]") {
    const RunningServer server;
    const auto keep = [&](const std::string& name, const std::string& bytes) {
        return Json::parse(server.send("POST", "/api/files?name=" + name, bytes)->body)["path"]
            .get<std::string>();
    };
    CHECK(keep("cube.stl", "one") == "cube.stl");
    CHECK(keep("cube.stl", "one") == "cube.stl");
    CHECK(keep("cube.stl", "two") == "cube-2.stl");
    CHECK(contents(server.folder() / "cube.stl") == "one");
    CHECK(contents(server.folder() / "cube-2.stl") == "two");
    for (const char* name : {"a.exe", ".stl", "a%2Fb.stl", "a", "", "a%00.stl", "a.sh"}) {
        INFO(name);
        CHECK(server.send("POST", std::string("/api/files?name=") + name, "x")->status == 400);
    }
}

TEST_CASE("layers are those of the job, in every form", "[server]") {
    const RunningServer server;
    const std::string id = server.build(foam), base = "/api/jobs/" + id + "/layers/40/";
    const auto job = const_cast<RunningServer&>(server).state().jobs.find(id);
    const Layer layer(job->job(), 40);
    SECTION("runs") {
        RowBand band{.axis = Axis::x, .along_pitch = 0.05, .across_pitch = -0.05};
        band.along_origin = -5;
        band.across_origin = 5;
        band.hi = band.count = 200;
        RunRows rows;
        layer.runs(band, rows);
        const std::string bytes =
            server.send("GET", base + "runs?columns=200&rows=200&x=-5&y=5&pitch_x=0.05&pitch_y=-0.05")->body;
        const auto head = number_at<std::uint32_t>(bytes, 0);
        const Json json = Json::parse(bytes.substr(4, head));
        REQUIRE(json["lines"] == rows.lines());
        REQUIRE(json["runs"] == rows.runs().size());
        const std::size_t first = 4 + head, runs = first + 4 * (rows.lines() + 1);
        REQUIRE(bytes.size() == runs + 8 * rows.runs().size());
        for (std::size_t l = 0; l < rows.lines(); ++l) {
            CHECK(number_at<std::uint32_t>(bytes, first + 4 * (l + 1)) -
                      number_at<std::uint32_t>(bytes, first + 4 * l) ==
                  rows.line(l).size());
        }
        for (std::size_t i = 0; i < rows.runs().size(); ++i) {
            CHECK(number_at<std::int32_t>(bytes, runs + 8 * i) == rows.runs()[i].begin);
            CHECK(number_at<std::int32_t>(bytes, runs + 8 * i + 4) == rows.runs()[i].end);
        }
    }
    SECTION("contours") {
        const Json json = server.json("GET", base + "contours?tolerance=0.01");
        const std::vector<Contour> contours = layer.contours(0.01);
        REQUIRE(json["contours"].size() == contours.size());
        double area = 0;
        for (std::size_t i = 0; i < contours.size(); ++i) {
            area += signed_area(contours[i].points);
            REQUIRE(json["contours"][i]["points"].size() == 2 * contours[i].points.size());
            CHECK(json["contours"][i]["points"][1] == contours[i].points[0].y);
        }
        CHECK(json["area"].get<double>() == Approx(area));
    }
    SECTION("pictures") {
        // A window off the middle, 3 x 2 mm in pixels of 0.02 mm, its first row at the largest y.
        RowBand band{.axis = Axis::x, .along_pitch = 0.02, .across_pitch = -0.02};
        band.along_origin = -1;
        band.across_origin = 2.5;
        band.hi = 150;
        band.count = 100;
        band.sub = 4;
        RunRows rows;
        layer.runs(band, rows);
        std::vector<GreyRun> greys;
        coverage(band, rows, greys);
        const std::vector<std::byte> expected = encode_png({150, 100}, greys);
        const std::string sent =
            server.send("GET", base + "mask.png?width=150&x0=-1&x1=2&y0=0.5&y1=2.5")->body;
        REQUIRE(sent.size() == expected.size());
        CHECK(std::memcmp(sent.data(), expected.data(), sent.size()) == 0);
        // In colours the same pixels number a palette.
        const std::string coloured =
            server.send("GET", base + "mask.png?width=150&x0=-1&x1=2&y0=0.5&y1=2.5&colors=1")->body;
        CHECK(coloured.size() == sent.size() + 3 * 256 + 12);
        CHECK(mentions(coloured.substr(0, 64), "PLTE"));
    }
}

TEST_CASE("curve and volume measure a ball", "[server]") {
    const RunningServer server;
    const std::string base = "/api/jobs/" + server.build(ball);
    const Json curve = server.json("GET", base + "/curve?values=50");
    CHECK(curve["layers_a_value"] == 2);
    REQUIRE(curve["area_mm2"].size() == 50);
    for (int i = 0; i < 50; ++i) {
        const double z = (2 * i + 1.5) * 0.1 - 5;
        CHECK(curve["area_mm2"][static_cast<std::size_t>(i)].get<double>() ==
              Approx(pi * (25 - z * z)).epsilon(0.02).margin(0.2));
    }
    const std::string bytes = server.send("GET", base + "/volume?n=64")->body;
    const auto head = number_at<std::uint32_t>(bytes, 0);
    const Json json = Json::parse(bytes.substr(4, head));
    CHECK(json["size"] == Json{64, 64, 64});
    REQUIRE(bytes.size() == 4 + head + 2 * 64 * 64 * 64);
    double part = 0, supports = 0;
    for (std::size_t at = 4 + head; at < bytes.size(); at += 2) {
        part += static_cast<unsigned char>(bytes[at]) / 255.0;
        supports += static_cast<unsigned char>(bytes[at + 1]);
    }
    const double voxel = 10.0 / 64;
    CHECK(part * voxel * voxel * voxel == Approx(4 * pi / 3 * 125).epsilon(0.005));
    CHECK(supports == 0);
}

TEST_CASE("an output has the bytes of the command's", "[server]") {
    const RunningServer server;
    write(server.folder() / "foam.toml", foam);
    REQUIRE(
        run_lamella("slice -q " + server.folder() / "foam.toml" + " -o " + server.folder() / "by_command.sl1")
            .code == 0);
    const std::string job = server.build(foam);
    const int kept =
        server.json("POST", "/api/jobs/" + job + "/outputs", {{"file", "by_server.sl1"}}, 202)["output"];
    CHECK(finished(server, kept)["state"] == "done");
    // SL1 archives are called as their files within.
    const auto sizes = [&](const std::string& name) {
        return std::filesystem::file_size(server.folder() / name);
    };
    CHECK(std::abs(static_cast<double>(sizes("by_server.sl1")) -
                   static_cast<double>(sizes("by_command.sl1"))) < 4096);
    const int sent = server.json("POST", "/api/jobs/" + job + "/outputs", {}, 202)["output"];
    const Json done = finished(server, sent);
    CHECK(done["done"] == 100);
    const auto file = server.send("GET", "/api/outputs/" + std::to_string(sent) + "/file");
    CHECK(file->body == contents(server.folder() / "by_server.sl1"));
    CHECK(file->body.size() == done["bytes"]);
    CHECK(mentions(file->get_header_value("Content-Disposition"), done["file"].get<std::string>()));
    server.json("DELETE", "/api/outputs/" + std::to_string(sent));
    server.json("GET", "/api/outputs/" + std::to_string(sent), {}, 404);
    server.json("POST", "/api/jobs/" + job + "/outputs", {{"file", "by_server.sl1"}}, 400);  // exists
}

TEST_CASE("a newer recipe of a session ends the older one's build", "[server]") {
    const RunningServer server;
    // A search that takes minutes.
    const std::string slow =
        "[part]\nshape = \"box\"\nsize = [60, 20, 20]\n[layers]\nheight = 0.1\n[optimize]\nvolume = "
        "0.3\nelement = 0.6\n"
        "[[anchor]]\nat = [-30, 0, 0]\nradius = 5\n[[load]]\nat = [30, 0, 0]\nradius = 5\nforce = [0, 0, "
        "-10]\n";
    std::atomic<int> status{0};
    std::thread first([&] {
        const Json request{{"text", slow}, {"session", "a"}, {"sequence", 1}};
        status = server.status("POST", "/api/jobs", request.dump());
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    const int before = status;
    server.json("POST", "/api/jobs", {{"text", ball}, {"session", "a"}, {"sequence", 2}});
    first.join();
    if (before == 0) CHECK(status == 409);
    CHECK(server.json("POST", "/api/jobs", {{"text", ball}, {"session", "a"}, {"sequence", 1}}, 409)
              .contains("message"));
}

TEST_CASE("a newer recipe of a session ends what is computed for the one before", "[server]") {
    RunningServer server;
    // Some seconds of foam.
    const std::string recipe = "[part]\nshape = \"box\"\nsize = [60, 60, 60]\n[foam]\ncell = 1\nbeam = 0.1\n";
    const std::string job = server.build(recipe);
    int status = 0;
    std::thread asking(
        [&] { status = server.status("GET", "/api/jobs/" + job + "/volume?n=256&session=test"); });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    // One with mistakes leaves the job on the page.
    server.json("POST", "/api/jobs", {{"text", "[part]\n"}, {"session", "test"}, {"sequence", 1000}}, 422);
    CHECK_FALSE(server.state().jobs.work_of("test")->cancelled());
    const auto begun = std::chrono::steady_clock::now();
    server.json(
        "POST", "/api/jobs",
        {{"text", "[part]\nshape = \"sphere\"\nradius = 5\n"}, {"session", "test"}, {"sequence", 1001}});
    asking.join();
    CHECK(status == 409);
    CHECK(std::chrono::steady_clock::now() - begun < std::chrono::seconds(5));
    // Other sessions are not concerned, and the next request is.
    CHECK(server.send("GET", "/api/jobs/" + job + "/volume?n=8&session=test")->status == 200);
    CHECK(server.state().jobs.work_of("other") == nullptr);

    // So does the end of the session.
    const std::string again =
        server.json("POST", "/api/jobs", {{"text", recipe}, {"session", "test"}, {"sequence", 1002}})
            .at("job")
            .get<std::string>();
    std::thread waiting(
        [&] { status = server.status("GET", "/api/jobs/" + again + "/curve?values=4096&session=test"); });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    server.json("DELETE", "/api/sessions/test");
    waiting.join();
    CHECK(status == 409);
    CHECK(server.state().jobs.work_of("test") == nullptr);
    server.json("DELETE", "/api/sessions/nobody");
}

TEST_CASE("events of a session come to its listeners", "[server]") {
    RunningServer server;
    const std::string job = server.build(foam);
    std::string text;
    httplib::Client client = server.client();
    std::thread listener([&] {
        client.Get(("/api/events?session=one&token=" + test_token).c_str(),
                   [&](const char* data, std::size_t size) {
                       text.append(data, size);
                       return text.find("\"state\":\"done\"") == std::string::npos;
                   });
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    server.json("POST", "/api/jobs/" + job + "/outputs", {{"session", "one"}}, 202);
    listener.join();
    CHECK(text.starts_with("event: hello\ndata: {\"session\":\"one\""));
    CHECK(mentions(text, "event: output\ndata: {\"output\":1,\"state\":\"running\""));
}

TEST_CASE("many at once and slow readers are served or told to come back", "[server]") {
    const RunningServer server;
    const std::string job = server.build(foam);
    std::atomic<int> answered{0}, others{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 40; ++t) {
        threads.emplace_back([&, t] {
            for (int i = 0; i < 25; ++i) {
                const int layer = (t * 25 + i) % 100;
                const auto reply =
                    server.client().Get(("/api/jobs/" + job + "/layers/" + std::to_string(layer) +
                                         "/contours?token=" + test_token)
                                            .c_str());
                ++(reply && reply->status == 200 ? answered : others);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    CHECK(answered + others == 1000);
    CHECK(answered > 950);
    // One that takes its time does not hold up others.
    httplib::Client slow = server.client();
    slow.Get(("/api/jobs/" + job + "/volume?n=128&token=" + test_token).c_str(),
             [&](const char*, std::size_t) {
                 return server.status("GET", "/api/version") != 200;  // then it goes
             });
    CHECK(server.send("GET", "/api/version")->status == 200);
}

TEST_CASE("the form's values, edits and saving go together", "[server]") {
    ServerOptions options;
    options.recipe = "part.toml";
    const RunningServer server(options);
    write(server.folder() / "part.toml", "# mine\n" + ball);
    const Json recipe = server.json("GET", "/api/recipe");
    CHECK(recipe["path"] == "part.toml");
    const Json edited = server.json(
        "POST", "/api/edit",
        {{"text", recipe["text"]}, {"changes", {{{"section", "part"}, {"key", "radius"}, {"value", "7"}}}}});
    CHECK(mentions(edited["text"].get<std::string>(), "# mine\n[part]\nshape = \"sphere\"\nradius = 7\n"));
    CHECK(server.json("POST", "/api/values", edited)["values"]["part.radius"] == "7");
    server.json("PUT", "/api/recipe", edited);
    CHECK(contents(server.folder() / "part.toml") == edited["text"].get<std::string>());
    server.json("PUT", "/api/recipe", {{"text", "x"}, {"path", "a.stl"}}, 400);
    // Others' files are not replaced, its own may be.
    write(server.folder() / "other.toml", "# theirs");
    server.json("PUT", "/api/recipe", {{"text", "x"}, {"path", "other.toml"}}, 400);
    CHECK(contents(server.folder() / "other.toml") == "# theirs");
    for (const char* text : {"# one", "# two"}) {
        server.json("PUT", "/api/recipe", {{"text", text}, {"path", "new.toml"}});
        CHECK(contents(server.folder() / "new.toml") == text);
    }
    const Json wrong = server.json(
        "POST", "/api/edit",
        {{"text", recipe["text"]}, {"changes", {{{"section", "part"}, {"key", "radius"}, {"value", "x"}}}}},
        422);
    CHECK(mentions(wrong["message"].get<std::string>(), "part.radius"));
}

TEST_CASE("every example can be built", "[server]") {
    const RunningServer server;
    const Json examples = server.json("GET", "/api/examples");
    CHECK(examples.size() >= 12);
    for (const Json& example : examples) {
        INFO(example["name"]);
        CHECK(!example["title"].get<std::string>().empty());
        server.build(example["text"].get<std::string>());
    }
}

TEST_CASE("settings, machines and kinds are complete", "[server]") {
    const RunningServer server;
    const Json settings = server.json("GET", "/api/settings");
    std::set<std::string> sections;
    for (const Json& section : settings["sections"]) sections.insert(section["name"].get<std::string>());
    for (const Json& setting : settings["settings"]) {
        CHECK(sections.contains(setting["section"].get<std::string>()));
        CHECK((setting["type"] != "choice" || !setting["choices"].empty()));
        CHECK(!setting["help"].get<std::string>().empty());
    }
    bool has_marlin = false;
    for (const Json& machine : server.json("GET", "/api/machines"))
        has_marlin = has_marlin || (machine["name"] == "marlin" && machine["process"] == "filament" &&
                                    machine["extension"] == ".gcode");
    CHECK(has_marlin);
    CHECK(settings["kinds"].size() > 3);
}

}  // namespace server_test
