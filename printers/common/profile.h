// PrinterProfile: the settings of a machine, as plain structs. Each back-end reads its own part.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "printers/common/check_profile.h"
#include "printers/common/gcode_profile.h"
#include "printers/common/tool_profile.h"

namespace lamella {

/// Antialiasing: how the grey values of an image stack are computed.
enum class Antialiasing : unsigned char {
    off,   ///< black and white, sampled at the pixel's centre
    rows,  ///< mean of sub_rows lines per pixel row, each exact along its length
    exact  ///< exact area inside the polygonal contour
};

/// File format of an image stack. PNG is encoded directly from runs; the other formats are encoded from
/// pixels.
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
    int bits = 8;          ///< bits per pixel of PNG stacks: 1, 8 or 16
    int sub_layers = 1;    ///< planes per layer; their images are averaged
    double gamma = 1;      ///< exponent: grey = coverage ^ gamma
    double min_grey = 0;   ///< grey of the faintest touched pixel, 0 to 1
    double full_grey = 1;  ///< grey of a fully covered pixel, 0 to 1
    double margin = 0;     ///< strip along the display's edge that a part must keep clear of, mm
};

/// How the pixels of a display are stored in the colour channels of an archive's images.
enum class PanelPixels : unsigned char {
    rgb,     ///< one display pixel per image pixel, its grey in all three channels
    packed,  ///< three adjacent display pixels per image pixel, as its red, green and blue: for displays
             ///< without colour filters
    grey     ///< grey images, one display pixel per image pixel
};

struct NanoDlpProfile {
    PanelPixels pixels = PanelPixels::rgb;
};

/// Curing of a resin: exposures, moves, light.
struct ResinProfile {
    std::string machine;  ///< model that a file is made for; SL1 machines refuse files for another model
    std::string material = "resin";
    double exposure = 2.5;       ///< exposure of a layer, s
    double first_exposure = 25;  ///< exposure of the first layers, s
    int first_layers = 4;        ///< number of layers exposed like the first; SL1 machines always take 3
    int fade_layers = 10;        ///< layers over which the exposure then falls to `exposure`
    double penetration =
        0;  ///< depth at which light has faded to 1/e, mm; exposures follow it; 0: they do not
    double exposure_height = 0.05;  ///< height of the layers that the exposures are meant for, mm
    double moves = 6;               ///< time of a layer besides its exposure, s
    double lift = 6;             ///< rise of the plate after each layer, mm; SL1 machines use their own value
    double lift_speed = 60;      ///< mm/min
    double retract_speed = 150;  ///< mm/min
    std::uint8_t light = 255;    ///< power of the light source; 255 is full power
    bool preview = true;         ///< embed a picture of the part
    std::string notes;           ///< keywords for converters to other formats, such as FILEFORMAT_goo
};

struct VectorProfile {
    double tolerance = 0.025;  ///< largest distance between contour and surface, mm
    bool one_file = true;      ///< one file with a group per layer; otherwise a folder with a file per layer
    double margin = 1;         ///< margin around the part, mm
};

/// Encoding of CLI files (Common Layer Interface).
enum class CliFormat : unsigned char { binary, ascii };

struct ExchangeProfile {
    CliFormat cli_format = CliFormat::binary;
    double cli_units = 1;         ///< unit of the coordinates in CLI files, mm
    bool cli_empty_layer = true;  ///< begin CLI files with an empty layer at the plate's height
    int package_layers = 50;      ///< slices in each file of a 3MF package
};

/// Laser software that the stroke colours and widths of a sheet are chosen for.
enum class Laser : unsigned char { none, generic, lightburn, trotec, epilog, glowforge, xtool };

/// Treatment of a layer that would fall into loose pieces: leave it, join the pieces with ties, or refuse the
/// job.
enum class Ties : unsigned char { none, join, refuse };

/// Reader that an SVG file is written for.
enum class SvgDialect : unsigned char { plain, slic3r };

/// How layers are cut out of sheets whose thickness is the layer height. Lengths in mm.
struct CuttingProfile {
    Laser laser = Laser::none;
    SvgDialect dialect = SvgDialect::plain;
    double kerf = 0;  ///< width of the material that the cutter removes
    Ties ties = Ties::none;
    double tie_width = 2;
    bool numbers = false;       ///< engrave each layer's number
    double number_height = 5;   ///< largest height of the number
    bool next_outline = false;  ///< score the outline of the layer above
    std::vector<std::vector<double>>
        sheet;  ///< one row: width and height of a sheet shared by several layers; empty: one sheet per layer
    double sheet_margin = 5;    ///< strip kept free along a sheet's edges and between layers
    int dowels = 0;             ///< number of dowel holes through all layers
    double dowel_diameter = 3;  ///< diameter of a dowel hole
    double dowel_margin = 2;    ///< least width of material around a dowel hole
    double dowel_height = 0;  ///< height up to which the holes reach, from the bed; 0: through the whole part
    std::vector<std::vector<double>> dowel_at;  ///< x and y of each hole; empty: chosen where there is room
};

struct FilamentProfile {
    double bed_x = 220, bed_y = 220, bed_z = 250;  ///< mm
    double nozzle = 0.4;                           ///< diameter of the nozzle, mm
    double filament = 1.75;                        ///< diameter, mm
    double line_width = 0.45;                      ///< mm
    double infill_density = 1;                     ///< filled share of the interior, 0 to 1
    double nozzle_temperature = 210;               ///< degrees Celsius
    double bed_temperature = 60;                   ///< degrees Celsius
    double print_speed = 40, first_layer_speed = 20, travel_speed = 150;  ///< mm/s
    double retraction = 0.8, retraction_speed = 35;                       ///< mm, mm/s
    double tolerance = 0.025;  ///< largest distance between contour and surface, mm
};

/// Pattern of an island's infill.
enum class InfillPattern : unsigned char {
    lines,      ///< straight lines, at +45 degrees on even layers and -45 on odd ones
    concentric  ///< nested loops
};

/// Where closed beads start and end.
enum class Seam : unsigned char {
    nearest,  ///< at the point that is nearest to the nozzle
    rear,     ///< at the largest y
    corner    ///< at the sharpest corner
};

/// Planning of an extruder's paths. Lengths in mm.
struct ToolpathProfile {
    int walls = 2;          ///< perimeters per island, the outermost included
    int top_layers = 4;     ///< solid layers below an upward-facing surface, where infill is sparse
    int bottom_layers = 3;  ///< solid layers above a downward-facing surface, where infill is sparse
    InfillPattern infill = InfillPattern::lines;
    Seam seam = Seam::nearest;
    double brim = 0;  ///< width of the brim around the first layer, which touches it
    int skirt = 0;    ///< loops around the first layer that prime the nozzle
    double skirt_distance = 3;
};

/// Unsupported spans that a machine can print, and the shape of its supports. Lengths in mm.
struct SupportProfile {
    double overhang = 0;      ///< largest overhang of a layer over the one below; 0: the default, half a line
                              ///< width for filament machines and the layer height for others
    double spacing = 3;       ///< distance within which a support point holds the part
    double free_stretch = 1;  ///< length of outline that may hang unsupported
    double own_bridge = 10;   ///< longest straight bridge of the part itself, held at both ends
    double bridge = 12;       ///< longest bar between two pillars
    double reach = 4;         ///< largest sideways lean of a connector
    double connector = 2;     ///< least height of a connector
    double longest_connector = 8;  ///< largest height of a connector on a bar
    double clearance = 0.5;        ///< least distance between part and supports, except at contacts
    double gap = 0;                ///< distance between a connector's tip and the part
    double tip = 0.6;              ///< diameter of a connector at the part
    double pillar = 2.5;           ///< width of a pillar: the diameter of a round one, the arms of a cross
    bool round_pillars = false;    ///< round pillars instead of crosses
    double wall = 0;               ///< thickness of a cross's arms; 0: a line width
    double bar_width = 0.9;
    double bar_height = 0.6;
    double foot = 6;  ///< diameter of a pillar's foot on the bed
    double foot_height = 0.2;
    double lift = 0;         ///< height of the part above the bed
    double margin = 1;       ///< least distance of the centre of mass inside the convex hull of the
                             ///< part's supporting points
    double push = 0.1;       ///< sideways force of the nozzle, N
    double adhesion = 0.02;  ///< strength of the bond between part and bed, MPa
    double bond = 1;         ///< strength of the bond between part and a support point, MPa
    double density = 1.24;   ///< density of the material, g/cm3
    double speed = 30;       ///< speed at which supports are printed, mm/s
    double grey = 1;         ///< grey of supports in image stacks, 0 to 1
};

/// A machine: its name, its back-end and its settings.
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
    std::vector<ToolProfile> tools;  ///< by number; empty: one, with the settings of `filament`
    PurgeProfile purge;
    LaserProfile laser;
    SupportProfile support;
    CheckProfile check;
    std::string host;  ///< where `lamella send` sends its files: a host's name or address; empty: not known
};

}  // namespace lamella
