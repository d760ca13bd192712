// The moves of a layer are those of the G-code file: read from the file by a reader of its own.
#include <cmath>
#include <optional>
#include <sstream>

#include "tests/app/commands/command_run.h"
#include "tests/app/server/running_server.h"

namespace layer_paths_test {

using namespace lamella;

namespace {

using Json = nlohmann::ordered_json;

/// A move in the plane as the file states it; mm on the bed, mm/min.
struct FileMove {
    bool lays = false;
    std::string role, width;
    dvec2 from{0}, to{0};
    double rate = 0;
    std::optional<dvec2> center;  ///< of an arc
    int tool = 0;
};

struct FileLayer {
    std::vector<FileMove> moves;
};

struct File {
    std::vector<FileLayer> layers;
    double seconds = 0;  ///< that the file states
};

/// Reads a file of relative extrusion word by word.
File read(const std::string& text) {
    File file;
    dvec2 at{0};
    double rate = 0;
    int tool = 0;
    std::string role, width;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line == ";LAYER_CHANGE") file.layers.emplace_back();
        if (line.starts_with(";TYPE:")) role = line.substr(6);
        if (line.starts_with(";WIDTH:")) width = line.substr(7);
        if (line.size() == 2 && line[0] == 'T') tool = line[1] - '0';
        if (line.starts_with("; estimated printing time")) {
            std::istringstream words(line.substr(line.find('=') + 1));
            for (std::string word; words >> word;) {
                const double unit = word.back() == 'd'   ? 86400
                                    : word.back() == 'h' ? 3600
                                    : word.back() == 'm' ? 60
                                                         : 1;
                file.seconds += std::stod(word) * unit;
            }
        }
        if (line.empty() || line[0] != 'G' || line.size() < 3 || line[2] != ' ') continue;
        std::map<char, double> words;
        std::istringstream rest(line.substr(2));
        for (std::string word; rest >> word;) words[word[0]] = std::stod(word.substr(1));
        if (words.contains('F')) rate = words['F'];
        if (!words.contains('X') && !words.contains('Y')) continue;
        FileMove move;
        move.lays = words.contains('E') && words['E'] > 0;
        move.role = role;
        move.width = width;
        move.tool = tool;
        move.from = at;
        move.to = {words.contains('X') ? words['X'] : at.x, words.contains('Y') ? words['Y'] : at.y};
        move.rate = rate;
        if (line[1] == '2' || line[1] == '3') move.center = at + dvec2(words['I'], words['J']);
        at = move.to;
        const bool is_end = role == "Custom";  // as the priming line before the layers
        if (!file.layers.empty() && !is_end) file.layers.back().moves.push_back(move);
    }
    return file;
}

dvec2 point(const Json& points, std::size_t i) {
    return {points.at(2 * i).get<double>(), points.at(2 * i + 1).get<double>()};
}

bool is_at(dvec2 a, dvec2 b, double far = 0.0011) {
    return std::abs(a.x - b.x) < far && std::abs(a.y - b.y) < far;
}

/// The figure of a segment, of a list where they vary.
double figure(const Json& line, const char* one, const char* all, std::size_t segment) {
    return line.contains(all) ? line[all].at(segment).get<double>() : line[one].get<double>();
}

/// Walks through the moves of a reply and those of the file, which have to agree.
class Walk {
  public:
    Walk(const FileLayer& layer, dvec2 shift) : moves_(layer.moves), shift_(shift) {
        while (at_ < moves_.size() && !moves_[at_].lays) ++at_;  // the way to the first path
    }

    void travel(const Json& line) {
        const Json& points = line["points"];
        REQUIRE(points.size() >= 4);
        for (std::size_t i = 0; i + 1 < points.size() / 2; ++i) {
            const FileMove& move = next(false);
            CHECK(is_at(point(points, i) + shift_, move.from));
            CHECK(is_at(point(points, i + 1) + shift_, move.to));
            CHECK(std::abs(figure(line, "speed", "speeds", i) * 60 - move.rate) < 0.01);
            seconds_ += glm::distance(move.to, move.from) / move.rate * 60;
            ++travels;
        }
    }

    void path(const Json& line) {
        const Json& points = line["points"];
        const std::size_t count = points.size() / 2;
        const std::size_t segments = line["closed"].get<bool>() ? count : count - 1;
        REQUIRE(segments > 0);
        for (const char* all : {"speeds", "widths"})
            if (line.contains(all)) CHECK(line[all].size() == segments);
        for (std::size_t i = 0; i < segments;) {
            const FileMove& move = next(true);
            CHECK(is_at(point(points, i) + shift_, move.from));
            CHECK(line["role"] == move.role);
            CHECK(line["tool"] == move.tool);
            CHECK(std::abs(figure(line, "speed", "speeds", i) * 60 - move.rate) < 0.01);
            CHECK(std::abs(figure(line, "width", "widths", i) - std::stod(move.width)) < 0.0006);
            seconds_ += glm::distance(move.to, move.from) / move.rate * 60;
            if (move.center) {
                const double radius = glm::distance(move.from, *move.center);
                while (!is_at(point(points, (i + 1) % count) + shift_, move.to)) {
                    ++i;
                    REQUIRE(i < segments);
                    CHECK(std::abs(glm::distance(point(points, i) + shift_, *move.center) - radius) < 0.002);
                    ++arc_points;
                }
            }
            CHECK(is_at(point(points, (i + 1) % count) + shift_, move.to));
            ++i;
            ++laid;
        }
    }

    bool has_ended() const { return at_ == moves_.size(); }
    /// Time at the stated speeds, without acceleration, s.
    double seconds() const { return seconds_; }

    int travels = 0, laid = 0, arc_points = 0;

  private:
    const FileMove& next(bool lays) {
        REQUIRE(at_ < moves_.size());
        const FileMove& move = moves_[at_++];
        REQUIRE(move.lays == lays);
        return move;
    }

    const std::vector<FileMove>& moves_;
    dvec2 shift_;
    std::size_t at_ = 0;
    double seconds_ = 0;
};

struct Compared {
    int travels = 0, laid = 0, arc_points = 0, with_speeds = 0, with_widths = 0, retracting = 0;
};

/// Compares the layers of a job with those of the command's file.
Compared compare(const std::string& recipe, std::vector<int> layers) {
    const RunningServer server;
    write(server.folder() / "part.toml", recipe);
    const std::string gcode = server.folder() / "part.gcode";
    REQUIRE(run_lamella("slice -q " + server.folder() / "part.toml" + " -o " + gcode).code == 0);
    const File file = read(contents(gcode));
    const std::string id = server.build(recipe);
    const Json job = server.json("GET", "/api/jobs/" + id);
    const auto count = job["layers"]["count"].get<std::size_t>();
    REQUIRE(file.layers.size() == count);
    const auto middle = [&](std::size_t axis) {
        return (job["bounds"]["lo"][axis].get<double>() + job["bounds"]["hi"][axis].get<double>()) / 2;
    };
    const dvec2 shift = dvec2(110, 110) - dvec2(middle(0), middle(1));  // the bed is 220 x 220 mm
    Compared compared;
    if (layers.empty())
        for (std::size_t k = 0; k < count; ++k) layers.push_back(static_cast<int>(k));
    double seconds = 0;
    for (const int k : layers) {
        INFO("layer " << k);
        const Json reply = server.json("GET", "/api/jobs/" + id + "/layers/" + std::to_string(k) + "/paths");
        Walk walk(file.layers[static_cast<std::size_t>(k)], shift);
        std::size_t travel = 0;
        for (std::size_t p = 0; p <= reply["paths"].size(); ++p) {
            for (; travel < reply["travels"].size() && reply["travels"][travel]["after"] == p; ++travel) {
                const Json& line = reply["travels"][travel];
                walk.travel(line);
                compared.retracting += line["retracts"].get<bool>();
                compared.with_speeds += line.contains("speeds");
            }
            if (p == reply["paths"].size()) break;
            const Json& line = reply["paths"][p];
            walk.path(line);
            compared.with_speeds += line.contains("speeds");
            compared.with_widths += line.contains("widths");
        }
        CHECK(walk.has_ended());
        CHECK(travel == reply["travels"].size());
        CHECK(reply["seconds"].get<double>() >= walk.seconds() * 0.999);
        seconds += reply["seconds"].get<double>();
        compared.travels += walk.travels;
        compared.laid += walk.laid;
        compared.arc_points += walk.arc_points;
    }
    CHECK(seconds <= file.seconds + 1);
    if (layers.size() == count)
        CHECK(seconds > 0.8 * file.seconds - 10);  // of 10 s some are for the priming line
    return compared;
}

const std::string machine = "[layers]\nheight = 0.2\n[printer]\nprofile = \"marlin\"\n";

}  // namespace

TEST_CASE("moves of foam are those of the file, slowed down and with their travel", "[server]") {
    const Compared seen = compare(
        "[part]\nshape = \"box\"\nsize = [18, 14, 2]\n[foam]\ncell = 4\nbeam = 0.7\n"
        "[skin]\nthickness = 0.9\n" +
            machine + "wipe = 2\nz_hop = 0.4\nleast_layer_time = 8\n",
        {});
    CHECK(seen.laid > 300);
    CHECK(seen.travels > 50);
    CHECK(seen.retracting > 5);
    CHECK(seen.with_widths > 0);
}

TEST_CASE("moves that the rate of lines slows down have their speeds one by one", "[server]") {
    const Compared seen =
        compare("[part]\nshape = \"gyroid\"\nsize = [12, 12, 1.2]\nperiod = 6\nthickness = 1.4\n" + machine +
                    "lines_per_second = 30\n",
                {});
    CHECK(seen.with_speeds > 0);
}

TEST_CASE("arcs of the file are chords of them", "[server]") {
    const Compared seen = compare("[part]\nshape = \"cylinder\"\nradius = 8\nheight = 1\n" + machine +
                                      "arcs = true\ninfill_density = 0.3\n",
                                  {});
    CHECK(seen.arc_points > 20);
}

TEST_CASE("moves of two tools are those of the file, with the purge tower", "[server]") {
    const Compared seen = compare(
        "[part]\nshape = \"box\"\nsize = [10, 10, 1.2]\ntool = \"soft\"\n[skin]\nthickness = "
        "1.2\ntool = \"hard\"\n[foam]\ncell = 4\nbeam = 0.8\n[[tool]]\nname = \"hard\"\n"
        "[[tool]]\nname = \"soft\"\n" +
            machine,
        {});
    CHECK(seen.laid > 200);
}

TEST_CASE("paths of a layer are given up for those of another one, and for a newer recipe", "[server]") {
    const RunningServer server;
    // Seconds of toolpaths.
    const std::string recipe =
        "[part]\nshape = \"box\"\nsize = [150, 150, 4]\n[foam]\ncell = 4\nbeam = 0.5\n" + machine +
        "infill_density = 0.4\n";
    const std::string layers = "/api/jobs/" + server.build(recipe) + "/layers/";
    const auto status_of = [&](int layer) {
        return server.status("GET", layers + std::to_string(layer) + "/paths?session=test");
    };
    int first = 0, second = 0;
    std::thread asking([&] { first = status_of(8); });
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    std::thread newer([&] { second = status_of(9); });
    asking.join();
    CHECK(first == 409);
    server.build("[part]\nshape = \"sphere\"\nradius = 5\n" + machine);
    newer.join();
    CHECK(second == 409);
    CHECK(server.send("GET", layers + "0/contours?session=test")->status == 200);
    // Other sessions and those without one are not concerned.
    const auto paths = [&](const std::string& rest) {
        return server.status("GET", layers + "19/paths" + rest);
    };
    std::thread other([&] { first = paths("?session=other"); });
    second = paths("");
    other.join();
    CHECK(first == 200);
    CHECK(second == 200);
}

}  // namespace layer_paths_test
