// What a recipe says about the machine: one plain struct that every back-end reads its part of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "printers/common/check_profile.h"
#include "printers/common/gcode_profile.h"

namespace lamella {

/// How grey values of an image stack are made.
enum class Antialiasing : unsigned char {
    off,   ///< black and white, by the pixel's centre
    rows,  ///< sub_rows lines per pixel row, exact along each
    exact  ///< area under the contour's chords
};

/// File format of an image stack. PNG is written straight from runs; the others go through pixels.
enum class ImageFormat : unsigned char { png, tiff, bmp, pgm };

struct ImageProfile {
    ImageFormat format = ImageFormat::png;
    int width = 2560;       ///< px
    int height = 1620;      ///< px
    double pixel_x = 0.05;  ///< mm
    double pixel_y = 0.05;  ///< mm
    bool mirror_x = false;
    bool mirror_y = false;
    bool portrait = false;  ///< image columns run along +y of the plate
    Antialiasing antialiasing = Antialiasing::rows;
    int sub_rows = 4;
    int bits = 8;          ///< of a pixel in PNG stacks: 1, 8 or 16
    int sub_layers = 1;    ///< planes a layer whose images are averaged
    double gamma = 1;      ///< grey is coverage to this power
    double min_grey = 0;   ///< of a pixel that is touched at all, 0 to 1
    double full_grey = 1;  ///< of a pixel that is covered wholly, 0 to 1
    double margin = 0;     ///< at the display's edge, that a part must stay clear of, mm
};

/// How a display's pixels stand in the colours of an archive's images.
enum class PanelPixels : unsigned char {
    rgb,     ///< one pixel each, its grey in all three colours
    packed,  ///< three pixels side by side are red, green and blue of one: panels without colour filters
    grey     ///< grey images
};

struct NanoDlpProfile {
    PanelPixels pixels = PanelPixels::rgb;
};

/// How a resin is cured.
struct ResinProfile {
    std::string machine;  ///< model that a file is for; SL1 machines refuse those for another one
    std::string material = "resin";
    double exposure = 2.5;       ///< of a layer, s
    double first_exposure = 25;  ///< of the first layers, s
    int first_layers = 4;        ///< exposed like the first one; SL1 machines take 3 whatever is said
    int fade_layers = 10;        ///< over which the one becomes the other
    double moves = 6;            ///< s that a layer takes besides its exposure
    double lift = 6;  ///< by which the plate rises after each layer, mm; SL1 machines know by themselves
    double lift_speed = 60;      ///< mm/min
    double retract_speed = 150;  ///< mm/min
    std::uint8_t light = 255;    ///< share of the full power, 255 all of it
    bool preview = true;         ///< files carry a picture of the part
    std::string notes;           ///< keywords for converters to other formats, such as FILEFORMAT_goo
};

struct VectorProfile {
    double tolerance = 0.025;  ///< mm between contour and surface
    bool one_file = true;      ///< one file with a group a layer; otherwise a folder of files
    double margin = 1;         ///< mm round the part
};

/// How contours are written for other programs and powder-bed machines.
enum class CliFormat : unsigned char { binary, ascii };

struct ExchangeProfile {
    CliFormat cli_format = CliFormat::binary;
    double cli_units = 1;         ///< of coordinates in CLI files, mm
    bool cli_empty_layer = true;  ///< begin CLI files with an empty layer at the height of the plate
    int package_layers = 50;      ///< slices in each file inside a 3MF package
};

/// Whose software reads the strokes of a cutting sheet.
enum class Laser : unsigned char { none, generic, lightburn, trotec, epilog, glowforge, xtool };

/// What becomes of a layer that would fall into loose pieces.
enum class Ties : unsigned char { none, join, refuse };

/// Which reader an SVG file is for.
enum class SvgDialect : unsigned char { plain, slic3r };

/// How layers are cut out of sheets, as thick as a layer is high. Lengths in mm.
struct CuttingProfile {
    Laser laser = Laser::none;
    SvgDialect dialect = SvgDialect::plain;
    double kerf = 0;  ///< width of what the cutter takes away
    Ties ties = Ties::none;
    double tie_width = 2;
    bool numbers = false;       ///< engrave each layer's number
    double number_height = 5;   ///< at most
    bool next_outline = false;  ///< score where the layer above comes to lie
    std::vector<std::vector<double>>
        sheet;                ///< a row, width and height of a sheet that layers share; empty: one layer each
    double sheet_margin = 5;  ///< free at a sheet's edges and between layers
    int dowels = 0;           ///< holes through all layers
    double dowel_diameter = 3;  ///< of such a hole
    double dowel_margin = 2;    ///< of material about it
    double dowel_height = 0;    ///< how far up the holes reach from the bed; 0: through the part
    std::vector<std::vector<double>> dowel_at;  ///< x and y of each; empty: where there is room
};

struct FilamentProfile {
    double bed_x = 220, bed_y = 220, bed_z = 250;  ///< mm
    double nozzle = 0.4;                           ///< mm
    double filament = 1.75;                        ///< diameter, mm
    double line_width = 0.45;                      ///< mm
    double infill_density = 1;                     ///< share of the inside that is filled, 0 to 1
    double nozzle_temperature = 210;               ///< degrees Celsius
    double bed_temperature = 60;                   ///< degrees Celsius
    double print_speed = 40, first_layer_speed = 20, travel_speed = 150;  ///< mm/s
    double retraction = 0.8, retraction_speed = 35;                       ///< mm, mm/s
    double tolerance = 0.025;                                             ///< mm between contour and surface
};

/// How the inside of an island is filled.
enum class InfillPattern : unsigned char {
    lines,      ///< straight, at +45 degrees on even layers and -45 on odd ones
    concentric  ///< loops within one another
};

/// Where loops begin and end.
enum class Seam : unsigned char {
    nearest,  ///< where the way to them is short
    rear,     ///< at their largest y
    corner    ///< at their sharpest corner
};

/// How an extruder's paths are planned. Lengths in mm.
struct ToolpathProfile {
    int walls = 2;          ///< beads round each island, the outermost included
    int top_layers = 4;     ///< solid ones under what is open above, where infill is sparse
    int bottom_layers = 3;  ///< solid ones over what is open below
    InfillPattern infill = InfillPattern::lines;
    Seam seam = Seam::nearest;
    double brim = 0;  ///< width of what is laid round the first layer, touching it
    int skirt = 0;    ///< loops round the first layer, to fill the nozzle
    double skirt_distance = 3;
};

/// What a machine can print over the void, and how its supports are shaped. Lengths in mm.
struct SupportProfile {
    double overhang = 0;      ///< by which a layer may stand out over the one below; 0: half a line's width,
                              ///< for other machines than those with filament a layer's height
    double spacing = 3;       ///< a support point holds what lies within this distance
    double free_stretch = 1;  ///< of outline that may hang unheld
    double own_bridge = 10;   ///< straight runs of the part up to this length, held at both ends, need none
    double bridge = 12;       ///< longest bar between two pillars
    double reach = 4;         ///< by which a connector may lean sideways
    double connector = 2;     ///< least height of a connector
    double longest_connector = 8;  ///< height of what stands on a bar
    double clearance = 0.5;        ///< between part and supports, contacts apart
    double gap = 0;                ///< between the tip of a connector and the part
    double tip = 0.6;              ///< diameter of a connector where it meets the part
    double pillar = 2.5;           ///< width of a pillar: of a round one its diameter, of a cross its arms
    bool round_pillars = false;    ///< round pillars instead of crosses
    double wall = 0;               ///< thickness of a cross's arms; 0: a line's width
    double bar_width = 0.9;
    double bar_height = 0.6;
    double foot = 6;  ///< diameter of a pillar's foot on the bed
    double foot_height = 0.2;
    double lift = 0;         ///< by which the part is raised over the bed
    double margin = 1;       ///< by which the centre of mass must lie inside the hull of what holds the part
    double push = 0.1;       ///< sideways force of the nozzle, N
    double adhesion = 0.02;  ///< of the part to the bed, MPa
    double bond = 1;         ///< of the part to a support point, MPa
    double density = 1.24;   ///< of the material, g/cm3
    double speed = 30;       ///< of printing supports, mm/s
    double grey = 1;         ///< of supports in image stacks, 0 to 1
};

/// A machine: which back-end, under which name, and its numbers.
struct PrinterProfile {
    std::string name = "generic-8k";
    std::string backend = "png";
    ImageProfile image;
    NanoDlpProfile nanodlp;
    ResinProfile resin;
    VectorProfile vector;
    ExchangeProfile exchange;
    CuttingProfile cutting;
    FilamentProfile filament;
    ToolpathProfile toolpath;
    GcodeProfile gcode;
    LaserProfile laser;
    SupportProfile support;
    CheckProfile check;
};

}  // namespace lamella
