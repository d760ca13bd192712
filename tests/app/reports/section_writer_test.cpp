// Sections show supports apart from the part, and nothing new where there are none.
#include "app/reports/section_writer.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "engine/field/slice_context.h"
#include "tests/printers/masks/decode_image.h"
#include "tests/printers/toolpath/supported_table.h"

namespace section_writer_test {

using namespace lamella;
using namespace lamella::test;

namespace {

/// The block beside its support, cut at mid-height.
struct Cut {
    explicit Cut(bool with_supports) : with_supports_(with_supports) {}
    PlaneCut plane() {
        return {context_.slice(*job_.part, 0.5),
                with_supports_ ? &context_.slice(*job_.supports, 0.5) : nullptr, 0.5, job_.bounds.rect()};
    }

  private:
    bool with_supports_;
    Job job_ = block_beside_support();
    SliceContext context_;
};

constexpr double part_area = 4.03 * 6;
constexpr double support_area = 3 * 2;

}  // namespace

TEST_CASE("a section's supports are contours of their own", "[section]") {
    const auto json = nlohmann::json::parse(section_json(Cut(true).plane(), 0.01));
    CHECK(json["area_mm2"] == Approx(part_area).epsilon(2e-3));
    CHECK(json["support_area_mm2"] == Approx(support_area).epsilon(2e-3));
    REQUIRE(json["support_contours"].size() == 1);
    for (const auto& point : json["support_contours"][0]["points"]) CHECK(point[0].get<double>() > 0.02);
    const std::string svg = section_svg(Cut(true).plane(), 0.01);
    const std::string alone = section_svg(Cut(false).plane(), 0.01);
    CHECK(svg.find("class=\"support\" fill=\"#0080ff\"") > svg.find("fill=\"black\""));
    CHECK(svg.starts_with(alone.substr(0, alone.find("</svg>"))));
    CHECK(alone.find("support") == std::string::npos);
    CHECK(section_json(Cut(false).plane(), 0.01).find("support") == std::string::npos);
}

TEST_CASE("a section's pixels show supports in their grey", "[section]") {
    PrinterProfile printer;
    printer.image.pixel_x = printer.image.pixel_y = 0.1;
    printer.support.grey = 0.5;
    const auto decoded = [&](bool with_supports) {
        const std::string png = section_png(Cut(with_supports).plane(), printer);
        return decode_image(std::as_bytes(std::span(png)));
    };
    CHECK(decoded(false).filled() * 0.01 == Approx(part_area).epsilon(2e-3));
    const DecodedImage both = decoded(true);
    CHECK(both.filled() * 0.01 == Approx(part_area + 0.5 * support_area).epsilon(3e-3));
    CHECK(both.at(both.width / 2 + 15, both.height / 2) == 128);
    CHECK(both.at(both.width / 2 - 15, both.height / 2) == 255);
}

}  // namespace section_writer_test
