// What a recipe says about the machine: one plain struct that every back-end reads its part of.
#pragma once

#include <string>

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
};

struct VectorProfile {
    double tolerance = 0.025;  ///< mm between contour and surface
    bool one_file = true;      ///< one file with a group a layer; otherwise a folder of files
    double margin = 1;         ///< mm round the part
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

/// A machine: which back-end, under which name, and its numbers.
struct PrinterProfile {
    std::string name = "generic-8k";
    std::string backend = "png";
    ImageProfile image;
    VectorProfile vector;
    FilamentProfile filament;
};

}  // namespace lamella
