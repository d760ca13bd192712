// The rows of the settings table about the plate: copies of the part.
#include "recipe/keys/settings_rows.h"

namespace lamella {

void add_plate_settings(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.plate.copies; }>(
        "plate", "copies", "--copies",
        {.limits = {1, 10000},
         .fallback = "1",
         .help = "Number of copies of the part on the plate, in rows."}));
    t.push_back(row<[](Recipe & r) -> auto& {
        return r.plate.gap;
    }>("plate", "gap", "--plate-gap",
       {.unit = "mm", .limits = {0, 1000}, .fallback = "5", .help = "Gap between neighbours on the plate."}));
}

}  // namespace lamella
