// The bound on nested TOML: what is refused, with its place, and what strings and comments may hold.
#include "recipe/toml_depth.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"

namespace toml_depth_test {

using namespace lamella;

namespace {

std::string message_of(const std::string& text) {
    try {
        require_shallow_toml(text, "a.toml");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// A key of that many parts.
std::string key(int parts, const std::string& part = "a") {
    std::string text = part;
    for (int i = 1; i < parts; ++i) text += "." + part;
    return text;
}

}  // namespace

TEST_CASE("a key of too many parts is refused with its place, however it is written", "[depth]") {
    CHECK(message_of(key(deepest_toml) + " = 1\n").empty());
    CHECK(message_of("b = 1\n" + key(deepest_toml + 1) + " = 1\n") ==
          "a.toml:2:32: a key has more than 16 parts; accepted: keys of one part below their [section]");
    for (const std::string part : {"\"a\"", "'a'", "\"a\\\".\"", " a ", "\"\"", "a\t"}) {
        INFO(part);
        CHECK(message_of(key(deepest_toml, part) + " = 1\n").empty());
        CHECK_THAT(message_of(key(deepest_toml + 1, part) + " = 1\n"), Catch::Contains("more than 16 parts"));
        CHECK_THAT(message_of("[" + key(deepest_toml + 1, part) + "]\n"),
                   Catch::Contains("more than 16 parts"));
        CHECK_THAT(message_of("x = { " + key(deepest_toml + 1, part) + " = 1 }\n"),
                   Catch::Contains("more than 16 parts"));
    }
}

TEST_CASE("arrays and tables that are nested too deep are refused", "[depth]") {
    for (const std::string open : {"[", "[1, ", "{ a = ", "[\n# [\n"}) {
        std::string text = "x = ";
        for (int i = 0; i < deepest_toml; ++i) text += open;
        CHECK(message_of(text).empty());
        CHECK_THAT(message_of(text + open), Catch::Contains("nested more than 16 deep"));
    }
    std::string wide = "x = [";
    for (int i = 0; i < 1000; ++i) wide += "[1.5, 2.5], ";
    CHECK(message_of(wide + "]\n").empty());
}

TEST_CASE("dots and brackets in strings and comments do not count", "[depth]") {
    const std::string dots = key(100), brackets(100, '[');
    for (const std::string& text :
         {"\"" + dots + brackets + "\"", "'" + dots + brackets + "'",
          "\"\"\"" + dots + "\n" + brackets + "\"\"\"", "'''" + dots + "\n'" + brackets + "'''",
          "\"\\\"" + dots + "\"", "'\\'  # " + dots + brackets, "\"\"\"a\"\"\"\"\"  # " + dots,
          "\"\"\"\\\"\"\"" + dots + "\"\"\""}) {
        INFO(text);
        CHECK(message_of("x = " + text + "\n").empty());
        CHECK_THAT(message_of("x = " + text + "\n" + dots + " = 1\n"), Catch::Contains("more than 16 parts"));
    }
    std::string numbers = "x = [\n";
    for (int i = 0; i < 100; ++i) numbers += "0.5,\n";
    CHECK(message_of(numbers + "1979-05-27T07:32:00.999999\n]\n").empty());
}

}  // namespace toml_depth_test
