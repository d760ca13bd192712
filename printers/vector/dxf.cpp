// Writes DXF groups: a code on one line, its value on the next.
#include "printers/vector/dxf.h"

#include <fmt/format.h>

#include <iterator>

#include "engine/base/number_format.h"
#include "printers/vector/cut_sheets.h"

namespace lamella {
namespace {

constexpr int dxf_decimals = 4;  // 0.1 um

struct DxfLayer {
    const char* name;
    int colour;  ///< colour index of AutoCAD: 1 red, 3 green, 5 blue, 7 black or white
};
constexpr DxfLayer dxf_layers[cut_purposes] = {
    {"ENGRAVE", 7}, {"SCORE", 3}, {"CUT_INNER", 5}, {"CUT_OUTER", 1}};

void append_group(std::string& text, int code, std::string_view value) {
    fmt::format_to(std::back_inserter(text), "{}\n{}\n", code, value);
}

void append_point(std::string& text, dvec2 p) {
    text += "10\n";
    append_number(text, p.x, dxf_decimals);
    text += "\n20\n";
    append_number(text, p.y, dxf_decimals);
    text += "\n30\n0\n";
}

void append_variable(std::string& text, std::string_view name, int code, std::string_view value) {
    append_group(text, 9, name);
    append_group(text, code, value);
}

std::string header(dvec2 size) {
    std::string text;
    append_group(text, 0, "SECTION");
    append_group(text, 2, "HEADER");
    append_variable(text, "$ACADVER", 1, "AC1009");
    append_variable(text, "$INSUNITS", 70, "4");
    append_variable(text, "$MEASUREMENT", 70, "1");
    append_group(text, 9, "$EXTMIN");
    append_point(text, {0, 0});
    append_group(text, 9, "$EXTMAX");
    append_point(text, size);
    append_group(text, 0, "ENDSEC");
    return text;
}

std::string tables() {
    std::string text;
    append_group(text, 0, "SECTION");
    append_group(text, 2, "TABLES");
    append_group(text, 0, "TABLE");
    append_group(text, 2, "LTYPE");
    append_group(text, 70, "1");
    append_group(text, 0, "LTYPE");
    append_group(text, 2, "CONTINUOUS");
    append_group(text, 70, "0");
    append_group(text, 3, "Solid line");
    append_group(text, 72, "65");
    append_group(text, 73, "0");
    append_group(text, 40, "0");
    append_group(text, 0, "ENDTAB");
    append_group(text, 0, "TABLE");
    append_group(text, 2, "LAYER");
    append_group(text, 70, std::to_string(cut_purposes));
    for (const DxfLayer& layer : dxf_layers) {
        append_group(text, 0, "LAYER");
        append_group(text, 2, layer.name);
        append_group(text, 70, "0");
        append_group(text, 62, std::to_string(layer.colour));
        append_group(text, 6, "CONTINUOUS");
    }
    append_group(text, 0, "ENDTAB");
    append_group(text, 0, "ENDSEC");
    return text;
}

void append_polyline(std::string& text, const SheetPath& path) {
    const char* layer = dxf_layers[static_cast<std::size_t>(path.purpose)].name;
    append_group(text, 0, "POLYLINE");
    append_group(text, 8, layer);
    append_group(text, 66, "1");
    append_point(text, {0, 0});
    append_group(text, 70, path.closed ? "1" : "0");
    for (const dvec2& p : path.points) {
        append_group(text, 0, "VERTEX");
        append_group(text, 8, layer);
        append_point(text, p);
    }
    append_group(text, 0, "SEQEND");
    append_group(text, 8, layer);
}

class DxfSheetFormat : public SheetFormat {
  public:
    std::string extension() const override { return ".dxf"; }
    std::string start(dvec2 size) const override {
        std::string text = header(size) + tables();
        append_group(text, 0, "SECTION");
        append_group(text, 2, "ENTITIES");
        return text;
    }
    std::string content(const Sheet& sheet) const override {
        std::string text;
        append_group(text, 999, sheet.label);
        for (const SheetPath& path : sheet.paths) append_polyline(text, path);
        return text;
    }
    std::string end() const override { return "0\nENDSEC\n0\nEOF\n"; }
};

}  // namespace

std::unique_ptr<Backend> make_dxf(const PrinterProfile& profile, const std::string& path, bool force) {
    const auto format = std::make_shared<DxfSheetFormat>();
    if (!profile.cutting.sheet.empty()) return make_nested_sheets(profile, format, path, force);
    PrinterProfile folder = profile;
    folder.vector.one_file = false;
    return make_layer_sheets(folder, format, path, force);
}

}  // namespace lamella
