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
             "Pixel layout of the images of NanoDLP archives: rgb: each pixel in all three colours; packed: "
             "three neighbours as the colours of one (panels without colour filters); grey: grey images."}));
}

}  // namespace lamella
