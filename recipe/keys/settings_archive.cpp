// The rows of the settings table about archives of masks.
#include "recipe/keys/settings_rows.h"

namespace lamella {

const std::vector<std::string>& choice_names(PanelPixels) {
    static const std::vector<std::string> list{"rgb", "packed", "grey"};
    return list;
}

void add_archive_settings(std::vector<Setting>& table) {
    table.push_back(row<[](Recipe & r) -> auto& { return r.printer.nanodlp.pixels; }>(
        "printer", "panel", "--printer-panel",
        {.help =
             "How pixels stand in the images of NanoDLP archives: each in all three colours, three side by "
             "side as the colours of one (panels without colour filters), or as grey images."}));
}

}  // namespace lamella
