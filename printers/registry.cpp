// The table of back-ends. A new one is a file of its own and one row here.
#include "printers/registry.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "engine/base/error.h"
#include "printers/gcode/gcode.h"
#include "printers/masks/ember.h"
#include "printers/masks/goo.h"
#include "printers/masks/image3d.h"
#include "printers/masks/mask.h"
#include "printers/masks/nanodlp.h"
#include "printers/masks/png_stack.h"
#include "printers/masks/sl1.h"
#include "printers/vector/cli.h"
#include "printers/vector/cut_sheets.h"
#include "printers/vector/dxf.h"
#include "printers/vector/slice_3mf.h"
#include "printers/vector/svg.h"

namespace lamella {
namespace {

dvec3 display_build_volume(const PrinterProfile& profile, double /*layer_height*/) {
    return {display_area_limits(profile.image), infinity};
}

template <Process process>
Process always(const PrinterProfile& /*profile*/) {
    return process;
}

/// SVG is for cutters, but as Slic3r exports it for resin machines.
Process svg_process(const PrinterProfile& profile) {
    return profile.cutting.dialect == SvgDialect::slic3r ? Process::resin : Process::cutting;
}

/// Under GRBL, G-code is for lasers.
Process gcode_process(const PrinterProfile& profile) {
    return profile.gcode.flavour == Flavour::grbl ? Process::cutting : Process::filament;
}

bool previews(const PrinterProfile& profile) { return profile.resin.preview; }
bool has_thumbnails(const PrinterProfile& profile) { return profile.gcode.thumbnails; }

constexpr std::array backend_table = {
    BackendInfo{.name = "png",
                .description = "folder of 8-bit grey PNG masks with a job.json",
                .endings = "",
                .output = OutputKind::folder,
                .make = make_png_stack,
                .content = LayerContent::pixels,
                .process = always<Process::resin>,
                .default_supports = resin_supports,
                .build_volume = display_build_volume,
                .streams = true},
    BackendInfo{.name = "sl1",
                .description = "archive for SL1 and SL1S resin printers, and for converters to others",
                .endings = ".sl1 .sl1s",
                .output = OutputKind::file,
                .make = make_sl1,
                .content = LayerContent::pixels,
                .process = always<Process::resin>,
                .default_supports = resin_supports,
                .build_volume = display_build_volume,
                .embeds_picture = previews,
                .layer_heights = LayerHeights::first,
                .streams = true},
    BackendInfo{.name = "goo",
                .description = "file for resin printers with 8-bit displays",
                .endings = ".goo",
                .output = OutputKind::file,
                .make = make_goo,
                .content = LayerContent::pixels,
                .process = always<Process::resin>,
                .default_supports = resin_supports,
                .build_volume = display_build_volume,
                .embeds_picture = previews},
    BackendInfo{.name = "nanodlp",
                .description = "archive for NanoDLP, with the areas and islands of each layer",
                .endings = ".nanodlp",
                .output = OutputKind::file,
                .make = make_nanodlp,
                .content = LayerContent::pixels,
                .process = always<Process::resin>,
                .default_supports = resin_supports,
                .build_volume = display_build_volume,
                .layer_heights = LayerHeights::equal,
                .streams = true},
    BackendInfo{.name = "ember",
                .description = "tar.gz for the resin printer Autodesk Ember",
                .endings = ".tar.gz",
                .output = OutputKind::file,
                .make = make_ember,
                .content = LayerContent::pixels,
                .process = always<Process::resin>,
                .default_supports = resin_supports,
                .build_volume = display_build_volume,
                .layer_heights = LayerHeights::equal,
                .streams = true},
    BackendInfo{.name = "svg",
                .description = "contours in mm: one SVG with a group a layer, or one file a layer",
                .endings = ".svg",
                .output = OutputKind::file_or_folder,
                .make = make_svg,
                .content = LayerContent::contours,
                .process = svg_process,
                .cuts_sheets = asks_for_cutting,
                .streams = true},
    BackendInfo{.name = "dxf",
                .description = "folder of DXF R12 files for cutters, one a layer or sheet",
                .endings = "",
                .output = OutputKind::folder,
                .make = make_dxf,
                .content = LayerContent::contours,
                .process = always<Process::cutting>,
                .cuts_sheets = [](const PrinterProfile&) { return true; }},
    BackendInfo{.name = "gcode",
                .description = "G-code for filament printers, and for lasers under GRBL",
                .endings = ".gcode .gco .g .nc .ngc .tap",
                .output = OutputKind::file,
                .make = make_gcode,
                .content = LayerContent::beads,
                .process = gcode_process,
                .build_volume = gcode_build_volume,
                .embeds_picture = has_thumbnails,
                .streams = true},
    BackendInfo{.name = "cli",
                .description = "contours as a Common Layer Interface file, for powder-bed machines",
                .endings = ".cli",
                .output = OutputKind::file,
                .make = make_cli,
                .content = LayerContent::contours,
                .process = always<Process::powder>,
                .streams = true},
    BackendInfo{.name = "3mf",
                .description = "contours as a 3MF slice stack, for powder-bed machines",
                .endings = ".3mf",
                .output = OutputKind::file,
                .make = make_slice_3mf,
                .content = LayerContent::contours,
                .process = always<Process::powder>,
                .streams = true,
                .warning = "programs that do not know 3MF slices show a plain box instead of the part, most "
                           "of them without a word"},
    BackendInfo{
        .name = "image3d",
        .description = "grey sheets as an image stack in a 3MF package, for programs that read volumes",
        .endings = ".3mf",
        .output = OutputKind::file,
        .make = make_image3d,
        .content = LayerContent::voxels,
        .process = always<Process::powder>,
        .layer_heights = LayerHeights::equal,
        .streams = true,
        .warning = "programs that do not know 3MF volumes refuse the file or show a plain box"},
};

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

}  // namespace

std::span<const BackendInfo> backends() { return backend_table; }

SupportProfile filament_supports() { return {}; }

SupportProfile resin_supports() {
    SupportProfile support;
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

dvec3 build_volume_limits(const PrinterProfile& profile, double layer_height) {
    const auto build_volume = find_backend(profile.backend).build_volume;
    return build_volume != nullptr ? build_volume(profile, layer_height) : dvec3(infinity);
}

Process process_of(const PrinterProfile& profile) {
    if (profile.check.process != Process::from_backend) return profile.check.process;
    return find_backend(profile.backend).process(profile);
}

void check_layer_heights(const PrinterProfile& profile, const LayerPlan& layers) {
    const BackendInfo& backend = find_backend(profile.backend);
    const bool cuts =
        cuts_sheets(profile) || (makes_beads(profile) && process_of(profile) == Process::cutting);
    check_layer_heights(cuts ? LayerHeights::equal : backend.layer_heights, layers, {0, layers.count()},
                        cuts ? "a sheet of material" : backend.name);
}

bool cuts_sheets(const PrinterProfile& profile) {
    const auto cuts = find_backend(profile.backend).cuts_sheets;
    return cuts != nullptr && cuts(profile);
}

bool makes_beads(const PrinterProfile& profile) {
    return find_backend(profile.backend).content == LayerContent::beads;
}

double printable_overhang(const PrinterProfile& profile, double layer_height) {
    if (profile.support.overhang > 0) return profile.support.overhang;
    return makes_beads(profile) ? profile.filament.line_width / 2 : layer_height;
}

const BackendInfo& find_backend(std::string_view name) {
    constexpr std::size_t longest = 100;  // of what a message repeats and a distance is worked out for
    const std::string_view shown = name.substr(0, longest);
    std::string known;
    const BackendInfo* nearest = nullptr;
    std::size_t least = 4;  // edits; beyond three it is no slip of the keys
    for (const BackendInfo& entry : backend_table) {
        if (entry.name == name) return entry;
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
        const std::size_t edits = edit_distance(shown, entry.name);
        if (edits < least) {
            least = edits;
            nearest = &entry;
        }
    }
    std::string message = "no back-end '" + std::string(shown) + "'";
    if (nearest != nullptr) message += "; did you mean '" + std::string(nearest->name) + "'?";
    throw InputError(message + " Known: " + known);
}

std::unique_ptr<Backend> make_backend(const PrinterProfile& profile, const std::string& output_path,
                                      bool force) {
    const BackendInfo& info = find_backend(profile.backend);
    if (output_path == "-" && !info.streams) {
        std::string able;
        for (const BackendInfo& other : backends()) {
            if (other.streams) able += (able.empty() ? "" : ", ") + std::string(other.name);
        }
        throw InputError(
            std::string(info.name) +
            " files cannot go to standard output; name one with -o, or use a back-end that can: " + able);
    }
    return info.make(profile, output_path, force);
}

}  // namespace lamella
