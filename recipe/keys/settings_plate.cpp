// The rows of the settings table about the plate: copies of the part.
#include "recipe/keys/settings_rows.h"

namespace lamella {

void add_plate_settings(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.plate.copies; }>(
        "plate", "copies", "--copies",
        {.limits = {1, 10000},
         .fallback = "1",
         .help = "Number of copies of the part: in rows on one plate, or nested on several."}));
    t.push_back(row<[](Recipe & r) -> auto& {
        return r.plate.gap;
    }>("plate", "gap", "--plate-gap",
       {.unit = "mm", .limits = {0, 1000}, .fallback = "5", .help = "Gap between neighbours on the plate."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.plate.turn; }>(
        "plate", "turn", "--plate-turn",
        {.fallback = "false", .help = "Turn parts by right angles where they fill the plate better."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.plate.number; }>(
        "plate", "number", "--plate",
        {.limits = {1, 10000}, .fallback = "1", .help = "The plate to make, where the parts need several."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.plate.one_by_one; }>(
        "plate", "one_by_one", "--one-by-one",
        {.fallback = "false",
         .help = "Print each part from the bed up before the next, the lowest first; for filament."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.plate.piece; }>(
        "plate", "piece", "--piece",
        {.limits = {0, 256},
         .fallback = "0",
         .help = "The piece to make of a part that [[cut]] divides, from 1; 0: all of them."}));
}

}  // namespace lamella
