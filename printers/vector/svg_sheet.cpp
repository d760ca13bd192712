// Writes a group per sheet, and an element per layer and purpose.
#include "printers/vector/svg_sheet.h"

#include <fmt/format.h>

#include "engine/base/number_format.h"
#include "printers/vector/laser_strokes.h"
#include "printers/vector/svg_text.h"

namespace lamella {
namespace {

constexpr const char* purpose_names[cut_purposes] = {"engrave", "score", "cut-inner", "cut-outer"};

}  // namespace

std::string SvgSheetFormat::start(dvec2 size) const { return svg_start(size); }

std::string SvgSheetFormat::end() const { return svg_end; }

std::string SvgSheetFormat::content(const Sheet& sheet) const {
    std::string text = fmt::format("<g id=\"{}\" inkscape:groupmode=\"layer\" inkscape:label=\"{}\">\n",
                                   sheet.id, sheet.label);
    for (std::size_t i = 0; i < sheet.paths.size();) {
        const SheetPath& first = sheet.paths[i];
        const auto purpose = static_cast<std::size_t>(first.purpose);
        const LaserStroke& stroke = laser_strokes(laser_)[purpose];
        text += fmt::format(
            "<path id=\"layer{:04}-{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" d=\"\n", first.layer,
            purpose_names[purpose], stroke.colour, format_number(stroke.width, svg_decimals));
        for (; i < sheet.paths.size(); ++i) {
            const SheetPath& path = sheet.paths[i];
            if (path.purpose != first.purpose || path.layer != first.layer) break;
            append_svg_line(text, path.points, path.closed, {0, sheet.size.y});
        }
        text += "\"/>\n";
    }
    return text + "</g>\n";
}

}  // namespace lamella
