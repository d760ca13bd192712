// Recipe: everything that decides a print, as plain data. The settings table (settings.h) lists the accepted
// values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/field/field.h"
#include "engine/field/grading.h"
#include "engine/solids/shell.h"
#include "printers/common/profile.h"
#include "procedural/grading/attractors.h"
#include "procedural/pattern/reinforcement.h"
#include "recipe/elements_recipe.h"
#include "recipe/graded_number.h"
#include "recipe/number_rows.h"
#include "recipe/optimize_recipe.h"
#include "recipe/pieces/cut_recipe.h"

namespace lamella {

/// A body with a closed form, centred at the origin. `none`: the body is a mesh or a [[field]].
enum class Shape : unsigned char { none, sphere, box, cylinder, capsule, torus, gyroid };

/// The length unit of mesh files whose format states none.
enum class LengthUnit : unsigned char { mm, cm, m, inch };

/// The coordinate of the part that a mirror negates.
enum class Mirror : unsigned char { no, x, y, z };

struct PartRecipe {
    std::string mesh;   ///< path of the mesh file; empty when the body is something else
    std::string field;  ///< name of a [[field]]; empty when the body is something else
    Shape shape = Shape::none;
    double radius = 0;     ///< sphere, cylinder, capsule; torus: of its centre circle, mm
    dvec3 size{0};         ///< box and gyroid, mm
    double height = 0;     ///< cylinder and capsule, end to end, mm
    double tube = 0;       ///< torus, radius of the tube, mm
    double period = 0;     ///< gyroid, mm
    double thickness = 0;  ///< gyroid, of the sheet, mm
    LengthUnit unit = LengthUnit::mm;
    double scale = 1;
    dvec3 fit{0};                ///< box that the part is scaled to fit once it is turned, mm; 0: any size
    Mirror mirror = Mirror::no;  ///< before anything turns
    dvec3 lay_on{0};             ///< outward direction of the face that is laid on the bed; 0: none
    NumberRows lay_on_at;        ///< a point of that face instead, mm; empty: none
    dvec3 turn{0};               ///< rotation about x, then y, then z, degrees, after laying it on a face
    NumberRows at;               ///< x and y of its middle from the middle of the plate, mm; empty: 0, 0
    std::string name;            ///< empty: taken from the input
    std::string tool;            ///< name of a [[tool]]; empty: the first
};

/// An object that an embedding program puts into a recipe. Empty when it gives none.
template <typename Pointer>
struct HostGiven {
    Pointer pointer{};
    std::string identity;  ///< identifies it, like the bytes of a file
};

/// A named solid, for the part and regions: a shape, a mesh, the inside (below zero) of a formula, a program
/// for libfive's virtual machine, or a field of the host.
struct FieldRecipe {
    std::string where;  ///< where the entry begins, for messages
    std::string name;
    std::string kind = "formula";  ///< a word of the registered kinds
    GradedNumber formula;          ///< over x, y, z, mm
    std::string file;              ///< .vm, a mesh, or a volumetric 3MF
    std::string object;            ///< 3mf: number or name of the object; empty: all built objects
    std::string function;          ///< 3mf: number or name of the function instead, perhaps .output
    NumberRows bounds;             ///< two corners, mm; empty: found by search
    dvec3 at{0};                   ///< centre of a shape, position of the origin of other kinds, mm
    dvec3 turn{0};                 ///< rotation about x, then y, then z, degrees
    double radius = 0;             ///< sizes of shapes, as in PartRecipe, mm
    dvec3 size{0};
    double height = 0;
    double tube = 0;
    LengthUnit unit = LengthUnit::mm;  ///< mesh
    double scale = 1;                  ///< mesh
    HostGiven<FieldPtr> host;
};

/// The content of a region: solid, empty, or the part's foam or skin with other numbers. `blocker` keeps
/// supports away; `enforcer` supports every overhang; `tool` changes the tool alone, `layers` the heights of
/// layers.
enum class RegionMake : unsigned char { solid, empty, foam, skin, blocker, enforcer, tool, layers };

/// A part of the body with other content. Among regions with the same content, later ones win.
struct RegionRecipe {
    std::string where;  ///< where the entry begins, for messages
    std::string field;  ///< name of a [[field]]
    RegionMake make = RegionMake::solid;
    double blend = 0;  ///< width of the transition to its surroundings, mm
    /// Numbers that replace the foam's; 0 (window: below 0) keeps the foam's.
    GradedNumber cell;
    GradedNumber beam;
    GradedNumber wall;
    GradedNumber window{-1.0, ""};
    GradedNumber modulus;
    GradedNumber thickness;   ///< replaces the skin's thickness
    std::string tool;         ///< name of a [[tool]] that makes what is in the region; empty: as around it
    double layer_height = 0;  ///< of the layers that begin at the region's heights, mm; 0: as around it
};

/// A grading: a number that varies in space, which formulas use by its name.
struct GradingRecipe {
    std::string where;  ///< where the entry begins, for messages
    std::string name;
    std::string kind;          ///< a word of the registered kinds
    double value = 0;          ///< constant
    GradedNumber formula;      ///< formula, over x, y, z, d and gradings
    std::string file;          ///< volume, table, attribute, 3mf
    std::string property;      ///< 3mf: name of the property, perhaps .x
    std::string function;      ///< 3mf: number or name of the function instead, perhaps .output
    std::string object;        ///< 3mf: number or name of the object with the property; empty: the only one
    NumberRows box;            ///< volume: two corners, mm; empty: the file says
    std::int64_t channel = 0;  ///< volume: of an image
    GradedNumber along;        ///< table: formula of the position to look up
    NumberRows rows;           ///< table: rows of position and number
    bool smooth = false;       ///< table
    std::string attribute;     ///< attribute: name of a vertex property
    NumberRows points;         ///< attractors, mm
    NumberRows segments;       ///< attractors: six numbers each, mm
    double near_value = 0;     ///< attractors: the number at the attractors
    double far_value = 0;      ///< attractors: the number beyond their reach
    double radius = 0;         ///< attractors: their reach, mm
    Falloff falloff = Falloff::smooth;
    dvec3 at{0};      ///< point and plane, mm
    dvec3 a{0};       ///< line: one end, mm
    dvec3 b{0};       ///< line: the other end, mm
    dvec3 normal{0};  ///< plane
    HostGiven<GradingPtr> host;
};

/// What a foam stays fixed to when the part is turned.
enum class FoamFrame : unsigned char { part, bed };

struct FoamRecipe {
    std::string kind = "voronoi";  ///< a word of the registered kinds
    FoamFrame frame = FoamFrame::part;
    GradedNumber cell;       ///< mean cell diameter, mm
    GradedNumber beam;       ///< radius of the beams, mm
    double cell_min = 0.05;  ///< the printable range of graded cells and beams, mm
    double cell_max = 1000;
    double beam_min = 0.005;
    double beam_max = 500;
    GradedNumber wall;    ///< thickness of walls or of a network's struts, mm
    GradedNumber window;  ///< closed: open share of the walls, 0 to 1
    double wall_min = 0.01;
    double wall_max = 500;
    bool network = false;         ///< struts on one side of a periodic surface instead of a wall along it
    std::int64_t seed = 1;        ///< of the random numbers
    double jitter = 0.05;         ///< kelvin: displacement of seeds as a share of their spacing
    std::int64_t neighbours = 5;  ///< k-nearest: approximate number of beams per seed
    /// Stretch factors of cells along three perpendicular axes; formulas for k-nearest only.
    GradedTriple stretch{GradedNumber{1.0, ""}, GradedNumber{1.0, ""}, GradedNumber{1.0, ""}};
    GradedTriple turn{};    ///< rotation of these axes about x, then y, then z, degrees
    std::string unit_cell;  ///< lattice: the name of a cell
    NumberRows struts;      ///< lattice: ends in the unit cube, six numbers each
    GradedNumber modulus;   ///< Young's modulus, MPa, from which cells or members follow; 0: none
    std::string law;        ///< path of a file of foam laws; empty: the built-in laws
    std::string tool;       ///< name of a [[tool]]; empty: that of the part
    bool drop_islands = false;
    double islands_pitch = 0;  ///< row spacing of the island survey, mm; 0: derived from the foam
};

/// The part's material.
struct MaterialRecipe {
    std::string name;     ///< name of a material in a table; empty when numbers describe it
    std::string table;    ///< path of a table of materials; empty: the built-in ones
    double young = 0;     ///< Young's modulus, MPa; 0: the table's
    double poisson = -1;  ///< Poisson's ratio; -1: the table's
    double density = 0;   ///< g/cm^3; 0: the table's
    std::string tests;    ///< path of compression tests that the foam's law is fitted to; empty: none
};

/// Beams where the foam's Voronoi faces meet the surface.
struct FrameRecipe {
    GradedNumber beam;        ///< radius, mm
    double beam_min = 0.005;  ///< the printable range of a graded radius, mm
    double beam_max = 500;
    bool interior = true;  ///< whether the foam inside is made, too
};

struct SkinRecipe {
    GradedNumber thickness;    ///< mm
    double thickness_min = 0;  ///< the range of a graded thickness, mm
    double thickness_max = 1000;
    SkinSide side = SkinSide::inside;  ///< of the body's surface
    std::string pattern = "closed";    ///< a word of the registered kinds
    double window = 0;                 ///< mean width of a window, mm
    GradedNumber strut;                ///< minimum width of the struts between windows, mm
    double corner = -1;                ///< radius of the windows' corners, mm; negative: half the strut
    std::int64_t seed = 1;             ///< voronoi: of the random numbers
    std::string image;                 ///< path of a picture
    GradedNumber image_size;           ///< image: length that its width covers, mm
    std::string second_image;          ///< by-example: path of a picture that the pattern changes into
    GradedNumber second_weight;        ///< how much it looks like that one, 0 to 1
    double threshold =
        -1;               ///< grey, 0 to 1, below which a picture is solid; negative: 0.5, by-example Otsu's
    bool invert = false;  ///< image: solid where it is bright
    double gap = 0;       ///< by-example: least width of gaps, mm; 0: any
    Reinforcement reinforce = Reinforcement::shape;  ///< by-example: how bridges are chosen
    bool self_supporting = false;                    ///< by-example: struts below what would begin in the air
    dvec3 direction{0};       ///< by-example: where the picture's top points; 0: smooth by itself
    std::int64_t drains = 0;  ///< holes per closed cavity: at its lowest point, and with 2 also at its
                              ///< highest
    double drain_radius = 0;  ///< mm; 0: derived from the skin
    double drain_pitch = 0;   ///< row spacing of the cavity survey, mm; 0: derived from the skin
    std::string tool;         ///< name of a [[tool]]; empty: that of the part
};

/// Cavities whose roofs print without supports.
struct CavityRecipe {
    double wall = 0;      ///< minimum wall around a cavity, mm
    double overhang = 0;  ///< of a layer of its roof over the one below, mm; 0: the printer's
    double chamber = 0;   ///< width of the chambers into which it is divided, mm; 0: undivided
    double least = 10;    ///< minimum volume of a cavity, mm^3
    double pitch = 0;     ///< row spacing of the survey, mm; 0: derived from the overhang
};

/// A thin wall around the print (draught or ooze shield).
struct ShieldRecipe {
    double gap = 0;       ///< minimum distance from the print in each layer, mm
    double wall = 0.9;    ///< its thickness, mm
    double overhang = 0;  ///< maximum shift of its outline between layers, mm; 0: the printer's
    double pitch = 0;     ///< row spacing of the survey, mm; 0: derived from the overhang
};

/// Machine compensation: scaling and in-plane offsets.
struct ProcessRecipe {
    dvec3 scale{1};  ///< of the finished part along x, y, z: about the middle of its bounds in x and y, and
                     ///< their lowest z
    double xy_compensation = 0;             ///< outward offset of every layer's outline, mm; negative: inward
    double elephant_foot = 0;               ///< inward offset of the first layer's outline, mm
    std::int64_t elephant_foot_layers = 1;  ///< number of layers over which that offset fades away
};

/// Repairs before a part is printed. Lengths in mm as printed; 0: no repair of this kind.
struct RepairRecipe {
    double thickness = 0;  ///< walls thinner than this within a layer are thickened to it
    double gap = 0;        ///< gaps narrower than this within a layer are filled
    double join = 0;       ///< diameter of struts that join disconnected pieces
    double trim = -1;      ///< tips that begin in the air are removed if no higher than this; negative: usual
    double hold = -1;      ///< diameter of struts below the tips that stay; negative: usual
};

/// The kind of supports; their dimensions are part of the printer's profile.
enum class SupportKind : unsigned char {
    none,
    bridges,  ///< horizontal bars on pillars
    pillars   ///< a pillar under every support point
};

/// Tools (extruders) that make supports: names of [[tool]] entries.
struct SupportToolsRecipe {
    std::string tool;            ///< empty: that of the part
    std::string interface_tool;  ///< of supports near the part; empty: as `tool`
    double interface = 1;        ///< distance from the part within which supports are near, mm
};

/// A hole drilled through the skin.
struct HoleRecipe {
    std::string where;     ///< where the entry begins, for messages
    dvec3 at{0};           ///< mm; the hole begins at the nearest point of the surface
    double radius = 0;     ///< mm
    dvec3 direction{0};    ///< inward; zero: along the surface normal
    double depth = 0;      ///< from the surface, mm; 0: through the skin
    bool through = false;  ///< the hole also passes through the foam
};

/// How the print is cut into layers.
struct LayersRecipe {
    double height = 0.05;  ///< mm
    double first = 0;      ///< height of the first layer, mm; 0: as the others
    NumberRows heights;  ///< rows of a height over the bed and of the layers' from there on, mm; empty: none
    double cusp = 0;     ///< largest distance between steps and surface, mm; 0: layers do not adapt to it
    double least = 0;    ///< height of adapted layers at least, mm; 0: half of `height`
    double most = 0;     ///< and at most, mm; 0: one and a half times `height`
};

/// Copies of the part on one plate.
struct PlateRecipe {
    int copies = 1;
    double gap = 5;           ///< distance between neighbours, mm
    bool turn = false;        ///< whether parts may be turned by right angles
    int number = 1;           ///< the plate to make, where one is not enough
    bool one_by_one = false;  ///< whether each part is printed from the bed up before the next
    int piece = 0;            ///< the one to make of a part that is cut, from 1; 0: all
};

/// Outputs other than layers.
struct OutputRecipe {
    std::string beams;     ///< path of a 3MF beam lattice; empty for none
    NumberRows beams_box;  ///< two corners, mm; empty: the part's bounds
};

/// A whole recipe. Without foam and skin the part is solid; with foam alone it is bare foam cut by the body;
/// with a skin alone it is a hollow shell.
struct Recipe {
    PartRecipe part;
    std::vector<FieldRecipe> fields;
    std::vector<GradingRecipe> gradings;
    std::vector<RegionRecipe> regions;
    std::vector<LoadRecipe> loads;
    std::vector<AnchorRecipe> anchors;
    std::optional<OptimizeRecipe> optimize;
    std::vector<ElementRecipe> element_shapes;
    std::optional<ElementsRecipe> elements;
    std::optional<FoamRecipe> foam;
    std::optional<MaterialRecipe> material;
    std::optional<FrameRecipe> frame;
    std::optional<SkinRecipe> skin;
    std::optional<CavityRecipe> cavity;
    std::optional<ShieldRecipe> shield;
    std::optional<ProcessRecipe> process;
    std::optional<RepairRecipe> repair;
    std::vector<HoleRecipe> holes;
    std::vector<CutRecipe> cuts;
    SupportKind support = SupportKind::none;
    SupportToolsRecipe support_tools;
    LayersRecipe layers;
    PlateRecipe plate;
    OutputRecipe output;
    PrinterProfile printer;
    std::string machine;  ///< name of the profile that [printer] names; empty: the default
};

/// Returns the length of one unit, mm.
double millimetres(LengthUnit unit);

}  // namespace lamella
