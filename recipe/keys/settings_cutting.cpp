// The rows of the settings table about cutting layers out of sheets.
#include "recipe/keys/settings_rows.h"

namespace lamella {

const std::vector<std::string>& choice_names(Laser) {
    static const std::vector<std::string> list{"none",   "generic",   "lightburn", "trotec",
                                               "epilog", "glowforge", "xtool"};
    return list;
}
const std::vector<std::string>& choice_names(Ties) {
    static const std::vector<std::string> list{"none", "join", "refuse"};
    return list;
}
const std::vector<std::string>& choice_names(SvgDialect) {
    static const std::vector<std::string> list{"plain", "slic3r"};
    return list;
}

namespace {

template <auto member>
void add_cutting_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    constexpr auto place = [](Recipe & r) -> auto& { return r.printer.cutting.*member; };
    t.push_back(row<place>("printer", key, flag, std::move(facts)));
}

void add_strokes(std::vector<Setting>& t) {
    using C = CuttingProfile;
    add_cutting_row<&C::laser>(t, "laser", "--printer-laser",
                               {.help = "Laser software that reads the sheets; its colours distinguish cuts, "
                                        "scores and engravings; none: red cuts."});
    add_cutting_row<&C::dialect>(
        t, "dialect", "--printer-dialect",
        {.help = "Dialect of SVG files: plain, or a stack of slices as exported by Slic3r."});
    add_cutting_row<&C::kerf>(
        t, "kerf", "--printer-kerf",
        {.unit = "mm",
         .limits = {0, 10},
         .help = "Width of material that the cutter removes: cuts are offset from the part by half of it."});
    add_cutting_row<&C::ties>(t, "ties", "--printer-ties",
                              {.help = "Treatment of a layer of several loose pieces: left as they are "
                                       "(none), joined by bars, or the run is refused."});
    add_cutting_row<&C::tie_width>(
        t, "tie_width", "--printer-tie-width",
        {.unit = "mm", .limits = {0.01, 1000}, .help = "Width of bars that join loose pieces."});
    add_cutting_row<&C::numbers>(t, "numbers", "--printer-numbers",
                                 {.help = "Engrave each layer's number if its material has space for it."});
    add_cutting_row<&C::number_height>(
        t, "number_height", "--printer-number-height",
        {.unit = "mm", .limits = {0.1, 1000}, .help = "Maximum height of the digits of layer numbers."});
    add_cutting_row<&C::next_outline>(t, "next_outline", "--printer-next-outline",
                                      {.help = "Score the outline of the next layer on each layer."});
}

void add_sheets(std::vector<Setting>& t) {
    using C = CuttingProfile;
    add_cutting_row<&C::sheet>(
        t, "sheet", "--printer-sheet",
        {.unit = "mm",
         .limits = {1, 1e5},
         .shape = {2, 1, "a width and a height [w, h]"},
         .fallback = "each layer is a separate sheet",
         .help = "Size of the sheets on which layers are laid out, one file per sheet."});
    add_cutting_row<&C::sheet_margin>(t, "sheet_margin", "--printer-sheet-margin",
                                      {.unit = "mm",
                                       .limits = {0, 1e4},
                                       .help = "Free margin at the edges of a sheet and between layers."});
}

void add_dowels(std::vector<Setting>& t) {
    using C = CuttingProfile;
    add_cutting_row<&C::dowels>(
        t, "dowels", "--printer-dowels",
        {.limits = {0, 3},
         .help = "Holes through all layers for pins that align them: none, 2 or 3, placed so that "
                 "no layer fits turned over."});
    add_cutting_row<&C::dowel_diameter>(
        t, "dowel_diameter", "--printer-dowel-diameter",
        {.unit = "mm", .limits = {0.1, 1000}, .help = "Diameter of the dowel holes."});
    add_cutting_row<&C::dowel_margin>(
        t, "dowel_margin", "--printer-dowel-margin",
        {.unit = "mm", .limits = {0, 1000}, .help = "Minimum material around a dowel hole in every layer."});
    add_cutting_row<&C::dowel_height>(
        t, "dowel_height", "--printer-dowel-height",
        {.unit = "mm",
         .limits = {0, 1e5},
         .help = "Height above the bed up to which dowel holes reach; 0: through all layers."});
    add_cutting_row<&C::dowel_at>(t, "dowel_at", "--printer-dowel-at",
                                  {.unit = "mm",
                                   .limits = {-1e6, 1e6},
                                   .shape = {2, 0, "places [[x, y], ...]"},
                                   .fallback = "found by a survey of the layers",
                                   .help = "Positions of the dowel holes."});
}

}  // namespace

void add_cutting_settings(std::vector<Setting>& table) {
    add_strokes(table);
    add_sheets(table);
    add_dowels(table);
}

}  // namespace lamella
