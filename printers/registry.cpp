// The tables of back-ends and profiles. A new printer is one file of its own and one line here.
#include "printers/registry.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "engine/error.h"
#include "printers/dxf.h"
#include "printers/gcode.h"
#include "printers/goo.h"
#include "printers/png_stack.h"
#include "printers/sl1.h"
#include "printers/svg.h"

namespace lamella {
namespace {

constexpr std::array backend_table = {
    BackendInfo{"png", "folder of 8-bit grey PNG masks with a job.json", OutputKind::folder, make_png_stack},
    BackendInfo{"sl1", "archive for SL1 and SL1S resin printers, and for converters to others",
                OutputKind::file, make_sl1},
    BackendInfo{"goo", "file for resin printers with 8-bit displays", OutputKind::file, make_goo},
    BackendInfo{"svg", "contours in mm: one SVG with a group a layer, or one file a layer",
                OutputKind::file_or_folder, make_svg},
    BackendInfo{"dxf", "folder of DXF R12 files for cutters, one a layer or sheet", OutputKind::folder,
                make_dxf},
    BackendInfo{"gcode", "G-code for filament printers with Marlin firmware", OutputKind::file, make_gcode},
};

PrinterProfile display(const char* name, int width, int height, double pixel, bool portrait) {
    PrinterProfile profile;
    profile.name = name;
    profile.backend = "png";
    profile.image.width = width;
    profile.image.height = height;
    profile.image.pixel_x = pixel;
    profile.image.pixel_y = pixel;
    profile.image.portrait = portrait;
    profile.support = usual_supports("png");
    return profile;
}

PrinterProfile archive(PrinterProfile profile, const char* machine) {
    profile.backend = "sl1";
    profile.resin.machine = machine;
    return profile;
}

PrinterProfile plain(const char* name, const char* backend) {
    PrinterProfile profile;
    profile.name = name;
    profile.backend = backend;
    return profile;
}

/// Edits (insertions, deletions, replacements) that turn one word into the other (Levenshtein 1966).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
        }
    }
    return row.back();
}

template <typename Entry>
const Entry& find(std::span<const Entry> entries, std::string_view name, const char* kind) {
    for (const Entry& entry : entries) {
        if (entry.name == name) return entry;
    }
    constexpr std::size_t longest = 100;  // of what a message repeats and a distance is worked out for
    const std::string_view shown = name.substr(0, longest);
    std::string known;
    const Entry* nearest = nullptr;
    std::size_t least = 4;  // edits; beyond three it is no slip of the keys
    for (const Entry& entry : entries) {
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
        const std::size_t edits = edit_distance(shown, entry.name);
        if (edits < least) {
            least = edits;
            nearest = &entry;
        }
    }
    std::string message = "no " + std::string(kind) + " '" + std::string(shown) + "'";
    if (nearest != nullptr) message += "; did you mean '" + std::string(nearest->name) + "'?";
    throw InputError(message + " Known: " + known);
}

}  // namespace

std::span<const BackendInfo> backends() { return backend_table; }

SupportProfile usual_supports(std::string_view backend) {
    SupportProfile support;
    if (backend != "png" && backend != "sl1" && backend != "goo") return support;
    support.spacing = 4;
    support.own_bridge = 2;
    support.bridge = 8;
    support.reach = 3;
    support.connector = 3;
    support.tip = 0.5;
    support.pillar = 1.2;
    support.round_pillars = true;
    support.bar_width = 0.8;
    support.bar_height = 0.8;
    support.foot = 8;
    support.foot_height = 0.6;
    support.density = 1.12;
    return support;
}

std::span<const PrinterProfile> profiles() {
    // The display of the SL1 is 120.96 x 68.04 mm with 2560 x 1440 px, that of the SL1S 128 x 81 mm with
    // 2560 x 1620 px; both stand upright and show the plate mirrored (vendor's presets), which is what
    // `portrait` without further mirrors gives.
    static const std::array table = {
        display("generic-8k", 7680, 4320, 0.025, false),
        display("generic-4k", 3840, 2160, 0.05, false),
        archive(display("prusa-sl1", 2560, 1440, 0.04725, true), "SL1"),
        archive(display("prusa-sl1s", 2560, 1620, 0.05, true), "SL1S"),
        plain("svg", "svg"),
        plain("marlin", "gcode"),
    };
    return table;
}

const BackendInfo& find_backend(std::string_view name) { return find(backends(), name, "back-end"); }
const PrinterProfile& find_profile(std::string_view name) { return find(profiles(), name, "printer"); }

std::unique_ptr<Backend> make_backend(const PrinterProfile& profile, const std::string& output_path,
                                      bool force) {
    return find_backend(profile.backend).make(profile, output_path, force);
}

}  // namespace lamella
