// Outputs by their paths: folders of pictures, endings that do not suit a machine, and runs that are done
// already.
#include <catch2/catch.hpp>

#include "tests/app/commands/command_run.h"

namespace output_paths_test {

using namespace lamella;

namespace fs = std::filesystem;

namespace {

const std::string ball = "slice --shape sphere --shape-radius 2 --layer-height 0.4 --quiet ";

}  // namespace

TEST_CASE("a cutter's folder gets one picture a layer", "[output]") {
    const Folder folder;
    REQUIRE(run_lamella(ball + "--printer svg -o " + folder / "out/").code == 0);
    int pictures = 0;
    for (const auto& [name, bytes] : tree(folder / "out")) {
        if (!name.ends_with(".svg")) continue;
        ++pictures;
        CHECK(mentions(bytes, "<svg"));
        CHECK(mentions(bytes, "</svg>"));
    }
    CHECK(pictures == 10);
}

TEST_CASE("a run that is complete already is no mistake", "[output]") {
    for (const std::string name : {"ball.sl1@prusa-sl1s", "ball.svg@svg", "ball.gcode@marlin", "masks@png"}) {
        INFO(name);
        const Folder folder;
        REQUIRE(run_lamella(ball + "-o " + folder / name).code == 0);
        const std::string path = folder / name.substr(0, name.find('@'));
        const auto made =
            fs::is_directory(path) ? tree(path) : std::map<std::string, std::string>{{"", contents(path)}};
        const std::string again =
            "slice --shape sphere --shape-radius 2 --layer-height 0.4 --resume -o " + folder / name;
        const Outcome second = run_lamella(again);
        CHECK(second.code == 0);
        CHECK(mentions(second.err, "complete already"));
        CHECK((fs::is_directory(path) ? tree(path)
                                      : std::map<std::string, std::string>{{"", contents(path)}}) == made);
        // Without --resume, nothing is replaced unasked.
        CHECK(run_lamella(ball + "-o " + folder / name).code == 2);
        CHECK(run_lamella(ball + "--force -o " + folder / name).code == 0);
    }
}

TEST_CASE("an ending of masks for a machine that extrudes is refused, and the reverse", "[output]") {
    const Folder folder;
    for (const std::string output : {"x.sl1@marlin", "x.goo@klipper", "x.gcode@prusa-sl1s"}) {
        INFO(output);
        const Outcome refused = run_lamella(ball + "-o " + folder / output);
        CHECK(refused.code == 2);
        CHECK(mentions(refused.err, output.substr(0, output.find('@'))));
        CHECK(mentions(refused.err, "accepted"));
        CHECK_FALSE(fs::exists(folder / output.substr(0, output.find('@'))));
    }
}

}  // namespace output_paths_test
