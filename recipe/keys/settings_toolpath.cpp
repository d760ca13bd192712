// The rows of the settings table about an extruder's toolpaths: walls, infill, seam, brim and skirt.
#include "recipe/keys/settings_rows.h"

namespace lamella {

const std::vector<std::string>& choice_names(InfillPattern) {
    static const std::vector<std::string> list{"lines", "concentric"};
    return list;
}
const std::vector<std::string>& choice_names(Seam) {
    static const std::vector<std::string> list{"nearest", "rear", "corner"};
    return list;
}

void add_toolpath_settings(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.toolpath.walls; }>(
        "printer", "walls", "--printer-walls",
        {.unit = "beads",
         .limits = {1, 1000},
         .help = "Number of perimeters around each island, the outermost included. Walls too thin for two "
                 "beads get one along their centre line."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.toolpath.top_layers; }>(
        "printer", "top_layers", "--printer-top-layers",
        {.unit = "layers",
         .limits = {0, 1000},
         .help = "Number of solid layers below top surfaces, when infill is sparse."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.toolpath.bottom_layers; }>(
        "printer", "bottom_layers", "--printer-bottom-layers",
        {.unit = "layers",
         .limits = {0, 1000},
         .help = "Number of solid layers above bottom surfaces, when infill is sparse."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.toolpath.infill; }>(
        "printer", "infill", "--printer-infill", {.help = "Pattern of the beads inside the walls."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.toolpath.seam; }>(
        "printer", "seam", "--printer-seam", {.help = "Start and end point of loops."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.toolpath.brim; }>(
        "printer", "brim", "--printer-brim",
        {.unit = "mm",
         .limits = {0, 1000},
         .help = "Width of the loops around the first layer that improve its adhesion."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.toolpath.skirt; }>(
        "printer", "skirt", "--printer-skirt",
        {.unit = "loops",
         .limits = {0, 1000},
         .help = "Number of separate loops around the first layer that prime the nozzle."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.toolpath.skirt_distance; }>(
        "printer", "skirt_distance", "--printer-skirt-distance",
        {.unit = "mm",
         .limits = {0, 1000},
         .help = "Distance from the first layer, or its brim, to the skirt."}));
}

}  // namespace lamella
