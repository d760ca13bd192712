// Checks the output before the layers, and writes its file after them.
#include "recipe/output/beam_output.h"

#include <fmt/format.h>

#include <filesystem>

#include "engine/base/error.h"

namespace lamella {

void check_beam_output(const Recipe& recipe, const BuiltJob& built, bool replace) {
    if (!built.foam || !built.foam->beams_touching) {
        const std::string what = recipe.foam ? "foam.kind " + recipe.foam->kind : "a part without foam";
        throw InputError("output.beams / --output-beams: " + what +
                         " has no beams; accepted: a foam of beams, or no output.beams");
    }
    std::error_code ignored;
    if (!replace && std::filesystem::exists(recipe.output.beams, ignored)) {
        throw InputError(recipe.output.beams +
                         ": exists already; accepted: another output.beams, or --force to replace it");
    }
}

BeamLatticeReport write_beam_output(const Recipe& recipe, const BuiltJob& built) {
    const OutputRecipe& output = recipe.output;
    const Box box = output.beams_box.empty() ? built.designed.bounds : box_of(output.beams_box);
    const std::vector<Beam> beams = built.foam->beams_touching(box);
    if (beams.empty()) {
        throw InputError(
            "output.beams_box / --output-beams-box: no beam touches this box; accepted: a box that "
            "intersects the foam");
    }
    return write_beam_lattice(output.beams, beams, recipe.part.name);
}

std::string lattice_text(const std::string& path, const BeamLatticeReport& report) {
    return fmt::format("{}: {} beams between {} nodes, {} too short to be written", path, report.beams,
                       report.vertices, report.dropped);
}

}  // namespace lamella
