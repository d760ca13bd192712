// The rows of the settings table about the part, its gradings, foam, skin and layers.
#include "recipe/keys/settings_rows.h"
#include "recipe/recipe_kinds.h"

namespace lamella {

const std::vector<std::string>& choice_names(Shape) {
    static const std::vector<std::string> list{"none",    "sphere", "box",   "cylinder",
                                               "capsule", "torus",  "gyroid"};
    return list;
}
const std::vector<std::string>& choice_names(LengthUnit) {
    static const std::vector<std::string> list{"mm", "cm", "m", "inch"};
    return list;
}
const std::vector<std::string>& choice_names(Mirror) {
    static const std::vector<std::string> list{"none", "x", "y", "z"};
    return list;
}
const std::vector<std::string>& choice_names(FoamFrame) {
    static const std::vector<std::string> list{"part", "bed"};
    return list;
}
const std::vector<std::string>& choice_names(Falloff) {
    static const std::vector<std::string> list{"linear", "smooth", "gaussian", "inverse"};
    return list;
}

namespace {

constexpr Limits any_number{-1e9, 1e9};

void add_placement(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.fit; }>(
        "part", "fit", "--fit",
        {.unit = "mm",
         .limits = {0, 1e6},
         .fallback = "as large as it is",
         .help =
             "Box that the turned part is scaled to fit, on top of `scale`; 0 along an axis: any size."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.mirror; }>(
        "part", "mirror", "--mirror",
        {.fallback = "none", .help = "Coordinate that is negated, before the part is turned."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.lay_on; }>(
        "part", "lay_on", "--lay-on",
        {.limits = place_limits,
         .fallback = "none",
         .help = "Outward direction of the face that is laid on the bed, before the part is turned."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.lay_on_at; }>(
        "part", "lay_on_at", "--lay-on-at",
        {.unit = "mm",
         .limits = place_limits,
         .shape = {3, 1, "one point [[x, y, z]]"},
         .fallback = "none",
         .help = "A point of the face that is laid on the bed, instead of its direction."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.turn; }>(
        "part", "turn", "--turn",
        {.unit = "degrees",
         .limits = {-360, 360},
         .fallback = "0, 0, 0",
         .help = "Rotation about x, then y, then z; all that stands on the part turns with it."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.at; }>(
        "part", "at", "--at",
        {.unit = "mm",
         .limits = place_limits,
         .shape = {2, 1, "one place [[x, y]]"},
         .fallback = "0, 0",
         .help = "Place of the part's middle on the plate, from the middle of the plate."}));
}

void add_part(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.mesh; }>(
        "part", "mesh", "--mesh",
        {.fallback = "a mesh, a shape or a field must be given",
         .help = "Mesh file (.stl, .obj, .ply, .3mf); in a recipe, relative to the recipe's folder.",
         .is_path = true}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.field; }>(
        "part", "field", "--field",
        {.fallback = "the only [[field]]", .help = "Name of the [[field]] that is the body."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.shape; }>(
        "part", "shape", "--shape",
        {.fallback = "none", .help = "Body with a closed form, centred at the origin."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.radius; }>(
        "part", "radius", "--shape-radius",
        {.unit = "mm",
         .limits = extent_limits,
         .fallback = "required by sphere, cylinder, capsule, torus",
         .help = "Radius; for a torus, that of the centre line of its tube."}));
    t.push_back(
        row<[](Recipe & r) -> auto& { return r.part.size; }>("part", "size", "--shape-size",
                                                             {.unit = "mm",
                                                              .limits = extent_limits,
                                                              .fallback = "required by box, gyroid",
                                                              .help = "Edge lengths along x, y and z."}));
    t.push_back(
        row<[](Recipe & r) -> auto& { return r.part.height; }>("part", "height", "--shape-height",
                                                               {.unit = "mm",
                                                                .limits = extent_limits,
                                                                .fallback = "required by cylinder, capsule",
                                                                .help = "Height from end to end, along z."}));
    t.push_back(
        row<[](Recipe & r) -> auto& { return r.part.tube; }>("part", "tube", "--shape-tube",
                                                             {.unit = "mm",
                                                              .limits = extent_limits,
                                                              .fallback = "required by torus",
                                                              .help = "Radius of the tube of a torus."}));
    t.push_back(
        row<[](Recipe & r) -> auto& { return r.part.period; }>("part", "period", "--shape-period",
                                                               {.unit = "mm",
                                                                .limits = extent_limits,
                                                                .fallback = "required by gyroid",
                                                                .help = "Length of one gyroid cell."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.thickness; }>(
        "part", "thickness", "--shape-thickness",
        {.unit = "mm",
         .limits = length_limits,
         .fallback = "required by gyroid",
         .help = "Thickness of the gyroid's sheet."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.unit; }>(
        "part", "unit", "--unit",
        {.fallback = "mm", .help = "Length unit of a mesh file whose format states none."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.scale; }>(
        "part", "scale", "--scale",
        {.limits = {1e-6, 1e6},
         .fallback = "1",
         .help = "Scale factor of the part, applied after the unit."}));
    add_placement(t);
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.name; }>(
        "part", "name", "--name",
        {.fallback = "the input's name", .help = "Short name for file names and headers."}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.part.tool; }>(
        "part", "tool", "--tool",
        {.fallback = "the first", .help = "Name of the [[tool]] (extruder) that makes the part."}));
}

template <auto member>
void add_grading_row(std::vector<Setting>& t, const char* key, SettingSpec facts) {
    t.push_back(list_row<&Recipe::gradings, member>("grading", key, std::move(facts)));
}

void add_gradings(std::vector<Setting>& t) {
    using G = GradingRecipe;
    add_grading_row<&G::name>(
        t, "name", {.fallback = "required", .help = "Name, for formulas to use: letters, digits and _."});
    add_grading_row<&G::kind>(
        t, "kind",
        {.choices = kind_words("grading"), .fallback = "required", .help = "Source of the number."});
    add_grading_row<&G::value>(
        t, "value",
        {.limits = any_number, .fallback = "required by constant", .help = "The number everywhere."});
    add_grading_row<&G::formula>(t, "formula",
                                 {.fallback = "required by formula",
                                  .help = "Formula over x, y, z, the depth d (mm) and other gradings.",
                                  .is_formula = true});
    add_grading_row<&G::file>(
        t, "file",
        {.fallback = "required by volume, 3mf; for an attribute, part.mesh",
         .help = "Volume (.nrrd, .tif or a folder of images), PLY mesh, table (.csv) or 3MF, relative to the "
                 "recipe's folder.",
         .is_path = true});
    add_grading_row<&G::property>(t, "property",
                                  {.fallback = "3mf has a property or a function",
                                   .help = "Property of an object in a 3MF: density, modulus, ...; for a "
                                           "component of a vector, append .x, .y or .z."});
    add_grading_row<&G::function>(
        t, "function",
        {.fallback = "3mf has a property or a function",
         .help = "Number or name of a function in a 3MF; if it has several outputs, append .output."});
    add_grading_row<&G::object>(t, "object",
                                {.fallback = "the only one that has the property",
                                 .help = "Number or name of the object in a 3MF that has the property."});
    add_grading_row<&G::box>(t, "box",
                             {.unit = "mm",
                              .limits = place_limits,
                              .shape = {3, 2, "two corners [[x, y, z], [x, y, z]]"},
                              .fallback = "the file's",
                              .help = "Box that a volume's voxels fill."});
    add_grading_row<&G::channel>(
        t, "channel", {.limits = {0, 255}, .fallback = "0", .help = "Channel of a volume's images, from 0."});
    add_grading_row<&G::along>(t, "along",
                               {.fallback = "required by table",
                                .help = "Formula of the position to look up in the table: \"z\", \"d\", ...",
                                .is_formula = true});
    add_grading_row<&G::rows>(t, "rows",
                              {.limits = any_number,
                               .shape = {2, 0, "pairs [[position, number], ...]"},
                               .fallback = "a table has rows or a file",
                               .help = "Rows of a table, in order of position."});
    add_grading_row<&G::smooth>(
        t, "smooth",
        {.fallback = "false", .help = "Interpolate a table's rows smoothly instead of linearly."});
    add_grading_row<&G::attribute>(
        t, "attribute",
        {.fallback = "required by attribute",
         .help = "Property of a PLY's vertices: red, quality, ...; colours are 0 to 1."});
    add_grading_row<&G::points>(t, "points",
                                {.unit = "mm",
                                 .limits = place_limits,
                                 .shape = {3, 0, "points [[x, y, z], ...]"},
                                 .fallback = "attractors have points or segments",
                                 .help = "Points that attract."});
    add_grading_row<&G::segments>(t, "segments",
                                  {.unit = "mm",
                                   .limits = place_limits,
                                   .shape = {6, 0, "segments [[[x, y, z], [x, y, z]], ...]"},
                                   .fallback = "attractors have points or segments",
                                   .help = "Straight segments that attract."});
    add_grading_row<&G::near_value>(
        t, "near",
        {.limits = any_number, .fallback = "required by attractors", .help = "The number at an attractor."});
    add_grading_row<&G::far_value>(t, "far",
                                   {.limits = any_number,
                                    .fallback = "required by attractors",
                                    .help = "The number beyond the radius."});
    add_grading_row<&G::radius>(t, "radius",
                                {.unit = "mm",
                                 .limits = extent_limits,
                                 .fallback = "required by attractors",
                                 .help = "Distance over which the number changes."});
    add_grading_row<&G::falloff>(t, "falloff",
                                 {.fallback = "smooth", .help = "Shape of the transition from near to far."});
    add_grading_row<&G::at>(t, "at",
                            {.unit = "mm",
                             .limits = place_limits,
                             .fallback = "required by point, plane",
                             .help = "The point, or a point of the plane."});
    add_grading_row<&G::a>(t, "a",
                           {.unit = "mm",
                            .limits = place_limits,
                            .fallback = "required by line",
                            .help = "One end of the line."});
    add_grading_row<&G::b>(t, "b",
                           {.unit = "mm",
                            .limits = place_limits,
                            .fallback = "required by line",
                            .help = "The other end of the line."});
    add_grading_row<&G::normal>(t, "normal",
                                {.limits = place_limits,
                                 .fallback = "required by plane",
                                 .help = "Direction in which the distance from a plane is positive."});
}

template <auto member>
void add_foam_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    t.push_back(optional_row<&Recipe::foam, member>("foam", key, flag, std::move(facts)));
}

constexpr Limits cells{0.05, 1000};
constexpr Limits beams{0.005, 500};
constexpr Limits walls{0.01, 500};

void add_foam(std::vector<Setting>& t) {
    using F = FoamRecipe;
    add_foam_row<&F::kind>(t, "kind", "--foam",
                           {.choices = kind_words("foam"),
                            .fallback = FoamRecipe{}.kind,
                            .help = "Kind of foam that fills the body."});
    add_foam_row<&F::cell>(t, "cell", "--cell",
                           {.unit = "mm",
                            .limits = cells,
                            .fallback = "required in [foam]",
                            .help = "Mean diameter of a cell: one seed per cubed diameter; for periodic "
                                    "foams, the side or period of a cell."});
    add_foam_row<&F::beam>(t, "beam", "--beam",
                           {.unit = "mm",
                            .limits = beams,
                            .fallback = "required in [foam]",
                            .help = "Radius of the foam's beams."});
    const auto bound = [&]<auto member>(const char* key, const char* flag, Limits limits, double fallback,
                                        const char* help) {
        add_foam_row<member>(
            t, key, flag, {.unit = "mm", .limits = limits, .fallback = format_value(fallback), .help = help});
    };
    bound.operator()<&F::cell_min>("cell_min", "--cell-min", cells, cells.lo,
                                   "Smallest cell: graded cells are clamped to it.");
    bound.operator()<&F::cell_max>("cell_max", "--cell-max", cells, cells.hi,
                                   "Largest cell: graded cells are clamped to it.");
    bound.operator()<&F::beam_min>("beam_min", "--beam-min", beams, beams.lo,
                                   "Smallest radius: graded beams are clamped to it.");
    bound.operator()<&F::beam_max>("beam_max", "--beam-max", beams, beams.hi,
                                   "Largest radius: graded beams are clamped to it.");
    add_foam_row<&F::wall>(t, "wall", "--wall",
                           {.unit = "mm",
                            .limits = walls,
                            .fallback = "required by periodic surfaces, closed",
                            .help = "Minimum thickness of the walls, or of a network's struts."});
    bound.operator()<&F::wall_min>("wall_min", "--wall-min", walls, walls.lo,
                                   "Smallest thickness: graded walls are clamped to it.");
    bound.operator()<&F::wall_max>("wall_max", "--wall-max", walls, walls.hi,
                                   "Largest thickness: graded walls are clamped to it.");
    add_foam_row<&F::window>(t, "window", "--window",
                             {.limits = {0, 1},
                              .fallback = "0",
                              .help = "Open share of a closed foam's walls: 0 is closed, 1 has no walls."});
    add_foam_row<&F::network>(
        t, "network", "--network",
        {.fallback = "false",
         .help = "Make struts on one side of a periodic surface instead of a wall along it."});
    add_foam_row<&F::unit_cell>(t, "unit_cell", "--unit-cell",
                                {.choices = {"cubic", "bcc", "fcc", "octet"},
                                 .fallback = "a lattice has unit_cell or struts",
                                 .help = "Unit cell of a lattice, by name."});
    add_foam_row<&F::struts>(t, "struts", "--struts",
                             {.limits = {0, 1},
                              .shape = {6, 0, "struts [[[x, y, z], [x, y, z]], ...]"},
                              .fallback = "a lattice has unit_cell or struts",
                              .help = "Unit cell of a lattice, as struts with their ends in the unit cube."});
    add_foam_row<&F::seed>(t, "seed", "--seed",
                           {.limits = {0, 9223372036854775807.0},
                            .fallback = "1",
                            .help = "Seed of the random numbers: each gives a different foam."});
    add_foam_row<&F::jitter>(
        t, "jitter", "--jitter",
        {.limits = {0, 1},
         .fallback = format_value(F{}.jitter),
         .help = "Disorder of a Kelvin foam: displacement of seeds as a share of their spacing."});
    add_foam_row<&F::neighbours>(
        t, "neighbours", "--neighbours",
        {.limits = {1, 26},
         .fallback = format_value(F{}.neighbours),
         .help = "Number of nearest seeds to which each seed has a beam (k-nearest)."});
    add_foam_row<&F::stretch>(t, "stretch", "--stretch",
                              {.limits = {0.05, 20},
                               .fallback = "1, 1, 1",
                               .help = "Stretch factors of the cells along x, y and z, or along these axes "
                                       "rotated by turn; formulas only for k-nearest."});
    add_foam_row<&F::turn>(
        t, "turn", "--foam-turn",
        {.unit = "degrees",
         .limits = {-360, 360},
         .fallback = "0, 0, 0",
         .help = "Rotation of the axes of stretch about x, then y, then z; formulas only for k-nearest."});
    add_foam_row<&F::frame>(
        t, "frame", "--foam-frame",
        {.fallback = "part",
         .help = "Whether the foam stays fixed to the part or to the bed when the part is "
                 "turned."});
    add_foam_row<&F::tool>(
        t, "tool", "--foam-tool",
        {.fallback = "that of the part", .help = "Name of the [[tool]] (extruder) that makes the foam."});
    add_foam_row<&F::drop_islands>(
        t, "drop_islands", "--drop-islands",
        {.fallback = "false",
         .help = "Remove pieces that are not connected to the part (needs an extra pass over the layers)."});
    add_foam_row<&F::islands_pitch>(
        t, "islands_pitch", "--islands-pitch",
        {.unit = "mm",
         .limits = {0.001, 100},
         .fallback = "a third of the thinnest beam's radius, at most 16 layers",
         .help = "Row spacing of the survey for loose pieces; gaps below two rows count as connected."});
    add_stiffness_settings(t);
}

void add_output(std::vector<Setting>& t) {
    t.push_back(row<[](Recipe & r) -> auto& { return r.output.beams; }>(
        "output", "beams", "--output-beams",
        {.fallback = "none",
         .help = "File for the foam's beams as a 3MF beam lattice, written by `slice`; in a recipe, relative "
                 "to the recipe's folder.",
         .is_path = true}));
    t.push_back(row<[](Recipe & r) -> auto& { return r.output.beams_box; }>(
        "output", "beams_box", "--output-beams-box",
        {.unit = "mm",
         .limits = place_limits,
         .shape = {3, 2, "two corners [[x, y, z], [x, y, z]]"},
         .fallback = "the part's bounds",
         .help = "Box of beams to write: all beams that touch it, uncut."}));
}

std::vector<Setting> make_table() {
    std::vector<Setting> table;
    add_part(table);
    add_field_settings(table);
    add_gradings(table);
    add_foam(table);
    add_material_settings(table);
    add_frame_settings(table);
    add_skin_settings(table);
    add_region_settings(table);
    add_load_settings(table);
    add_anchor_settings(table);
    add_optimize_settings(table);
    add_element_settings(table);
    add_elements_settings(table);
    add_cavity_settings(table);
    add_layers_settings(table);
    add_process_settings(table);
    add_repair_settings(table);
    add_support_settings(table);
    add_shield_settings(table);
    add_check_settings(table);
    add_cut_settings(table);
    add_plate_settings(table);
    add_tool_settings(table);
    add_purge_settings(table);
    add_output(table);
    add_printer_settings(table);
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

Box box_of(const NumberRows& corners) {
    const auto corner = [&](std::size_t i) { return dvec3(corners[i][0], corners[i][1], corners[i][2]); };
    return {corner(0), corner(1)};
}

std::optional<dvec3> constant(const GradedTriple& triple) {
    dvec3 numbers{0};
    for (std::size_t i = 0; i < triple.size(); ++i) {
        if (triple[i].is_formula()) return std::nullopt;
        numbers[static_cast<glm::length_t>(i)] = triple[i].number();
    }
    return numbers;
}

std::span<const Setting> settings() {
    static const std::vector<Setting> table = make_table();
    return table;
}

std::span<const Section> sections() {
    static const std::vector<Section> list{
        {"part", "the body: a mesh file, a shape or a field"},
        {"field", "a named solid, for the part or a region", [](const Recipe& r) { return r.fields.size(); }},
        {"grading", "a number that varies in space, for formulas to use by its name",
         [](const Recipe& r) { return r.gradings.size(); }},
        {"foam", "foam inside the body; without this section the part has none"},
        {"material", "the part's material, for predicting its stiffness"},
        {"frame", "beams along the surface in which the foam ends; without this section there are none"},
        {"skin",
         "skin at the body's surface, closed or with windows; without this section the part has none"},
        {"hole", "a hole drilled through the skin", [](const Recipe& r) { return r.holes.size(); }},
        {"region", "a part of the body with other content or numbers; later ones win",
         [](const Recipe& r) { return r.regions.size(); }},
        {"load", "a force or pressure on a place of the body; a place is a field, a box, a plane or a face",
         [](const Recipe& r) { return r.loads.size(); }},
        {"anchor", "a place of the body that is held; a place is a field, a box, a plane or a face",
         [](const Recipe& r) { return r.anchors.size(); }},
        {"optimize",
         "the best shape within the part, or its best foam, under the loads; without this section the part "
         "stays as it is"},
        {"element", "a shape of which the part is built, with [elements]",
         [](const Recipe& r) { return r.element_shapes.size(); }},
        {"elements",
         "the part built of copies of shapes that bear the loads together; without this section it is not"},
        {"cavity",
         "cavities inside the part whose roofs print without supports; without this section there are none"},
        {"layers", "how the part is cut into layers"},
        {"process", "machine compensation: scale and offsets"},
        {"repair", "repairs before printing; without this section, only self-supporting skins are trimmed"},
        {"support", "supports under overhangs; without this section there are none"},
        {"shield", "a wall around the print, removed later; without this section there is none"},
        {"check", "limits of the machine and severity of faults, for `check` and `slice --check`", nullptr,
         false},
        {"cut", "a plane that cuts the part into pieces, which are printed side by side",
         [](const Recipe& r) { return r.cuts.size(); }},
        {"plate", "copies of the part printed together"},
        {"tool", "one of several tools (extruders) of a machine that prints filament, from T0 on",
         [](const Recipe& r) { return r.printer.tools.size(); }},
        {"purge", "the tower in which the nozzle is purged after a change of tools"},
        {"output", "outputs other than layers", nullptr, false},
        {"printer", "the machine: a profile, and changes to it"},
        {"host", "where the machine is on the network, for `send`", nullptr, false}};
    return list;
}

}  // namespace lamella
