// The rows of the settings table about the machine: images, vectors, filament.
#include <cmath>

#include "recipe/keys/settings_rows.h"
#include "recipe/printer_choice.h"

namespace lamella {

const std::vector<std::string>& choice_names(ImageFormat) {
    static const std::vector<std::string> list{"png", "tiff", "bmp", "pgm"};
    return list;
}
const std::vector<std::string>& choice_names(Antialiasing) {
    static const std::vector<std::string> list{"off", "rows", "exact"};
    return list;
}

namespace {

constexpr Limits speed{0.1, 2000};

void add_machine(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.name; }>(
        "printer", "profile", "--printer",
        {.fallback = default_profile,
         .help = "Machine profile to start from: a name that `lamella printers` lists, a back-end's name for "
                 "its defaults, or a profile's .toml file; in a recipe, relative to the recipe's folder."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.backend; }>(
        "printer", "kind", "--printer-kind",
        {.choices = backend_words(), .help = "Back-end that makes the output."}));
}

/// The pixel size in dots per inch, as printheads state it. The value read back is rounded to 1e-6, because
/// two divisions do not return exactly the number that was given.
Setting dots_per_inch() {
    constexpr double inch = 25.4;  // mm
    Setting s = described<double>("printer", "dpi", "--printer-dpi",
                                  {.unit = "dots per inch",
                                   .limits = {0.003, 25'000},
                                   .help = "Square pixels given as dots per inch, instead of pixel."});
    s.store = [](Recipe& r, std::size_t, const Value& value) {
        r.printer.image.pixel_x = r.printer.image.pixel_y = inch / std::get<double>(value);
    };
    s.load = [](const Recipe& r, std::size_t) -> Value {
        return std::round(inch / r.printer.image.pixel_x * 1e6) / 1e6;
    };
    return s;
}

void add_display_rows(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.width; }>(
        "printer", "width", "--printer-width",
        {.unit = "px", .limits = {1, 65535}, .help = "Width of the display."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.height; }>(
        "printer", "height", "--printer-height",
        {.unit = "px", .limits = {1, 65535}, .help = "Height of the display."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.pixel_x; }, [](Recipe & r) -> auto& {
        return r.printer.image.pixel_y;
    }>("printer", "pixel", "--printer-pixel",
       {.unit = "mm", .limits = length_limits, .help = "Edge of a square pixel; sets pixel_x and pixel_y."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.pixel_x; }>(
        "printer", "pixel_x", "--printer-pixel-x",
        {.unit = "mm", .limits = length_limits, .help = "Size of a pixel along the display's width."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.pixel_y; }>(
        "printer", "pixel_y", "--printer-pixel-y",
        {.unit = "mm", .limits = length_limits, .help = "Size of a pixel along the display's height."}));
    t.push_back(dots_per_inch());
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.format; }>(
        "printer", "format", "--printer-format", {.help = "File format of the images of a stack."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.mirror_x; }>(
        "printer", "mirror_x", "--printer-mirror-x", {.help = "Mirror the images left to right."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.mirror_y; }>(
        "printer", "mirror_y", "--printer-mirror-y", {.help = "Mirror the images top to bottom."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.portrait; }>(
        "printer", "portrait", "--printer-portrait", {.help = "Image columns run along +y of the plate."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.antialiasing; }>(
        "printer", "antialiasing", "--printer-antialiasing",
        {.help = "Grey edges: off, from sub_rows lines per pixel row, or from exact areas."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.sub_rows; }>(
        "printer", "sub_rows", "--printer-sub-rows",
        {.limits = {1, 64}, .help = "Lines per pixel row for antialiasing = \"rows\"."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.bits; }>(
        "printer", "bits", "--printer-bits",
        {.limits = {1, 16}, .help = "Bits of a pixel in a stack of PNG files: 1, 8 or 16."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.sub_layers; }>(
        "printer", "sub_layers", "--printer-sub-layers",
        {.limits = {1, 64},
         .help = "Number of planes per layer whose masks are averaged, so that slopes get grey edges."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.gamma; }>(
        "printer", "gamma", "--printer-gamma",
        {.limits = {0.1, 10}, .help = "Grey of a pixel is its coverage to this power."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.min_grey; }>(
        "printer", "least_grey", "--printer-least-grey",
        {.limits = {0, 1}, .help = "Grey value of barely covered pixels, as a share of white."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.full_grey; }>(
        "printer", "full_grey", "--printer-full-grey",
        {.limits = {0, 1}, .help = "Grey value of fully covered pixels, as a share of white."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.margin; }>(
        "printer", "display_margin", "--printer-display-margin",
        {.unit = "mm", .limits = {0, 1000}, .help = "Margin of the display that a part must not enter."}));
}

void add_host(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.host; }>(
        "host", "name", "--host",
        {.help =
             "Printer on the network that `lamella send` sends to: its name in hosts.toml, or its kind and "
             "address, such as moonraker+http://voron.local. Keys never stand here."}));
}

void add_resin(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.machine; }>(
        "printer", "machine", "--printer-machine",
        {.help = "Model for which an archive is made; SL1 machines refuse archives for another model. Empty: "
                 "the profile's name."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.material; }>(
        "printer", "material", "--printer-material", {.help = "Name of the resin."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.exposure; }>(
        "printer", "exposure", "--printer-exposure",
        {.unit = "s", .limits = {0.01, 1000}, .help = "Exposure of a layer."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.first_exposure; }>(
        "printer", "first_exposure", "--printer-first-exposure",
        {.unit = "s", .limits = {0.01, 1000}, .help = "Exposure of the first layers."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.penetration; }>(
        "printer", "penetration", "--printer-penetration",
        {.unit = "mm",
         .limits = {0, 10},
         .help =
             "Depth at which light has faded to 1/e in the resin: a layer that is higher by this is exposed "
             "e times as long. 0: all layers have the same exposure."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.exposure_height; }>(
        "printer", "exposure_height", "--printer-exposure-height",
        {.unit = "mm",
         .limits = {0.001, 10},
         .help = "Height of the layers that the exposures are meant for; others follow by penetration."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.first_layers; }>(
        "printer", "first_layers", "--printer-first-layers",
        {.unit = "layers",
         .limits = {1, 100},
         .help = "Number of layers exposed like the first one; SL1 machines use 3."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.lift; }>(
        "printer", "lift", "--printer-lift",
        {.unit = "mm", .limits = {0.1, 100}, .help = "Height by which the plate rises after each layer."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.lift_speed; }>(
        "printer", "lift_speed", "--printer-lift-speed",
        {.unit = "mm/min", .limits = {1, 10000}, .help = "Speed at which the plate rises."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.retract_speed; }>(
        "printer", "retract_speed", "--printer-retract-speed",
        {.unit = "mm/min", .limits = {1, 10000}, .help = "Speed at which the plate returns."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.fade_layers; }>(
        "printer", "fade_layers", "--printer-fade-layers",
        {.unit = "layers",
         .limits = {0, 100},
         .help =
             "Number of layers over which the exposure changes from the first one's to the normal one."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.moves; }>(
        "printer", "layer_moves", "--printer-layer-moves",
        {.unit = "s", .limits = {0, 1000}, .help = "Time of a layer in addition to its exposure."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.preview; }>(
        "printer", "preview", "--printer-preview",
        {.help = "Put pictures of the part into SL1 and GOO files; for G-code see thumbnails."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.resin.notes; }>(
        "printer", "notes", "--printer-notes",
        {.help = "Keywords for programs that convert SL1 archives, such as FILEFORMAT_goo."}));
}

void add_vector(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.vector.tolerance; }, [](Recipe & r) -> auto& {
        return r.printer.filament.tolerance;
    }>("printer", "tolerance", "--printer-tolerance",
       {.unit = "mm",
        .limits = {0.0005, 10},
        .help = "Largest distance between a contour and the surface."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.vector.one_file; }>(
        "printer", "one_file", "--printer-one-file",
        {.help = "One vector file with a group a layer instead of a folder of files."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.vector.margin; }>(
        "printer", "margin", "--printer-margin",
        {.unit = "mm", .limits = {0, 1000}, .help = "Empty margin around the part in vector files."}));
}

/// Adds a number of the [printer] section.
template <auto member>
void add_machine_number(std::vector<Setting>& t, const char* key, const char* flag, const char* unit,
                        Limits limits, const char* help) {
    constexpr auto place = [](Recipe & r) -> auto& { return r.printer.filament.*member; };
    t.push_back(row<place>("printer", key, flag, {.unit = unit, .limits = limits, .help = help}));
}

void add_filament(std::vector<Setting>& t) {
    add_machine_number<&FilamentProfile::bed_x>(t, "bed_x", "--printer-bed-x", "mm", {1, 1e5},
                                                "Width of the bed.");
    add_machine_number<&FilamentProfile::bed_y>(t, "bed_y", "--printer-bed-y", "mm", {1, 1e5},
                                                "Depth of the bed.");
    add_machine_number<&FilamentProfile::bed_z>(t, "bed_z", "--printer-bed-z", "mm", {1, 1e5},
                                                "Largest height of a print.");
    add_machine_number<&FilamentProfile::nozzle>(t, "nozzle", "--printer-nozzle", "mm", {0.05, 10},
                                                 "Diameter of the nozzle's bore.");
    add_machine_number<&FilamentProfile::filament>(t, "filament", "--printer-filament", "mm", {0.5, 10},
                                                   "Diameter of the filament.");
    add_machine_number<&FilamentProfile::line_width>(t, "line_width", "--printer-line-width", "mm",
                                                     {0.05, 20}, "Width of an extruded line.");
    add_machine_number<&FilamentProfile::infill_density>(t, "infill_density", "--printer-infill-density", "",
                                                         {0, 1}, "Share of the inside that is filled.");
    add_machine_number<&FilamentProfile::nozzle_temperature>(
        t, "nozzle_temperature", "--printer-nozzle-temperature", "degrees Celsius", {0, 500},
        "Temperature of the nozzle.");
    add_machine_number<&FilamentProfile::bed_temperature>(t, "bed_temperature", "--printer-bed-temperature",
                                                          "degrees Celsius", {0, 250},
                                                          "Temperature of the bed.");
    add_machine_number<&FilamentProfile::print_speed>(t, "print_speed", "--printer-print-speed", "mm/s",
                                                      speed, "Speed of printing.");
    add_machine_number<&FilamentProfile::first_layer_speed>(t, "first_layer_speed",
                                                            "--printer-first-layer-speed", "mm/s", speed,
                                                            "Speed of printing the first layer.");
    add_machine_number<&FilamentProfile::travel_speed>(t, "travel_speed", "--printer-travel-speed", "mm/s",
                                                       speed, "Speed of moves without extrusion.");
    add_machine_number<&FilamentProfile::retraction>(t, "retraction", "--printer-retraction", "mm", {0, 100},
                                                     "Length of filament retracted before a move.");
    add_machine_number<&FilamentProfile::retraction_speed>(
        t, "retraction_speed", "--printer-retraction-speed", "mm/s", speed, "Speed of retraction.");
}

}  // namespace

void add_printer_settings(std::vector<Setting>& table) {
    add_machine(table);
    add_display_rows(table);
    add_resin(table);
    add_archive_settings(table);
    add_vector(table);
    add_cutting_settings(table);
    add_filament(table);
    add_toolpath_settings(table);
    add_gcode_settings(table);
    add_exchange_settings(table);
    add_host(table);
}

}  // namespace lamella
