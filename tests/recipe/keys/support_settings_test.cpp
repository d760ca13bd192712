// What [support] makes of a recipe: its kind, the profile's numbers, and what cannot be.
#include <set>

#include "printers/registry.h"
#include "recipe/identity.h"
#include "recipe/machine_profiles.h"
#include "recipe/settings.h"
#include "tests/app/commands/recipes.h"

namespace support_settings_test {

using namespace lamella;

namespace {

const std::string cube = "[part]\nshape = \"box\"\nsize = [10, 10, 10]\n[layers]\nheight = 0.1\n";

Recipe recipe(const std::string& text) { return recipe_of(cube + text); }

std::string complaint(const std::string& text) {
    try {
        recipe(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("supports are made where a recipe asks for them") {
    CHECK(recipe("").support == SupportKind::none);
    CHECK(recipe("[support]\n").support == SupportKind::bridges);
    CHECK(recipe("[support]\nspacing = 2\n").support == SupportKind::bridges);
    CHECK(recipe("[support]\nkind = \"pillars\"\nspacing = 2\n").support == SupportKind::pillars);
    // Keys that sort before and after `kind` do not outvote it.
    const Recipe off = recipe("[support]\nkind = \"none\"\nadhesion = 0.1\ntip = 0.5\n");
    CHECK(off.support == SupportKind::none);
    CHECK(off.printer.support.tip == 0.5);
    RecipeDraft draft;
    draft.read_text(cube + "[support]\nkind = \"pillars\"\n", "test.toml");
    draft.assign_flag(*find_setting("support", "kind"), "none");
    CHECK(draft.finish().support == SupportKind::none);
    RecipeDraft by_flag;
    by_flag.read_text(cube, "test.toml");
    by_flag.assign_flag(*find_setting("support", "overhang"), "0.3");
    const Recipe flagged = by_flag.finish();
    CHECK(flagged.support == SupportKind::bridges);
    CHECK(flagged.printer.support.overhang == 0.3);
}

TEST_CASE("every number of a support profile has its key") {
    // Each key changes the profile, and no two change the same number.
    std::set<std::string> seen;
    std::size_t keys = 0;
    const auto state = [](const Recipe& r) {
        std::string text;
        for (const Setting& setting : settings()) {
            if (setting.section == "support") text += format_value(setting.load(r, 0)) + ";";
        }
        return text;
    };
    for (const Setting& setting : settings()) {
        if (setting.section != "support" || belongs_in_recipe(setting)) continue;
        INFO(setting.name());
        Recipe changed;
        changed.support = SupportKind::pillars;
        const bool boolean = setting.type == ValueType::boolean;
        setting.store(changed, 0, boolean ? Value(true) : Value(0.4375));
        CHECK(seen.insert(state(changed)).second);
        CHECK(changed.support == SupportKind::pillars);
        ++keys;
    }
    // 23 lengths and other numbers, and whether pillars are round.
    CHECK(keys == (sizeof(SupportProfile) - sizeof(double)) / sizeof(double) + 1);
}

TEST_CASE("the profile gives the numbers that a recipe leaves out") {
    const std::string marlin = "[printer]\nprofile = \"marlin\"\n[support]\nspacing = 2.5\n";
    const SupportProfile filament = recipe(marlin).printer.support;
    CHECK(filament.spacing == 2.5);
    CHECK(filament.pillar == SupportProfile{}.pillar);
    CHECK_FALSE(filament.round_pillars);
    for (const char* name : {"generic-8k", "prusa-sl1s", "png"}) {
        INFO(name);
        const SupportProfile resin = MachineProfiles().find(name)->printer.support;
        CHECK(resin.round_pillars);
        CHECK(resin.pillar == 1.2);
        CHECK(resin.tip == 0.5);
        CHECK(resin.connector == 3);
        CHECK(resin.foot == 8);
        CHECK(resin.spacing == 4);
        CHECK(resin.lift == 0);
    }
    CHECK(recipe("[support]\n").printer.support.round_pillars);  // the default profile is a display
}

TEST_CASE("every profile's own supports are accepted") {
    for (const std::string& name : MachineProfiles().names()) {
        for (const char* kind : {"bridges", "pillars"}) {
            INFO(name << " " << kind);
            const std::string said =
                complaint("[printer]\nprofile = \"" + name + "\"\n[support]\nkind = \"" + kind + "\"\n");
            // Sheets are cut lying down: what is cut from them needs none.
            CHECK(said.empty() == (name != "dxf"));
        }
    }
}

TEST_CASE("supports decide the identity, absent ones do not") {
    const std::string plain = job_identity(recipe(""));
    CHECK(job_identity(recipe("[support]\nkind = \"none\"\ntip = 0.55\n")) == plain);
    const std::string bridges = job_identity(recipe("[support]\n"));
    CHECK(bridges != plain);
    CHECK(job_identity(recipe("[support]\nkind = \"bridges\"\n")) == bridges);
    CHECK(job_identity(recipe("[support]\nkind = \"pillars\"\n")) != bridges);
    CHECK(job_identity(recipe("[support]\ntip = 0.55\n")) != bridges);
}

TEST_CASE("supports that cannot be are refused with the key and what is accepted") {
    const std::string marlin = "[printer]\nprofile = \"marlin\"\n[support]\n";
    CHECK(mentions(
        complaint(marlin + "tip = 3\n"),
        "test.toml:9: support.tip: 3 mm is wider than support.pillar, 2.5 mm; accepted: at most 2.5 mm"));
    CHECK(mentions(complaint(marlin + "foot = 2\n"),
                   "support.pillar: 2.5 mm is wider than support.foot, 2 mm"));
    CHECK(mentions(complaint(marlin + "gap = 2.5\n"), "test.toml:9: support.gap: 2.5 mm leaves nothing of"));
    CHECK(mentions(complaint(marlin + "wall = 2.5\n"),
                   "test.toml:9: support.wall: 2.5 mm is too thick for crosses"));
    CHECK(mentions(complaint(marlin + "pillar = 0.4\ntip = 0.3\n"),
                   "0.45 mm (a line's width) is too thick for crosses"));
    CHECK(complaint(marlin + "pillar = 0.4\ntip = 0.3\nround_pillars = true\n").empty());
    CHECK(mentions(complaint(marlin + "bridge = 0.6\n"),
                   "support.bar_width: 0.9 mm is more than support.bridge"));
    CHECK(mentions(complaint(marlin + "bridge = 0\n"), "support.bridge: 0 is too small"));
    CHECK(mentions(complaint(marlin + "grey = 1.5\n"), "support.grey: 1.5 is too large"));
    CHECK(mentions(complaint(marlin + "kind = \"bridge\"\n"), "did you mean `bridges`?"));
    CHECK(mentions(complaint(marlin + "pilar = 2\n"), "did you mean `pillar`?"));
    // Where no supports are made, their numbers may be what they like.
    CHECK(complaint(marlin + "kind = \"none\"\ntip = 3\n").empty());
}

}  // namespace support_settings_test
