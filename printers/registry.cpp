// The table of back-ends. A new one is a file of its own and one line here.
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
#include "printers/vector/dxf.h"
#include "printers/vector/slice_3mf.h"
#include "printers/vector/svg.h"

namespace lamella {
namespace {

dvec3 display_build_volume(const PrinterProfile& profile, double /*layer_height*/) {
    return {display_area_limits(profile.image), infinity};
}

constexpr std::array backend_table = {
    BackendInfo{"png", "folder of 8-bit grey PNG masks with a job.json", "", OutputKind::folder,
                make_png_stack, LayerContent::pixels, true, nullptr, display_build_volume},
    BackendInfo{"sl1", "archive for SL1 and SL1S resin printers, and for converters to others", ".sl1 .sl1s",
                OutputKind::file, make_sl1, LayerContent::pixels, true, nullptr, display_build_volume},
    BackendInfo{"goo", "file for resin printers with 8-bit displays", ".goo", OutputKind::file, make_goo,
                LayerContent::pixels, false, nullptr, display_build_volume},
    BackendInfo{"nanodlp", "archive for NanoDLP, with the areas and islands of each layer", ".nanodlp",
                OutputKind::file, make_nanodlp, LayerContent::pixels, true, nullptr, display_build_volume},
    BackendInfo{"ember", "tar.gz for the resin printer Autodesk Ember", ".tar.gz", OutputKind::file,
                make_ember, LayerContent::pixels, true, nullptr, display_build_volume},
    BackendInfo{"svg", "contours in mm: one SVG with a group a layer, or one file a layer", ".svg",
                OutputKind::file_or_folder, make_svg, LayerContent::contours, true},
    BackendInfo{"dxf", "folder of DXF R12 files for cutters, one a layer or sheet", "", OutputKind::folder,
                make_dxf, LayerContent::contours},
    BackendInfo{"gcode", "G-code for filament printers, and for lasers under GRBL", ".gcode",
                OutputKind::file, make_gcode, LayerContent::beads, true, nullptr, gcode_build_volume},
    BackendInfo{"cli", "contours as a Common Layer Interface file, for powder-bed machines", ".cli",
                OutputKind::file, make_cli, LayerContent::contours, true},
    BackendInfo{"3mf", "contours as a 3MF slice stack, for powder-bed machines", ".3mf", OutputKind::file,
                make_slice_3mf, LayerContent::contours, true,
                "programs that do not know 3MF slices show a plain box instead of the part, most of them "
                "without a word"},
    BackendInfo{"image3d", "grey sheets as an image stack in a 3MF package, for programs that read volumes",
                ".3mf", OutputKind::file, make_image3d, LayerContent::voxels, true,
                "programs that do not know 3MF volumes refuse the file or show a plain box"},
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

SupportProfile default_supports(std::string_view backend) {
    SupportProfile support;
    constexpr std::array resin{"png", "sl1", "goo", "nanodlp", "ember"};
    if (std::ranges::find(resin, backend) == resin.end()) return support;
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
