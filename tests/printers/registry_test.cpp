// Every back-end prints with its plain settings, and a mistyped name gets its neighbour.
#include "printers/registry.h"

#include <catch2/catch.hpp>
#include <set>

#include "engine/base/error.h"
#include "tests/printers/common/plane_solids.h"

namespace registry_test {

using namespace lamella;
using namespace lamella::test;

TEST_CASE("every back-end can print", "[registry]") {
    const TemporaryFolder folder;
    const Job job = make_job(
        {{0, 0, 0}, {4, 4, 0.2}},
        [](double) {
            return std::vector<Figure>{disc({2, 2}, 2)};
        },
        0.1);
    std::set<std::string> names;
    for (const BackendInfo& backend : backends()) {
        INFO(backend.name);
        CHECK(names.insert(backend.name).second);
        CHECK(&find_backend(backend.name) == &backend);
        PrinterProfile profile;
        profile.name = profile.backend = backend.name;
        if (profile.name == "ember") {
            profile.image.width = 1280;
            profile.image.height = 800;
        }
        const std::string path = folder / backend.name;
        const double volume = run_layers(job, *make_backend(profile, path, false), {0, 2});
        CHECK(volume == Approx(3.14159265 * 4 * 0.2).epsilon(0.01));
        CHECK(std::filesystem::exists(path));
        CHECK(std::filesystem::is_directory(path) == (backend.output == OutputKind::folder));
        CHECK_THROWS_AS(make_backend(profile, path, false)->open(job, {0, 2}, false), InputError);
    }
}

TEST_CASE("a back-end's row tells all that other code asks of it", "[registry]") {
    for (const BackendInfo& backend : backends()) {
        INFO(backend.name);
        PrinterProfile profile;
        profile.backend = backend.name;
        CHECK(process_of(profile) == backend.process(profile));
        CHECK(process_of(profile) != Process::from_backend);
        CHECK(makes_beads(profile) == (backend.content == LayerContent::beads));
        // Resin is the process whose supports differ from the plain ones.
        const bool resin = backend.default_supports().round_pillars;
        CHECK(resin == (process_of(profile) == Process::resin));
        CHECK(printable_overhang(profile, 0.07) ==
              (makes_beads(profile) ? 0.5 * profile.filament.line_width : 0.07));
        profile.check.process = Process::powder;
        CHECK(process_of(profile) == Process::powder);
        profile.support.overhang = 0.3;
        CHECK(printable_overhang(profile, 0.07) == 0.3);
    }
    PrinterProfile laser;
    laser.backend = "gcode";
    laser.gcode.flavour = Flavour::grbl;
    CHECK(process_of(laser) == Process::cutting);
    PrinterProfile svg;
    svg.backend = "svg";
    CHECK(!cuts_sheets(svg));
    svg.cutting.kerf = 0.1;
    CHECK(cuts_sheets(svg));
}

TEST_CASE("an unknown back-end gets the nearest one and the list", "[registry]") {
    CHECK_THROWS_WITH(find_backend("pgn"), Catch::Contains("did you mean 'png'?") && Catch::Contains("sl1"));
    CHECK_THROWS_WITH(find_backend("quite something else"), !Catch::Contains("did you mean"));
    CHECK_THROWS_AS(find_backend(std::string(100000, 'x')), InputError);
    PrinterProfile profile;
    profile.backend = "nothing";
    CHECK_THROWS_AS(make_backend(profile, "out", false), InputError);
}

}  // namespace registry_test
