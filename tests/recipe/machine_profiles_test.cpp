// Machine profiles: what ships is sourced and consistent, and users' files are read like recipes.
#include "recipe/machine_profiles.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <regex>
#include <set>
#include <sstream>

#include "engine/base/error.h"
#include "printers/common/profile_texts.h"
#include "printers/registry.h"
#include "recipe/identity.h"
#include "recipe/printer_choice.h"
#include "recipe/recipe_draft.h"
#include "tests/app/commands/command_run.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/recipes.h"

namespace machine_profiles_test {

using namespace lamella;

namespace {

const std::string sphere = "[part]\nshape = \"sphere\"\nradius = 5\n";

Recipe recipe_with(const MachineProfiles& profiles, const std::string& text,
                   const std::string& path = "a.toml") {
    RecipeDraft draft;
    draft.use_profiles(profiles);
    draft.read_text(sphere + text, path);
    return draft.finish();
}

MachineProfiles with(const Folder& folder) {
    MachineProfiles profiles;
    profiles.add_folder(folder.path().string(), true);
    return profiles;
}

/// What is wrong with a profile of this text.
std::string wrong(const std::string& text) {
    const Folder folder;
    write(folder / "mine.toml", text);
    try {
        with(folder).find("mine");
    } catch (const InputError& error) {
        const std::string message = error.what();
        // Messages name the file, whose folder differs from run to run.
        return std::regex_replace(message, std::regex("[^ \n]*/mine.toml"), "mine.toml");
    }
    return "";
}

bool same(const PrinterProfile& a, const PrinterProfile& b) {
    Recipe ra, rb;
    ra.printer = a;
    rb.printer = b;
    for (const Setting& setting : settings()) {
        if (std::ranges::find(profile_sections, setting.section) == profile_sections.end()) continue;
        INFO(setting.name());
        if (!(setting.load(ra, 0) == setting.load(rb, 0))) return false;
    }
    return true;
}

/// The sizes that stand in a comment "# display: 128 x 81 mm".
std::optional<dvec2> stated_display(const std::string& text) {
    static const std::regex form("# display: ([0-9.]+) x ([0-9.]+) mm");
    std::smatch found;
    if (!std::regex_search(text, found, form)) return std::nullopt;
    return dvec2(std::stod(found[1]), std::stod(found[2]));
}

}  // namespace

TEST_CASE("every shipped profile can be used, and its display is as large as it says") {
    const MachineProfiles profiles;
    CHECK(profile_texts().size() >= 20);
    for (const ProfileText& shipped : profile_texts()) {
        const std::string name(shipped.name);
        INFO(name);
        const auto profile = profiles.find(name);
        REQUIRE(profile);
        CHECK(profile->printer.name == name);
        CHECK(profile->source == "built in");
        CHECK(profile->description.size() > 5);
        CHECK(profile->description.size() < 80);
        const LayerContent content = find_backend(profile->printer.backend).content;
        const auto display = stated_display(std::string(shipped.text));
        CHECK(display.has_value() == (content == LayerContent::pixels));
        if (!display) continue;
        const ImageProfile& image = profile->printer.image;
        CHECK(image.width * image.pixel_x == Approx(display->x).epsilon(1e-4));
        CHECK(image.height * image.pixel_y == Approx(display->y).epsilon(1e-4));
    }
}

TEST_CASE("every number of a shipped profile says where it is from") {
    static const std::regex number("^[a-z_0-9]+ = [-0-9.]+ *(#.*)?$");
    static const std::regex source("^# \\[([0-9]+)\\] .{10,}");
    static const std::regex reference("\\[([0-9]+)\\]");
    for (const ProfileText& shipped : profile_texts()) {
        INFO(shipped.name);
        std::set<std::string> sources;
        std::istringstream text{std::string(shipped.text)};
        for (std::string line; std::getline(text, line);) {
            INFO(line);
            std::smatch found;
            if (std::regex_search(line, found, source)) sources.insert(found[1]);
            if (!std::regex_match(line, found, number)) continue;
            const std::string comment = found[1];
            std::smatch cited;
            if (std::regex_search(comment, cited, reference)) {
                CHECK(sources.contains(cited[1]));
            } else {
                CHECK((comment.starts_with("# by definition: ") || comment.starts_with("# not verified")));
            }
        }
    }
}

TEST_CASE("profiles that recipes have named for long are what they were") {
    const MachineProfiles profiles;
    const auto image = [&](const char* name) { return profiles.find(name)->printer.image; };
    CHECK(image("generic-8k").width == 7680);
    CHECK(image("generic-8k").pixel_y == 0.025);
    CHECK(image("generic-4k").height == 2160);
    CHECK(image("generic-4k").pixel_x == 0.05);
    CHECK(image("prusa-sl1").pixel_x == 0.04725);
    CHECK(image("prusa-sl1").portrait);
    CHECK(image("prusa-sl1s").height == 1620);
    CHECK(image("prusa-sl1s").pixel_y == 0.05);
    CHECK(profiles.find("prusa-sl1")->printer.resin.machine == "SL1");
    CHECK(profiles.find("prusa-sl1s")->printer.resin.machine == "SL1S");
    PrinterProfile plain;
    plain.name = plain.backend = "svg";
    CHECK(same(profiles.find("svg")->printer, plain));
    plain.name = "marlin";
    plain.backend = "gcode";
    CHECK(same(profiles.find("marlin")->printer, plain));
    CHECK(recipe_of(sphere).printer.name == default_profile);
}

TEST_CASE("a profile written down as TOML is read back the same") {
    const Folder folder;
    const MachineProfiles profiles;
    for (const std::string& name : profiles.names()) {
        INFO(name);
        MachineProfile profile = *profiles.find(name);
        profile.printer.support.tip = 0.4375;
        profile.printer.check.min_gap = 0.3125;
        profile.printer.check.concerns[3] = SeverityOverride::off;
        profile.printer.host = "voron";
        profile.printer.resin.material = "a \"grey\" \\ resin";
        profile.printer.gcode.start_script = "M117 \"{layers}\"\n\nG28 ; {{home}}";
        write(folder / (name + ".toml"), profile_as_toml(profile));
        const auto again = with(folder).find(name);
        REQUIRE(again);
        CHECK(same(again->printer, profile.printer));
        CHECK(again->description == profile.description);
        CHECK(again->source == folder / (name + ".toml"));
    }
    // Every key is there, apart from those that say the same in other words.
    const std::string text = "\n" + profile_as_toml(*profiles.find("elegoo-mars-3"));
    for (const Setting& setting : settings()) {
        if (std::ranges::find(profile_sections, setting.section) == profile_sections.end()) continue;
        const bool is_empty = setting.type == ValueType::rows || setting.type == ValueType::lines ||
                              setting.name() == "host.name";  // only to be filled in
        const bool other =
            belongs_in_recipe(setting) || setting.key == "pixel" || setting.key == "dpi" || is_empty;
        INFO(setting.name());
        const std::string section = text.substr(text.find("\n[" + setting.section + "]"));
        CHECK((section.substr(0, section.find("\n\n")).find("\n" + setting.key + " = ") !=
               std::string::npos) == !other);
        if (setting.name() == "host.name") CHECK(section.starts_with("\n[host]\n# name = \"\""));
    }
}

TEST_CASE("what a profile says of checks holds, and changes no job", "[check]") {
    const Folder folder;
    const std::string text = "based_on = \"binder-jet-300\"\n";
    write(folder / "plain.toml", text);
    write(folder / "mine.toml", text + "[check]\nleast_thickness = 1.5\ncavities = \"warn\"\n");
    const MachineProfiles profiles = with(folder);
    const Recipe plain = recipe_with(profiles, "[printer]\nprofile = \"plain\"\n");
    Recipe mine = recipe_with(profiles, "[printer]\nprofile = \"mine\"\n");
    CHECK(mine.printer.check.process == Process::powder);  // as the profile at the bottom says
    CHECK(mine.printer.check.min_thickness == 1.5);
    mine.printer.name = plain.printer.name;
    CHECK(job_identity(mine) == job_identity(plain));
    CHECK(mentions(wrong("[printer]\nkind = \"sl1\"\n[check]\ncups = \"no\"\n"),
                   "mine.toml:4: check.cups: \"no\" is unknown"));
    CHECK(mentions(wrong("cups = \"off\"\n[printer]\nkind = \"sl1\"\n"),
                   "mine.toml:1: cups: stands outside a section, it belongs to [check]"));
}

TEST_CASE("a user's profile is found by name, by file, and before a built-in one") {
    const Folder folder;
    write(folder / "mine.toml",
          "based_on = \"prusa-sl1s\"\n[printer]\nexposure = 1.75\n[support]\ntip = 0.3\n");
    write(folder / "prusa-sl1s.toml", "based_on = \"prusa-sl1s\"\n[printer]\nexposure = 9\n");
    write(folder / "notes.txt", "no profile");
    const MachineProfiles profiles = with(folder);
    const Recipe by_name = recipe_with(profiles, "[printer]\nprofile = \"mine\"\n");
    CHECK(by_name.printer.name == "mine");
    CHECK(by_name.printer.resin.exposure == 1.75);
    CHECK(by_name.printer.resin.machine == "SL1S");
    CHECK(by_name.printer.support.tip == 0.3);
    CHECK(by_name.support == SupportKind::none);
    CHECK(recipe_with(profiles, "[printer]\nprofile = \"prusa-sl1s\"\n").printer.resin.exposure == 9);
    const Recipe by_file = recipe_with({}, "[printer]\nprofile = \"mine.toml\"\n", folder / "recipe.toml");
    CHECK(same(by_file.printer, by_name.printer));
    // The recipe's own keys come last.
    const Recipe changed = recipe_with(profiles, "[printer]\nprofile = \"mine\"\nexposure = 4\n");
    CHECK(changed.printer.resin.exposure == 4);
    CHECK(changed.printer.resin.machine == "SL1S");
    RecipeDraft flagged;
    flagged.use_profiles(profiles);
    flagged.read_text(sphere + "[printer]\nprofile = \"generic-4k\"\n", "a.toml");
    flagged.assign_flag(*find_setting("printer", "profile"), folder / "mine.toml");
    CHECK(flagged.finish().printer.resin.exposure == 1.75);
}

TEST_CASE("where a profile stands does not change a job, what it says does") {
    const Folder here, there, other;
    const std::string text = "[printer]\nkind = \"sl1\"\nexposure = 1.75\n";
    write(here / "mine.toml", text);
    write(there / "mine.toml", "# moved\n" + text);
    write(other / "mine.toml", text + "[support]\ntip = 0.3\n");
    const std::string named = "[printer]\nprofile = \"mine\"\n", supported = "[support]\n";
    const std::string identity = job_identity(recipe_with(with(here), named));
    CHECK(job_identity(recipe_with(with(there), named)) == identity);
    CHECK(job_identity(recipe_with({}, "[printer]\nprofile = \"" + here / "mine.toml\"\n")) == identity);
    CHECK(job_identity(recipe_with(with(other), named)) == identity);  // there are no supports
    CHECK(job_identity(recipe_with(with(other), named + supported)) !=
          job_identity(recipe_with(with(here), named + supported)));
    CHECK(job_identity(recipe_with(with(here), named + "exposure = 2\n")) != identity);
}

TEST_CASE("a profile that cannot be is refused with file, line and key") {
    CHECK(wrong("[printer]\nkind = \"sl1\"\nwidth = 0\n") ==
          "mine.toml:3: printer.width: 0 is too small; accepted: a whole number from 1 to 65535 px");
    CHECK(mentions(wrong("[printer]\nkind = \"sl1\"\nwidht = 5\n"),
                   "mine.toml:3: printer.widht: unknown key, did you mean `width`?"));
    CHECK(mentions(wrong("[printer]\nkind = \"sl2\"\n"),
                   "mine.toml:2: printer.kind: \"sl2\" is unknown, did you"));
    CHECK(mentions(wrong("[printer]\nwidth = 5\n"), "mine.toml: neither based_on nor printer.kind is given"));
    CHECK(mentions(wrong("based_on = \"prusa-sl1z\"\n"),
                   "mine.toml:1: based_on: \"prusa-sl1z\" is unknown, did you mean `prusa-sl1`?"));
    CHECK(mentions(wrong("based_on = 3\n[printer]\nkind = \"sl1\"\n"),
                   "mine.toml:1: based_on: a whole number"));
    CHECK(mentions(wrong("description = \"\"\n[printer]\nkind = \"sl1\"\n"),
                   "mine.toml:1: description: the text"));
    CHECK(mentions(wrong("[printer]\nprofile = \"svg\"\n"),
                   "mine.toml:2: printer.profile: belongs in a recipe"));
    CHECK(mentions(wrong("[support]\nkind = \"bridges\"\n[printer]\nkind = \"sl1\"\n"),
                   "mine.toml:2: support.kind: belongs in a recipe"));
    CHECK(mentions(wrong("[foam]\ncell = 3\n"), "mine.toml:1: foam: is not a key of a machine profile"));
    CHECK(mentions(wrong("[printr]\nkind = \"sl1\"\n"), "did you mean `printer`?"));
    CHECK(mentions(wrong("width = 3\n"),
                   "mine.toml:1: width: stands outside a section, it belongs to [printer]"));
    CHECK(mentions(wrong("tip = 3\n"), "it belongs to [support]"));
    CHECK(mentions(wrong("printer = 3\n"), "mine.toml:1: printer: a whole number was found"));
    CHECK(mentions(wrong("[printer\n"), "mine.toml:1:9: not valid TOML"));
    CHECK(mentions(wrong("[printer]\nkind = \"sl1\"\n[support]\ntip = 5\n"),
                   "mine.toml:4: support.tip: 5 mm is wider than support.pillar"));
    CHECK(mentions(wrong("[printer]\nkind = \"png\"\ndpi = 600\npixel = 0.05\n"), "conflicts with"));
    // All mistakes at once.
    const std::string several = wrong("[printer]\nkind = \"sl1\"\nwidth = 0\nheight = 0\n");
    CHECK(std::count(several.begin(), several.end(), '\n') == 1);
    CHECK(wrong("[printer]\nkind = \"sl1\"\n").empty());
}

TEST_CASE("profiles based on each other end with a message") {
    const Folder folder;
    write(folder / "mine.toml", "based_on = \"yours\"\n");
    write(folder / "yours.toml", "based_on = \"mine\"\n");
    write(folder / "self.toml", "based_on = \"self\"\n");
    write(folder / "file.toml", "based_on = \"file.toml\"\n");
    const MachineProfiles profiles = with(folder);
    CHECK_THROWS_WITH(profiles.find("mine"), Catch::Contains("is based on itself"));
    CHECK_THROWS_WITH(profiles.find("file"), Catch::Contains("is based on itself"));
    CHECK_THROWS_WITH(profiles.find("self"), Catch::Contains("\"self\" is unknown"));
    CHECK_THROWS_AS(profiles.find(folder / "absent.toml"), InputError);
    CHECK_THROWS_AS(MachineProfiles().add_folder(folder / "absent", true), InputError);
    CHECK_NOTHROW(MachineProfiles().add_folder(folder / "absent", false));
    CHECK(mentions(printers_listing(profiles), "mine                      cannot be used: "));
    CHECK(mentions(printers_listing(profiles), "elegoo-mars-4-ultra"));
}

TEST_CASE("a recipe with an unknown printer gets the nearest name") {
    CHECK(mentions(
        complaint_about(sphere + "[printer]\nprofile = \"prusa-sl2\"\n"),
        "test.toml:5: printer.profile: \"prusa-sl2\" is unknown, did you mean `prusa-sl1`?; accepted: "
        "one of "));
    CHECK(mentions(complaint_about(sphere + "[printer]\nprofile = \"absent.toml\"\n"),
                   "absent.toml: cannot be opened; a readable machine profile file"));
}

TEST_CASE("dots per inch are another way to say the size of a pixel") {
    const ImageProfile image = recipe_of(sphere + "[printer]\ndpi = 600\n").printer.image;
    CHECK(image.pixel_x == 25.4 / 600);
    CHECK(image.pixel_y == image.pixel_x);
    CHECK(mentions(complaint_about(sphere + "[printer]\ndpi = 600\npixel_x = 0.04\n"),
                   "test.toml:6: printer.pixel_x: conflicts with test.toml:5: printer.dpi; accepted: pixel "
                   "alone, dpi alone"));
    RecipeDraft draft;
    draft.read_text(sphere + "[printer]\npixel_x = 0.03\npixel_y = 0.04\n", "test.toml");
    draft.assign_flag(*find_setting("printer", "dpi"), "1200");
    CHECK(draft.finish().printer.image.pixel_y == 25.4 / 1200);
}

TEST_CASE("the command finds profiles in the user's folder, in one that is named, and by their file") {
    const Folder folder;
    std::filesystem::create_directories(folder / "config/lamella/printers");
    std::filesystem::create_directories(folder / "more");
    write(folder / "config/lamella/printers/mine.toml",
          "description = \"my cutter\"\n[printer]\nkind = \"svg\"\nmargin = 3\n");
    write(folder / "more/other.toml", "based_on = \"mine\"\n[printer]\nmargin = 4\n");
    const auto run = [&](const std::string& arguments) {
        setenv("XDG_CONFIG_HOME", (folder / "config").c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
        Outcome outcome = run_lamella(arguments);
        unsetenv("XDG_CONFIG_HOME");  // NOLINT(concurrency-mt-unsafe)
        return outcome;
    };
    const Outcome list = run("printers --printers " + folder / "more");
    CHECK(list.code == 0);
    CHECK(mentions(list.out, "my cutter (" + folder / "config/lamella/printers/mine.toml)"));
    CHECK(mentions(list.out, "(" + folder / "more/other.toml)"));
    CHECK(mentions(list.out, "generic-8k"));
    CHECK(mentions(run("printers mine").out, "\nmargin = 3 "));
    CHECK(mentions(run("printers other --printers " + folder / "more").out, "\nmargin = 4 "));
    CHECK(run("printers other").code == 2);
    CHECK(mentions(run("printers mina").err, "\"mina\" is unknown, did you mean `mine`?"));

    const std::string ball = "slice --shape sphere --shape-radius 2 --layer-height 0.5 --quiet --printer ";
    CHECK(run(ball + "mine -o " + folder / "a.svg").code == 0);
    CHECK(mentions(contents(folder / "a.svg"), "width=\"10mm\""));
    CHECK(run(ball + "other --printers " + folder / "more -o " + folder / "b.svg").code == 0);
    CHECK(mentions(contents(folder / "b.svg"), "width=\"12mm\""));
    CHECK(run(ball + folder / "config/lamella/printers/mine.toml -o " + folder / "c.svg").code == 0);
    CHECK(contents(folder / "c.svg") == contents(folder / "a.svg"));
    CHECK(run(ball + "mine --printers " + folder / "absent -o " + folder / "d.svg").code == 2);
    // What a program cannot know is told.
    const Outcome sliced =
        run("slice --shape sphere --shape-radius 2 --layer-height 0.5 --printer 3mf -o " + folder / "e.3mf");
    CHECK(sliced.code == 0);
    CHECK(mentions(sliced.err, "show a plain box instead of the part"));
}

}  // namespace machine_profiles_test
