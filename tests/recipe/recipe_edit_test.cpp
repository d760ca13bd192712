// Edits of a recipe's text: every key, and nothing else changes.
#include "recipe/recipe_edit.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "recipe/settings.h"
#include "tests/app/commands/mentions.h"
#include "tests/recipe/another_value.h"

namespace recipe_edit_test {

using namespace lamella;

namespace {

std::string edited(const std::string& text, const RecipeChange& change) {
    return edited_recipe(text, std::vector{change});
}

const std::string koala =
    "# a koala\n"
    "[part]  # from a file\n"
    "mesh = \"k\xc3\xb6"
    "ala.obj\"   # \xc3\xbcmlaut before it\n"
    "scale = 2\n"
    "\n"
    "# what holds it\n"
    "[[region]]\n"
    "field = \"heel\"\n"
    "make = \"solid\"\n"
    "\n"
    "# soft here\n"
    "[[region]]\n"
    "field = \"toe\"\n"
    "make = \"empty\"   # really\n"
    "\n"
    "[foam]\n"
    "stretch = [1,\n"
    "           2, 3]  # three lines\n"
    "cell = \"2 + z/10\"\n";

}  // namespace

TEST_CASE("every key can be set, changed and removed in a recipe's text", "[recipe_edit]") {
    for (const Setting& setting : settings()) {
        INFO(setting.name());
        const std::string value = format_value(another_value(setting));
        const std::string text = edited("# first\n", {setting.section, 0, setting.key, value});
        CHECK(text == "# first\n\n" + find_section(setting.section)->title() + "\n" +
                          text.substr(text.find(setting.key + " = ")));
        const std::vector<GivenKey> given = given_keys(text);
        REQUIRE(given.size() == 1);
        CHECK(given[0].section == setting.section);
        CHECK(given[0].key == setting.key);
        CHECK(given[0].value == value);
        CHECK(given[0].line == 4);
        CHECK(edited(text, {setting.section, 0, setting.key, value}) == text);
        CHECK(edited(text, {setting.section, 0, setting.key, {}}) ==
              "# first\n\n" + find_section(setting.section)->title() + "\n");
        CHECK(edited(text, {setting.section, 0, "", {}}) == "# first\n\n");
    }
}

TEST_CASE("an edit leaves comments, order and other values as they stand", "[recipe_edit]") {
    const auto replaced = [](const std::string& from, const std::string& to) {
        std::string text = koala;
        return text.replace(text.find(from), from.size(), to);
    };
    CHECK(edited(koala, {"part", 0, "mesh", "b.stl"}) == replaced("\"k\xc3\xb6"
                                                                  "ala.obj\"",
                                                                  "\"b.stl\""));
    CHECK(edited(koala, {"part", 0, "scale", "0.5"}) == replaced("scale = 2", "scale = 0.5"));
    CHECK(edited(koala, {"part", 0, "turn", "0,0,90"}) ==
          replaced("scale = 2\n", "scale = 2\nturn = [0, 0, 90]\n"));
    CHECK(edited(koala, {"foam", 0, "stretch", "1,1,4"}) == replaced("[1,\n           2, 3]", "[1, 1, 4]"));
    CHECK(edited(koala, {"foam", 0, "stretch", {}}) ==
          replaced("stretch = [1,\n           2, 3]  # three lines\n", ""));
    CHECK(edited(koala, {"foam", 0, "cell", "3"}) == replaced("\"2 + z/10\"", "3"));
    CHECK(edited(koala, {"foam", 0, "beam", "0.4"}) == koala + "beam = 0.4\n");
    CHECK(edited(koala, {"region", 1, "make", "solid"}) == replaced("\"empty\"", "\"solid\""));
    CHECK(edited(koala, {"region", 0, "blend", "2"}) ==
          replaced("make = \"solid\"\n", "make = \"solid\"\nblend = 2\n"));
    CHECK(edited(koala, {"region", 0, "", {}}) ==
          replaced("[[region]]\nfield = \"heel\"\nmake = \"solid\"\n\n", ""));
    CHECK(edited(koala, {"region", 1, "", {}}) ==
          replaced("[[region]]\nfield = \"toe\"\nmake = \"empty\"   # really\n\n", ""));
    CHECK(edited(koala, {"region", 2, "field", "ear"}) == koala + "\n[[region]]\nfield = \"ear\"\n");
    CHECK(edited(koala, {"skin", 0, "thickness", "0.8"}) == koala + "\n[skin]\nthickness = 0.8\n");
    CHECK(edited(koala, {"skin", 0, "thickness", {}}) == koala);
    const std::string open = "[foam]\ncell = 2";  // without a line feed
    CHECK(edited(open, {"foam", 0, "beam", "0.3"}) == "[foam]\ncell = 2\nbeam = 0.3\n");
    CHECK(edited("[part]\r\nscale = 1\r\n", {"part", 0, "scale", "3"}) == "[part]\r\nscale = 3\r\n");
}

TEST_CASE("texts keep quotes and backslashes", "[recipe_edit]") {
    const std::string odd = edited("", {"field", 0, "formula", "x > 1 ? 2 : \"\\\""});
    CHECK(given_keys(odd)[0].value == "x > 1 ? 2 : \"\\\"");
}

TEST_CASE("edits that cannot be made say why", "[recipe_edit]") {
    const auto complaint = [](const std::string& text, const RecipeChange& change) {
        try {
            edited(text, change);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("nothing");
    };
    CHECK(mentions(complaint(koala, {"foam", 0, "cell", "-3"}), "foam.cell: -3 is too small"));
    CHECK(mentions(complaint(koala, {"foam", 0, "cel", "3"}), "foam.cel: unknown key"));
    CHECK(mentions(complaint(koala, {"fome", 0, "cell", "3"}), "fome: unknown section"));
    CHECK(
        mentions(complaint(koala, {"region", 3, "field", "a"}), "entry 3 does not exist; accepted: 0 to 2"));
    CHECK(mentions(complaint("foam = {cell = 2}\n", {"foam", 0, "cell", "3"}), "is written in one line"));
    CHECK(mentions(complaint("[foam\n", {"foam", 0, "cell", "3"}), "not valid TOML"));
}

TEST_CASE("given keys are told in their order, those of the wrong type empty", "[recipe_edit]") {
    const std::vector<GivenKey> keys =
        given_keys("[foam]\ncell = true\nnonsense = 1\n[part]\nscale = 2\n[[region]]\nblend = 1\n");
    REQUIRE(keys.size() == 3);
    CHECK(keys[0].value.empty());
    CHECK(keys[1].key == "scale");
    CHECK(keys[1].line == 5);
    CHECK(keys[2].section == "region");
    CHECK(keys[2].value == "1");
}

}  // namespace recipe_edit_test
