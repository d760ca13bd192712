// The page of a print check: whole in itself, well-formed, and the same for the same part.
#include <catch2/catch.hpp>
#include <pugixml.hpp>
#include <regex>

#include "tests/app/commands/boxes_mesh.h"
#include "tests/app/commands/command_run.h"

namespace check_page_test {

using namespace lamella;

namespace {

/// A block with four pins that hang from it and one that lies beside it: something fails in several ways.
std::string part_in(const Folder& folder) {
    std::vector<Box> boxes{{{-10, -10, 8}, {10, 10, 12}}, {{-2, -2, 0}, {2, 2, 9}}};
    for (const double x : {-8.0, -4.0, 4.0, 8.0}) boxes.push_back({{x, 6, 5}, {x + 0.2, 6.2, 9}});
    boxes.push_back({{14, 0, 0}, {16, 2, 2}});
    write(folder / "pins.obj", boxes_obj(boxes));
    return folder / "pins.obj" + " --layer-height 0.25 --printer marlin ";
}

std::string page_of(const Folder& folder, const std::string& arguments, const std::string& name) {
    const Outcome run = run_lamella("check -q " + arguments + " --report " + folder / name);
    CHECK(run.code == 1);
    return contents(folder / name);
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++found;
    return found;
}

}  // namespace

TEST_CASE("a page of a check is well-formed, needs no other file and no script", "[check]") {
    const Folder folder;
    const std::string page = page_of(folder, part_in(folder) + "--name 'a<b> & \"c\"'", "page.html");
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_string(page.c_str(), pugi::parse_full);
    INFO(parsed.description() << " at byte " << parsed.offset);
    REQUIRE(parsed);
    const pugi::xml_node body = document.child("html").child("body");
    CHECK(std::string(body.select_node(".//h1").node().child_value()) ==
          "Can a<b> & \"c\" be printed on marlin?");
    CHECK(body.select_nodes("//script").empty());
    CHECK(body.select_nodes("//link").empty());
    CHECK_FALSE(body.select_nodes("//table//tr").empty());
    for (const pugi::xpath_node& found : body.select_nodes("//@src | //@href")) {
        const std::string target = found.attribute().value();
        CHECK((target.starts_with("data:image/png;base64,iVBORw0KGgo") || target.starts_with("#")));
    }
    // Nothing else that a browser would fetch, and nothing that changes from day to day.
    CHECK(count(page, "http") == count(page,
                                       "xmlns"
                                       "=\"http://www.w3.org/"));
    CHECK(count(page, "url(") == 0);
    CHECK(count(page, "@import") == 0);
    CHECK_FALSE(std::regex_search(page, std::regex("20[0-9][0-9]-[0-9][0-9]")));
}

TEST_CASE("a page has a card for every place that is told of, where it is told to be", "[check]") {
    const Folder folder;
    const std::string page = page_of(folder, part_in(folder), "page.html");
    pugi::xml_document document;
    REQUIRE(document.load_string(page.c_str()));
    const pugi::xml_node body = document.child("html").child("body");
    const auto of = [&](const std::string& check) {
        return body.select_nodes(("//h2[@id='" + check + "']/following-sibling::div[1]/figure").c_str());
    };
    CHECK(of("connectivity").size() == 1);
    CHECK(of("islands").size() == 4);  // the pins
    CHECK(of("thickness").size() == 4);
    CHECK(of("build_volume").empty());
    for (const pugi::xpath_node& found : body.select_nodes("//figure")) {
        const pugi::xml_node svg = found.node().child("svg");
        CHECK(svg.select_nodes("image").size() == 1);    // the section
        CHECK(svg.select_nodes("g/image").size() == 1);  // its whole layer
        CHECK(std::string(svg.child("text").child_value()).ends_with(" mm"));
    }
    const std::string loose = of("connectivity").first().node().child("figcaption").child("b").child_value();
    CHECK(loose.starts_with("1. "));
    CHECK(std::stod(loose.substr(3)) == Approx(8).epsilon(0.1));
    CHECK(page.size() < 2'000'000);
}

TEST_CASE("a page is the same by any number of threads", "[check]") {
    const Folder folder;
    const std::string part = part_in(folder);
    const std::string one = page_of(folder, part + "--threads 1", "one.html");
    CHECK(page_of(folder, part + "--threads 4", "four.html") == one);
    CHECK(page_of(folder, part + "--check-places 1", "few.html").size() < one.size());
}

}  // namespace check_page_test
