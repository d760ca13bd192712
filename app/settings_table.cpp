// The rows of the settings table: one line of facts for each key of a recipe.
#include <type_traits>

#include "app/printer_choice.h"
#include "app/settings.h"

namespace lamella {

namespace {

FoamRecipe& foam(Recipe& r) { return r.foam ? *r.foam : r.foam.emplace(); }
SkinRecipe& skin(Recipe& r) { return r.skin ? *r.skin : r.skin.emplace(); }

template <auto place>
using Placed = std::remove_reference_t<decltype(place(std::declval<Recipe&>()))>;

const std::vector<std::string>& words(Shape) {
    static const std::vector<std::string> list{"none",    "sphere", "box",   "cylinder",
                                               "capsule", "torus",  "gyroid"};
    return list;
}
const std::vector<std::string>& words(LengthUnit) {
    static const std::vector<std::string> list{"mm", "cm", "m", "inch"};
    return list;
}
const std::vector<std::string>& words(ImageFormat) {
    static const std::vector<std::string> list{"png", "tiff", "bmp", "pgm"};
    return list;
}
const std::vector<std::string>& words(Antialiasing) {
    static const std::vector<std::string> list{"off", "rows", "exact"};
    return list;
}

template <typename T>
constexpr ValueType type_of() {
    if constexpr (std::is_same_v<T, bool>) return ValueType::boolean;
    if constexpr (std::is_same_v<T, int> || std::is_same_v<T, std::int64_t>) return ValueType::integer;
    if constexpr (std::is_same_v<T, double>) return ValueType::number;
    if constexpr (std::is_same_v<T, std::string>) return ValueType::text;
    if constexpr (std::is_same_v<T, dvec3>) return ValueType::triple;
    return ValueType::choice;
}

template <typename T>
T from_value(const Value& value) {
    if constexpr (std::is_enum_v<T>) {
        const auto& list = words(T{});
        const auto& word = std::get<std::string>(value);
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (list[i] == word) return static_cast<T>(i);
        }
        return T{};
    } else if constexpr (std::is_same_v<T, int>) {
        return static_cast<int>(std::get<std::int64_t>(value));
    } else {
        return std::get<T>(value);
    }
}

template <typename T>
Value to_value(const T& held) {
    if constexpr (std::is_enum_v<T>) {
        return words(held)[static_cast<std::size_t>(held)];
    } else if constexpr (std::is_same_v<T, int>) {
        return static_cast<std::int64_t>(held);
    } else {
        return held;
    }
}

/// What the rows below say about a key besides its name and flag.
struct Facts {
    std::string unit{};
    Limits limits{};
    std::vector<std::string> choices{};
    std::string fallback{};
    std::string help{};
};

/// A row whose value is stored in one or several places of the recipe, and read from the first.
template <auto place, auto... others>
Setting row(std::string section, std::string key, std::string flag, Facts facts) {
    using Held = Placed<place>;
    Setting s{std::move(section),
              std::move(key),
              std::move(flag),
              facts.choices.empty() ? type_of<Held>() : ValueType::choice,
              std::move(facts.unit),
              facts.limits,
              std::move(facts.choices),
              std::move(facts.fallback),
              std::move(facts.help),
              [](Recipe& r, const Value& value) {
                  place(r) = from_value<Held>(value);
                  ((others(r) = place(r)), ...);
              },
              [](const Recipe& r) {
                  Recipe copy = r;
                  return to_value<Held>(place(copy));
              }};
    if constexpr (std::is_enum_v<Held>) {
        s.choices = words(Held{});
    }
    return s;
}

constexpr Limits any_length{1e-3, 1e4};
constexpr Limits extent{1e-2, 1e5};
constexpr Limits speed{0.1, 2000};

void add_part(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.mesh; }>(
        "part", "mesh", "--mesh",
        {.fallback = "a mesh or a shape must be given",
         .help = "Mesh file (STL, OBJ, PLY, 3MF); in a recipe, relative to the recipe's folder."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.shape; }>(
        "part", "shape", "--shape",
        {.fallback = "none", .help = "Body with a closed form, centred at the origin."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.radius; }>(
        "part", "radius", "--shape-radius",
        {.unit = "mm",
         .limits = extent,
         .fallback = "required by sphere, cylinder, capsule, torus",
         .help = "Radius; of a torus, of the circle in the middle of its tube."}));
    t.push_back(
        row<[](Recipe & r) -> auto& { return r.part.size; }>("part", "size", "--shape-size",
                                                             {.unit = "mm",
                                                              .limits = extent,
                                                              .fallback = "required by box, gyroid",
                                                              .help = "Edge lengths along x, y and z."}));
    t.push_back(
        row<[](Recipe & r) -> auto& { return r.part.height; }>("part", "height", "--shape-height",
                                                               {.unit = "mm",
                                                                .limits = extent,
                                                                .fallback = "required by cylinder, capsule",
                                                                .help = "Height from end to end, along z."}));
    t.push_back(
        row<[](Recipe & r) -> auto& { return r.part.tube; }>("part", "tube", "--shape-tube",
                                                             {.unit = "mm",
                                                              .limits = extent,
                                                              .fallback = "required by torus",
                                                              .help = "Radius of the tube of a torus."}));
    t.push_back(
        row<[](Recipe & r) -> auto& { return r.part.period; }>("part", "period", "--shape-period",
                                                               {.unit = "mm",
                                                                .limits = extent,
                                                                .fallback = "required by gyroid",
                                                                .help = "Length of one gyroid cell."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.thickness; }>(
        "part", "thickness", "--shape-thickness",
        {.unit = "mm",
         .limits = any_length,
         .fallback = "required by gyroid",
         .help = "Thickness of the gyroid's sheet."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.unit; }>(
        "part", "unit", "--unit",
        {.fallback = "mm", .help = "Unit of a mesh file whose format does not say."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.scale; }>(
        "part", "scale", "--scale",
        {.limits = {1e-6, 1e6}, .fallback = "1", .help = "Factor on the part's size, after the unit."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.name; }>(
        "part", "name", "--name",
        {.fallback = "the input's name", .help = "Short name for file names and headers."}));
}

void add_structure(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return foam(r).cell; }>(
        "foam", "cell", "--cell",
        {.unit = "mm",
         .limits = {0.05, 1000},
         .fallback = "required in [foam]",
         .help = "Mean diameter of a foam cell: one seed to every cell cubed."}));
    t.push_back(
        row<[](Recipe & r) -> auto& { return foam(r).beam; }>("foam", "beam", "--beam",
                                                              {.unit = "mm",
                                                               .limits = {0.005, 500},
                                                               .fallback = "required in [foam]",
                                                               .help = "Radius of the foam's beams."}));
    t.push_back(row<[](Recipe & r) -> auto& { return foam(r).seed; }>(
        "foam", "seed", "--seed",
        {.limits = {0, 9223372036854775807.0},
         .fallback = "1",
         .help = "Number that picks one foam among all."}));
    t.push_back(row<[](Recipe & r) -> auto& { return skin(r).thickness; }>(
        "skin", "thickness", "--skin",
        {.unit = "mm",
         .limits = {0, 1000},
         .fallback = "required in [skin]",
         .help = "Thickness of the closed skin, inward from the surface; 0 for none."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.layer_height; }>(
        "layers", "height", "--layer-height",
        {.unit = "mm", .limits = {0.001, 10}, .fallback = "0.05", .help = "Height of a layer."}));
}

void add_printer(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.name; }>(
        "printer", "profile", "--printer",
        {.choices = profile_words(),
         .fallback = default_profile().name,
         .help =
             "Machine profile to start from, or a back-end's name for that back-end with plain settings."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.backend; }>(
        "printer", "kind", "--printer-kind",
        {.choices = backend_words(), .help = "Back-end that makes the output."}));
}

void add_image(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.width; }>(
        "printer", "width", "--printer-width",
        {.unit = "px", .limits = {1, 65535}, .help = "Width of the display."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.height; }>(
        "printer", "height", "--printer-height",
        {.unit = "px", .limits = {1, 65535}, .help = "Height of the display."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.pixel_x; }, [](Recipe & r) -> auto& {
        return r.printer.image.pixel_y;
    }>("printer", "pixel", "--printer-pixel",
       {.unit = "mm", .limits = any_length, .help = "Edge of a square pixel; pixel_x and pixel_y in one."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.pixel_x; }>(
        "printer", "pixel_x", "--printer-pixel-x",
        {.unit = "mm", .limits = any_length, .help = "Size of a pixel along the display's width."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.pixel_y; }>(
        "printer", "pixel_y", "--printer-pixel-y",
        {.unit = "mm", .limits = any_length, .help = "Size of a pixel along the display's height."}));
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
        {.help = "Grey edges: none, by sub_rows lines a pixel row, or by exact area."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.printer.image.sub_rows; }>(
        "printer", "sub_rows", "--printer-sub-rows",
        {.limits = {1, 64}, .help = "Lines per pixel row for antialiasing = \"rows\"."}));
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
        {.unit = "mm", .limits = {0, 1000}, .help = "Empty margin round the part in vector files."}));
}

/// A number of the printer's section.
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
                                                     "Filament drawn back before a move.");
    add_machine_number<&FilamentProfile::retraction_speed>(t, "retraction_speed",
                                                           "--printer-retraction-speed", "mm/s", speed,
                                                           "Speed of drawing filament back.");
}

std::vector<Setting> make_table() {
    std::vector<Setting> table;
    add_part(table);
    add_structure(table);
    add_printer(table);
    add_image(table);
    add_vector(table);
    add_filament(table);
    for (Setting& setting : table) {
        if (setting.fallback.empty()) setting.fallback = "the profile's";
    }
    return table;
}

}  // namespace

double millimetres(LengthUnit unit) {
    switch (unit) {
        case LengthUnit::mm:
            return 1;
        case LengthUnit::cm:
            return 10;
        case LengthUnit::m:
            return 1000;
        case LengthUnit::inch:
            return 25.4;
    }
    return 1;
}

std::span<const Setting> settings() {
    static const std::vector<Setting> table = make_table();
    return table;
}

std::span<const Section> sections() {
    static const std::vector<Section> list{
        {"part", "the body: a mesh file or a shape"},
        {"foam", "Voronoi foam inside the body; without this section the part has none"},
        {"skin", "closed skin under the body's surface; without this section the part has none"},
        {"layers", "how the part is cut"},
        {"printer", "the machine: a profile, and what differs from it"}};
    return list;
}

}  // namespace lamella
