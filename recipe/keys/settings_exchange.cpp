// The rows of the settings table about files for other programs and powder-bed machines: CLI and 3MF.
#include "recipe/keys/settings_rows.h"

namespace lamella {

const std::vector<std::string>& choice_names(CliFormat) {
    static const std::vector<std::string> list{"binary", "ascii"};
    return list;
}

void add_exchange_settings(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.exchange.cli_format; }>(
        "printer", "cli_format", "--printer-cli-format", {.help = "Encoding of a CLI file's layers."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.exchange.cli_units; }>(
        "printer", "cli_units", "--printer-cli-units",
        {.unit = "mm", .limits = {1e-4, 1000}, .help = "Length of one coordinate unit of a CLI file."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.exchange.cli_empty_layer; }>(
        "printer", "cli_empty_layer", "--printer-cli-empty-layer",
        {.help = "Begin a CLI file with an empty layer below the first one, because machines derive the "
                 "first layer's thickness from it."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.exchange.package_layers; }>(
        "printer", "package_layers", "--printer-package-layers",
        {.unit = "layers", .limits = {1, 100000}, .help = "Slices in each file inside a 3MF package."}));
}

}  // namespace lamella
