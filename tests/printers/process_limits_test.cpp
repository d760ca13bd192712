// What machines can make: verdicts by process, sizes by machine, and room as the back-ends have it.
#include "printers/process_limits.h"

#include <catch2/catch.hpp>
#include <string>

#include "engine/base/error.h"
#include "engine/solids/primitives.h"
#include "printers/registry.h"
#include "tests/app/commands/folder.h"

namespace process_limits_test {

using namespace lamella;

namespace {

PrinterProfile machine(const std::string& backend) {
    PrinterProfile profile;
    profile.backend = backend;
    return profile;
}

/// F, w or - for each check, in their order.
std::string verdicts(const PrinterProfile& profile) {
    std::string text;
    for (const Severity verdict : process_limits(profile).verdicts)
        text += verdict == Severity::fail ? 'F' : verdict == Severity::warn ? 'w' : '-';
    return text;
}

Job box_job(dvec3 size, double layer_height) {
    Job job;
    job.bounds = {dvec3(0), size};
    job.part = make_box(job.bounds);
    job.layers = equal_layers(size.z, layer_height);
    job.identity = "box";
    return job;
}

/// Whether the machine's back-end takes a box of this size.
bool takes(const PrinterProfile& profile, dvec3 size) {
    const Folder folder;
    const Job job = box_job(size, 0.2);
    const auto backend = make_backend(profile, folder / "out", false);
    try {
        backend->open(job, {0, job.layers.count()}, false);
    } catch (const InputError& error) {
        UNSCOPED_INFO(error.what());
        return false;
    }
    return true;
}

}  // namespace

TEST_CASE("each kind of machine works by its process", "[check]") {
    for (const char* resin : {"png", "sl1", "goo", "nanodlp", "ember"})
        CHECK(process_of(machine(resin)) == Process::resin);
    for (const char* powder : {"cli", "3mf"}) CHECK(process_of(machine(powder)) == Process::powder);
    for (const char* cutting : {"svg", "dxf"}) CHECK(process_of(machine(cutting)) == Process::cutting);
    PrinterProfile profile = machine("gcode");
    CHECK(process_of(profile) == Process::filament);
    profile.gcode.flavour = Flavour::grbl;
    CHECK(process_of(profile) == Process::cutting);
    profile = machine("svg");
    profile.cutting.dialect = SvgDialect::slic3r;
    CHECK(process_of(profile) == Process::resin);
    profile = machine("png");
    profile.check.process = Process::powder;
    CHECK(process_of(profile) == Process::powder);
    // No back-end is forgotten: all of them have one.
    for (const BackendInfo& backend : backends())
        CHECK(process_of(machine(backend.name)) != Process::from_backend);
}

TEST_CASE("what matters is decided by the process, and by the profile over it", "[check]") {
    // connectivity, sheets, islands, overhangs, bridges, thickness, necks, gaps, cavities, cups, build
    // volume, empty layers
    CHECK(verdicts(machine("gcode")) == "F-FFFFww---FF");
    CHECK(verdicts(machine("sl1")) == "F-Fw-FwwFwwFF");
    CHECK(verdicts(machine("cli")) == "F----FwwF--FF");
    CHECK(verdicts(machine("dxf")) == "wF---FwFw--Fw");
    PrinterProfile tied = machine("dxf");
    tied.cutting.ties = Ties::join;
    CHECK(verdicts(tied) == "ww---FwFw--Fw");
    PrinterProfile own = machine("gcode");
    own.check.concerns[0] = SeverityOverride::off;
    own.check.concerns[1] = SeverityOverride::fail;
    own.check.concerns[2] = SeverityOverride::warn;
    CHECK(verdicts(own) == "-FwFFFww---FF");
}

TEST_CASE("sizes are the machine's where it has them, and the profile's where it says so", "[check]") {
    PrinterProfile filament = machine("gcode");
    filament.filament.nozzle = 0.6;
    filament.filament.line_width = 0.7;
    filament.support.own_bridge = 7;
    filament.support.free_stretch = 1.5;
    const PrintLimits beads = process_limits(filament);
    CHECK(beads.thickness == 0.6);
    CHECK(beads.gap == 0.6);
    CHECK(beads.neck == 1.4);
    CHECK(beads.bridge == 7);
    CHECK(beads.free_stretch == 1.5);
    CHECK(beads.thickness_up == 0);
    PrinterProfile resin = machine("goo");
    resin.image.pixel_x = 0.02;
    CHECK(process_limits(resin).thickness == 0.4);
    resin.image.pixel_y = 0.3;
    CHECK(process_limits(resin).thickness == 0.6);
    CHECK(process_limits(machine("3mf")).thickness_up == 0.8);
    PrinterProfile laser = machine("svg");
    CHECK(process_limits(laser).gap == 0.2);
    laser.cutting.kerf = 0.35;
    CHECK(process_limits(laser).gap == 0.35);
    laser.check.min_gap = 0.5;
    laser.check.min_thickness = 3;
    laser.check.min_thickness_up = 0;
    laser.check.min_cavity = 0;
    CHECK(process_limits(laser).gap == 0.5);
    CHECK(process_limits(laser).thickness == 3);
    CHECK(process_limits(laser).cavity == 0);
}

TEST_CASE("a machine's room is what its back-end takes, to a hundredth of a millimetre", "[check]") {
    PrinterProfile brimmed = machine("gcode"), grbl = machine("gcode"), clear = machine("png");
    brimmed.toolpath.brim = 5;
    grbl.gcode.flavour = Flavour::grbl;
    grbl.cutting.kerf = 0.4;
    clear.image.margin = 3;
    clear.image.portrait = true;
    PrinterProfile ember = machine("ember");
    ember.image.width = 1280;
    ember.image.height = 800;
    for (const PrinterProfile& profile : {machine("png"), machine("sl1"), machine("goo"), machine("nanodlp"),
                                          ember, machine("gcode"), brimmed, grbl, clear}) {
        INFO(profile.backend);
        const dvec3 room = build_volume_limits(profile, 0.2);
        const dvec3 box = glm::min(room, dvec3(1e4, 1e4, 20));
        CHECK(takes(profile, box));
        CHECK_FALSE(takes(profile, box + dvec3(0.01, 0, 0)));
        CHECK_FALSE(takes(profile, box + dvec3(0, 0.01, 0)));
        if (room.z < 1e4) CHECK_FALSE(takes(profile, {box.x, box.y, room.z + 0.2}));
    }
    for (const char* open : {"svg", "dxf", "cli", "3mf"})
        CHECK(build_volume_limits(machine(open), 0.2) == dvec3(infinity));
}

}  // namespace process_limits_test
