// The bound on nested JSON.
#include "engine/base/json_depth.h"

#include <catch2/catch.hpp>
#include <string>

namespace json_depth_test {

using namespace lamella;

TEST_CASE("JSON is let through up to the depth that is accepted", "[depth]") {
    const auto nested = [](int depth) {
        return std::string(static_cast<std::size_t>(depth), '[') +
               std::string(static_cast<std::size_t>(depth), ']');
    };
    CHECK(shallow_json(nested(deepest_json)) == nested(deepest_json));
    CHECK(shallow_json(nested(deepest_json + 1)).empty());
    std::string objects, wide = "[";
    for (int i = 0; i <= deepest_json; ++i) objects += "{\"a\":";
    for (int i = 0; i < 1000; ++i) wide += "[{}],";
    CHECK(shallow_json(objects).empty());
    CHECK(shallow_json(wide) == wide);
}

TEST_CASE("brackets in strings do not nest", "[depth]") {
    const std::string many(1000, '[');
    const std::string text = R"({"a": ")" + many + R"(", "b\"": "\\", "c": "\")" + many + "\"}";
    CHECK(shallow_json(text) == text);
    CHECK(shallow_json(R"({"a": "\\"})" + many).empty());
    CHECK(shallow_json("").empty());
}

}  // namespace json_depth_test
