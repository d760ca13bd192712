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
    add_cutting_row<&C::laser>(
        t, "laser", "--printer-laser",
        {.help = "Software that reads the sheets, by whose colours cuts, scores and engravings "
                 "are told apart; none: red cuts."});
    add_cutting_row<&C::dialect>(
        t, "dialect", "--printer-dialect",
        {.help = "Reader of an SVG file: any, or one that takes stacks of slices as Slic3r exports them."});
    add_cutting_row<&C::kerf>(
        t, "kerf", "--printer-kerf",
        {.unit = "mm",
         .limits = {0, 10},
         .help = "Width of what the cutter takes away: cuts run half of it beside the part."});
    add_cutting_row<&C::ties>(
        t, "ties", "--printer-ties",
        {.help = "What becomes of a layer of several loose pieces: nothing, bars that join them, or "
                 "the run is refused."});
    add_cutting_row<&C::tie_width>(t, "tie_width", "--printer-tie-width",
                                   {.unit = "mm", .limits = {0.01, 1000}, .help = "Width of such bars."});
    add_cutting_row<&C::numbers>(t, "numbers", "--printer-numbers",
                                 {.help = "Engrave each layer's number where its material has room."});
    add_cutting_row<&C::number_height>(
        t, "number_height", "--printer-number-height",
        {.unit = "mm", .limits = {0.1, 1000}, .help = "Height of its digits, at most."});
    add_cutting_row<&C::next_outline>(t, "next_outline", "--printer-next-outline",
                                      {.help = "Score on each layer where the one above it comes to lie."});
}

void add_sheets(std::vector<Setting>& t) {
    using C = CuttingProfile;
    add_cutting_row<&C::sheet>(t, "sheet", "--printer-sheet",
                               {.unit = "mm",
                                .limits = {1, 1e5},
                                .shape = {2, 1, "a width and a height [w, h]"},
                                .fallback = "each layer is a sheet of its own",
                                .help = "Size of the sheets that layers are laid out on, one file a sheet."});
    add_cutting_row<&C::sheet_margin>(t, "sheet_margin", "--printer-sheet-margin",
                                      {.unit = "mm",
                                       .limits = {0, 1e4},
                                       .help = "Left free at the edges of such a sheet and between layers."});
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
        {.unit = "mm", .limits = {0.1, 1000}, .help = "Diameter of such a hole."});
    add_cutting_row<&C::dowel_margin>(
        t, "dowel_margin", "--printer-dowel-margin",
        {.unit = "mm", .limits = {0, 1000}, .help = "Material left about it in every layer."});
    add_cutting_row<&C::dowel_height>(
        t, "dowel_height", "--printer-dowel-height",
        {.unit = "mm",
         .limits = {0, 1e5},
         .help = "How far up from the bed such holes reach; 0: through all layers."});
    add_cutting_row<&C::dowel_at>(t, "dowel_at", "--printer-dowel-at",
                                  {.unit = "mm",
                                   .limits = {-1e6, 1e6},
                                   .shape = {2, 0, "places [[x, y], ...]"},
                                   .fallback = "found by a survey of the layers",
                                   .help = "Places of such holes instead."});
}

}  // namespace

void add_cutting_settings(std::vector<Setting>& table) {
    add_strokes(table);
    add_sheets(table);
    add_dowels(table);
}

}  // namespace lamella
