// Recipe: everything that decides a print, as plain data. The settings table (settings.h) says what is
// allowed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/field/field.h"
#include "engine/field/grading.h"
#include "engine/solids/shell.h"
#include "printers/common/profile.h"
#include "procedural/grading/attractors.h"

namespace lamella {

/// A body with a closed form, centred at the origin. `none`: the body is a mesh or a [[field]].
enum class Shape : unsigned char { none, sphere, box, cylinder, capsule, torus, gyroid };

/// What one unit of a mesh file is, for formats that do not say.
enum class LengthUnit : unsigned char { mm, cm, m, inch };

/// A number, or a formula that gives one at every point.
struct GradedNumber {
    std::variant<double, std::string> value{0.0};
    std::string where;  ///< where it stands, for messages: "foam.toml:7: foam.cell" or "--cell"

    bool is_formula() const { return value.index() == 1; }
    /// The number; only where it is no formula.
    double number() const { return std::get<double>(value); }
    const std::string& formula() const { return std::get<std::string>(value); }
    /// Two are equal that ask for the same, wherever they stand.
    friend bool operator==(const GradedNumber& a, const GradedNumber& b) { return a.value == b.value; }
};

/// Three numbers, each of which may be a formula.
using GradedTriple = std::array<GradedNumber, 3>;

/// The numbers of a triple; nothing when one is a formula.
std::optional<dvec3> constant(const GradedTriple& triple);

/// Rows of numbers, all of one length: points, corners, ends of segments, rows of a table.
using NumberRows = std::vector<std::vector<double>>;

/// The box between two corners, mm; empty where the first is not the lower one.
Box box_of(const NumberRows& corners);

struct PartRecipe {
    std::string mesh;   ///< path of the mesh file; empty when the body is something else
    std::string field;  ///< name of a [[field]]; empty when the body is something else
    Shape shape = Shape::none;
    double radius = 0;     ///< sphere, cylinder, capsule; of the torus its centre circle, mm
    dvec3 size{0};         ///< box and gyroid, mm
    double height = 0;     ///< cylinder and capsule, end to end, mm
    double tube = 0;       ///< torus, radius of the tube, mm
    double period = 0;     ///< gyroid, mm
    double thickness = 0;  ///< gyroid, of the sheet, mm
    LengthUnit unit = LengthUnit::mm;
    double scale = 1;
    std::string name;  ///< empty: taken from the input
};

/// What a program that embeds the engine puts into a recipe. Empty where it puts nothing.
template <typename Pointer>
struct HostGiven {
    Pointer pointer{};
    std::string identity;  ///< tells it from others, as a file's bytes do
};

/// A solid by name, for the part and regions: a shape, a mesh, the inside (below zero) of a formula, of a
/// program for libfive's virtual machine, or of what the host gives.
struct FieldRecipe {
    std::string where;  ///< where the entry begins, for messages
    std::string name;
    std::string kind = "formula";  ///< a word of the registered kinds
    GradedNumber formula;          ///< over x, y, z, mm
    std::string file;              ///< .vm, a mesh, or a volumetric 3MF
    std::string object;            ///< 3mf: number or name of the object; empty: all that is built
    std::string function;          ///< 3mf: number or name of the function instead, perhaps .output
    NumberRows bounds;             ///< two corners, mm; empty: found by search
    dvec3 at{0};                   ///< of shapes the centre, of others the place of their origin, mm
    dvec3 turn{0};                 ///< about x, then y, then z, degrees
    double radius = 0;             ///< sizes of shapes, as of the part, mm
    dvec3 size{0};
    double height = 0;
    double tube = 0;
    LengthUnit unit = LengthUnit::mm;  ///< mesh
    double scale = 1;                  ///< mesh
    HostGiven<FieldPtr> host;
};

/// What a region is made of: solid, nothing, or the part's foam or skin with other numbers; or where supports
/// are kept away, or put wherever anything stands out.
enum class RegionMake : unsigned char { solid, empty, foam, skin, blocker, enforcer };

/// A part of the body that is made otherwise; of regions that make the same thing, later ones win.
struct RegionRecipe {
    std::string where;  ///< where the entry begins, for messages
    std::string field;  ///< name of a [[field]]
    RegionMake make = RegionMake::solid;
    double blend = 0;  ///< width over which it passes into what is about it, mm
    /// Numbers that hold instead of the foam's; 0 (window: below 0) where the foam's hold.
    GradedNumber cell;
    GradedNumber beam;
    GradedNumber wall;
    GradedNumber window{-1.0, ""};
    GradedNumber modulus;
    GradedNumber thickness;  ///< instead of the skin's
};

/// A number that varies in space, for formulas to use by its name.
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
    GradedNumber along;        ///< table: the formula that the table is looked up with
    NumberRows rows;           ///< table: position and number
    bool smooth = false;       ///< table
    std::string attribute;     ///< attribute: name of the vertices' property
    NumberRows points;         ///< attractors, mm
    NumberRows segments;       ///< attractors: six numbers each, mm
    double near_value = 0;     ///< attractors: the number at them
    double far_value = 0;      ///< attractors: the number beyond their reach
    double radius = 0;         ///< attractors: their reach, mm
    Falloff falloff = Falloff::smooth;
    dvec3 at{0};      ///< point and plane, mm
    dvec3 a{0};       ///< line: one end, mm
    dvec3 b{0};       ///< line: the other end, mm
    dvec3 normal{0};  ///< plane
    HostGiven<GradingPtr> host;
};

struct FoamRecipe {
    std::string kind = "voronoi";  ///< a word of the registered kinds
    GradedNumber cell;             ///< mean cell diameter, mm
    GradedNumber beam;             ///< radius of the beams, mm
    double cell_min = 0.05;        ///< the printable range of graded cells and beams, mm
    double cell_max = 1000;
    double beam_min = 0.005;
    double beam_max = 500;
    GradedNumber wall;    ///< thickness of walls, of a network's struts, mm
    GradedNumber window;  ///< closed: share of the walls that is open, 0 to 1
    double wall_min = 0.01;
    double wall_max = 500;
    bool network = false;         ///< struts along one side of a periodic surface instead of a wall on it
    std::int64_t seed = 1;        ///< of the random draws
    double jitter = 0.05;         ///< kelvin: share of the spacing by which seeds are moved
    std::int64_t neighbours = 5;  ///< k-nearest: beams of each seed, about
    /// Factors on the cells along three axes at right angles; formulas for k-nearest alone.
    GradedTriple stretch{GradedNumber{1.0, ""}, GradedNumber{1.0, ""}, GradedNumber{1.0, ""}};
    GradedTriple turn{};    ///< of these axes about x, then y, then z, degrees
    std::string unit_cell;  ///< lattice: the name of a cell
    NumberRows struts;      ///< lattice: ends in the unit cube, six numbers each
    GradedNumber modulus;   ///< Young's modulus, MPa, that cells or members are chosen for; 0: none
    std::string law;        ///< path of laws of foams; empty: those that ship
    bool drop_islands = false;
    double islands_pitch = 0;  ///< of the survey for them, mm; 0: what suits the foam
};

/// What the part is made of.
struct MaterialRecipe {
    std::string name;     ///< of a table's material; empty where numbers say it all
    std::string table;    ///< path of materials; empty: those that ship
    double young = 0;     ///< Young's modulus, MPa; 0: the table's
    double poisson = -1;  ///< Poisson's ratio; -1: the table's
    double density = 0;   ///< g/cm^3; 0: the table's
    std::string tests;    ///< path of compression tests of foams that the law is fitted to; empty: none
};

/// Beams where the foam's Voronoi faces meet the surface.
struct FrameRecipe {
    GradedNumber beam;        ///< radius, mm
    double beam_min = 0.005;  ///< the printable range of a graded radius, mm
    double beam_max = 500;
    bool interior = true;  ///< whether the foam itself is made, too
};

struct SkinRecipe {
    GradedNumber thickness;    ///< mm
    double thickness_min = 0;  ///< the range of a graded thickness, mm
    double thickness_max = 1000;
    SkinSide side = SkinSide::inside;  ///< of the body's surface
    std::string pattern = "closed";    ///< a word of the registered kinds
    double window = 0;                 ///< mean width of a window, mm
    GradedNumber strut;                ///< width of what is left between windows, at least, mm
    double corner = -1;                ///< radius of the windows' corners, mm; negative: half the strut
    std::int64_t seed = 1;             ///< voronoi: of the random draws
    std::string image;                 ///< path of a picture
    double image_size = 0;             ///< image: what its width covers, mm
    double threshold = 0.5;            ///< image: grey, 0 to 1, below which it is solid
    bool invert = false;               ///< image: solid where it is bright
    std::int64_t drains = 0;  ///< holes of each closed cavity: at its lowest point, and at its highest
    double drain_radius = 0;  ///< mm; 0: what the skin suggests
    double drain_pitch = 0;   ///< of the survey for cavities, mm; 0: what suits the skin
};

/// Cavities whose roofs print without supports.
struct CavityRecipe {
    double wall = 0;      ///< about a cavity, at least, mm
    double overhang = 0;  ///< of a layer of its roof over the one below, mm; 0: the printer's
    double chamber = 0;   ///< width of the chambers that it is divided into, mm; 0: undivided
    double least = 10;    ///< volume of a cavity, mm^3
    double pitch = 0;     ///< of the survey, mm; 0: what suits the overhang
};

/// A wall close about the print.
struct ShieldRecipe {
    double gap = 0;       ///< to the print in each layer, at least, mm
    double wall = 0.9;    ///< its thickness, mm
    double overhang = 0;  ///< by which its outline may move from layer to layer, mm; 0: the printer's
    double pitch = 0;     ///< of the survey, mm; 0: what suits the overhang
};

/// What makes up for the way a machine prints.
struct ProcessRecipe {
    dvec3 scale{1};  ///< of the finished part along x, y, z: about its middle, from its lowest point
    double xy_compensation = 0;             ///< by which every layer's outline grows, mm; negative: shrinks
    double elephant_foot = 0;               ///< by which the first layer's outline is drawn in, mm
    std::int64_t elephant_foot_layers = 1;  ///< over which that fades away
};

/// What is mended before a part is printed. Lengths in mm as printed; 0: left as it is.
struct RepairRecipe {
    double thickness = 0;  ///< what is thinner within a layer is made so thick
    double gap = 0;        ///< void narrower within a layer is filled
    double join = 0;       ///< diameter of the struts that join loose pieces
};

/// What holds the part up while it is printed; its numbers are the printer's.
enum class SupportKind : unsigned char {
    none,
    bridges,  ///< bars on pillars
    pillars   ///< a pillar under every point
};

/// A hole drilled through the skin.
struct HoleRecipe {
    std::string where;     ///< where the entry begins, for messages
    dvec3 at{0};           ///< mm; the hole begins at the nearest point of the surface
    double radius = 0;     ///< mm
    dvec3 direction{0};    ///< inward; zero: at right angles to the surface
    double depth = 0;      ///< from the surface, mm; 0: through the skin
    bool through = false;  ///< through the filling, too
};

/// How many of a part are made at once.
struct PlateRecipe {
    int copies = 1;
    double gap = 5;  ///< between neighbours, mm
};

/// What is written besides the layers.
struct OutputRecipe {
    std::string beams;     ///< path of a 3MF beam lattice; empty for none
    NumberRows beams_box;  ///< two corners, mm; empty: the part's bounds
};

/// Without foam and skin the part is solid; with foam alone it is bare foam cut by the body; with a skin
/// alone it is a hollow shell.
struct Recipe {
    PartRecipe part;
    std::vector<FieldRecipe> fields;
    std::vector<GradingRecipe> gradings;
    std::vector<RegionRecipe> regions;
    std::optional<FoamRecipe> foam;
    std::optional<MaterialRecipe> material;
    std::optional<FrameRecipe> frame;
    std::optional<SkinRecipe> skin;
    std::optional<CavityRecipe> cavity;
    std::optional<ShieldRecipe> shield;
    std::optional<ProcessRecipe> process;
    std::optional<RepairRecipe> repair;
    std::vector<HoleRecipe> holes;
    SupportKind support = SupportKind::none;
    double layer_height = 0.05;  ///< mm
    PlateRecipe plate;
    OutputRecipe output;
    PrinterProfile printer;
};

/// Length of one unit, mm.
double millimetres(LengthUnit unit);

}  // namespace lamella
