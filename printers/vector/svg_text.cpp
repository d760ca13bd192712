// Root element and path data of SVG files.
#include "printers/vector/svg_text.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/number_format.h"

namespace lamella {

void check_page(const VectorProfile& profile) {
    if (!(profile.margin >= 0 && profile.margin <= 1e4)) {
        throw InputError(fmt::format("margin = {} mm: must be 0 to 10000", profile.margin));
    }
    if (!(profile.tolerance >= 1e-4 && profile.tolerance <= 10)) {
        throw InputError(fmt::format("tolerance = {} mm: must be 0.0001 to 10", profile.tolerance));
    }
}

std::string svg_start(dvec2 size) {
    const std::string width = format_number(size.x, svg_decimals);
    const std::string height = format_number(size.y, svg_decimals);
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"no\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\"\n"
        "     xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"\n"
        "     xmlns:slic3r=\"http://slic3r.org/namespaces/slic3r\"\n"
        "     version=\"1.1\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n",
        width, height);
}

void append_svg_line(std::string& data, const std::vector<dvec2>& points, bool closed, dvec2 left_top) {
    char command = 'M';
    for (const dvec2& p : points) {
        data.push_back(command);
        append_number(data, p.x - left_top.x, svg_decimals);
        data.push_back(' ');
        append_number(data, left_top.y - p.y, svg_decimals);
        command = 'L';
    }
    data += closed ? "Z\n" : "\n";
}

}  // namespace lamella
