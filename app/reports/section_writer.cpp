// Writes one section as paths, polygons or pixels.
#include "app/reports/section_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/reports/grey_page.h"
#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/io/image_file.h"

namespace lamella {

namespace {

constexpr double max_pixels = 1 << 28;

int pixels(double length, double pixel) { return std::max(1, static_cast<int>(std::ceil(length / pixel))); }

RowBand page_band(const Rect& page, const ImageProfile& image) {
    const dvec2 size = page.size();
    if (std::ceil(size.x / image.pixel_x) * std::ceil(size.y / image.pixel_y) > max_pixels) {
        throw InputError(
            fmt::format("printer.pixel / --printer-pixel: with pixels of {} x {} mm a page has more than {} "
                        "pixels at {} x {} mm; accepted: larger pixels",
                        image.pixel_x, image.pixel_y, max_pixels, size.x, size.y));
    }
    RowBand band;
    band.along_origin = page.lo.x;
    band.along_pitch = image.pixel_x;
    band.across_origin = page.hi.y;
    band.across_pitch = -image.pixel_y;
    band.sub = image.antialiasing == Antialiasing::off ? 1 : image.sub_rows;
    band.hi = pixels(size.x, image.pixel_x);
    band.count = pixels(size.y, image.pixel_y);
    return band;
}

std::vector<Contour> traced(const SliceField& slice, double tolerance) {
    Scratch scratch;
    return trace_contours(slice, tolerance, scratch);
}

}  // namespace

std::string section_svg(const PlaneCut& cut, double tolerance) {
    const dvec2 size = cut.page.size();
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} "
        "{1}\">\n",
        size.x, size.y);
    const auto add = [&](const SliceField& slice, const char* attributes) {
        text += fmt::format("<path {} fill-rule=\"evenodd\" d=\"", attributes);
        for (const Contour& contour : traced(slice, tolerance)) {
            char command = 'M';
            for (const dvec2& p : contour.points) {
                fmt::format_to(std::back_inserter(text), "{}{:.5f} {:.5f}", command, p.x - cut.page.lo.x,
                               cut.page.hi.y - p.y);
                command = 'L';
            }
            text += "Z\n";
        }
        text += "\"/>\n";
    };
    add(cut.part, "fill=\"black\"");
    if (cut.supports) add(*cut.supports, "class=\"support\" fill=\"#0080ff\"");
    return text + "</svg>\n";
}

std::string section_json(const PlaneCut& cut, double tolerance) {
    nlohmann::ordered_json json{{"z", cut.z}};
    const auto add = [&](const SliceField& slice, const std::string& prefix) {
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        double area = 0;
        for (const Contour& contour : traced(slice, tolerance)) {
            area += signed_area(contour.points);
            nlohmann::ordered_json points = nlohmann::ordered_json::array();
            for (const dvec2& p : contour.points) points.push_back({p.x, p.y});
            list.push_back(
                {{"hole", contour.hole}, {"parent", contour.parent}, {"points", std::move(points)}});
        }
        json[prefix + "area_mm2"] = area;
        json[prefix + "contours"] = std::move(list);
    };
    add(cut.part, "");
    if (cut.supports) add(*cut.supports, "support_");
    return json.dump() + "\n";
}

std::string section_png(const PlaneCut& cut, const PrinterProfile& printer) {
    const ImageProfile& image = printer.image;
    const bool antialiased = image.antialiasing != Antialiasing::off;
    const RowBand band = page_band(cut.page, image);
    std::vector<std::uint8_t> grey = grey_page(cut.part, band, antialiased);
    if (cut.supports) {
        const std::vector<std::uint8_t> supports = grey_page(*cut.supports, band, antialiased);
        for (std::size_t i = 0; i < grey.size(); ++i) {
            const auto dimmed = static_cast<std::uint8_t>(std::lround(supports[i] * printer.support.grey));
            grey[i] = std::max(grey[i], dimmed);
        }
    }
    // Grey is coverage, not light: no gamma correction.
    const std::vector<std::byte> file =
        encode_image("section.png", {band.hi, band.count, 1, grey, image.pixel_x, image.pixel_y, true});
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text
    return {reinterpret_cast<const char*>(file.data()), file.size()};
}

}  // namespace lamella
