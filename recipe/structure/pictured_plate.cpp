// The problem on grids from coarse to fine, the picture in elements, shape and analysis.
#include "recipe/structure/pictured_plate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/error.h"
#include "procedural/appearance/appearance_optimizer.h"
#include "recipe/structure/design_settings.h"
#include "recipe/structure/loaded_elements.h"
#include "recipe/structure/structural_problem.h"

namespace lamella {

namespace {

AppearanceSettings appearance_settings(const OptimizeRecipe& optimize, const DensitySettings& density) {
    AppearanceSettings settings;
    settings.compliance = optimize.compliance;
    settings.volume_min = optimize.volume_min;
    settings.match.neighbourhood = optimize.neighbourhood;
    settings.match.exponent = optimize.exponent;
    settings.match.spread = optimize.spread;
    settings.levels = optimize.levels;
    if (optimize.iterations > 0) settings.steps = optimize.iterations;
    settings.radius = density.radius;
    settings.mirrored = density.mirrored;
    settings.sharpness = optimize.sharpness;
    return settings;
}

/// Returns the picture in black and white, `width` elements across. It is smoothed to half an element before:
/// what is smaller would be grey, and greys are copied.
GreyImage exemplar_of(const OptimizeRecipe& optimize, int width) {
    constexpr int pixels_an_element = 2;
    GreyImage image = solidity(read_picture(optimize.image), optimize.invert);
    if (image.width > pixels_an_element * width) image = box_filtered(image, pixels_an_element * width);
    if (optimize.threshold == 0) return black_and_white(image, otsu_threshold(image));
    return black_and_white(image, optimize.invert ? optimize.threshold : 1 - optimize.threshold);
}

double solid_share(const GreyImage& image) {
    double sum = 0;
    for (const double v : image.values) sum += v;
    return sum / static_cast<double>(image.values.size());
}

/// Throws InputError unless plate and picture have room for a window on the coarsest grid.
void check_room(const OptimizeRecipe& optimize, const ElementDomain& domain, const GreyImage& exemplar,
                int width) {
    const int window = optimize.neighbourhood, halvings = optimize.levels - 1;
    const auto check = [&](const std::string& what, int across, int high) {
        if (std::min(across, high) >= window) return;
        throw InputError(fmt::format(
            "optimize.neighbourhood / --optimize-neighbourhood: windows of {0} x {0} elements do not fit "
            "{1}, {2} x {3} on the coarsest of {4} grids; accepted: smaller windows, fewer levels, more "
            "elements{5}",
            window, what, across, high, optimize.levels,
            what == "the picture" ? ", or a larger image_size" : ""));
    };
    check("the plate", domain.size.x >> halvings, domain.size.y >> halvings);
    const double aspect = static_cast<double>(exemplar.height) / exemplar.width;
    check("the picture", width >> halvings, static_cast<int>(std::lround(aspect * (width >> halvings))));
}

/// Tells what of the picture a plate cannot show: lines that drown in the elements of the coarsest grid, from
/// which all others start, and another share of material than the plate has.
void note_unsuited(const GreyImage& exemplar, int width, int levels, double volume,
                   std::vector<std::string>& notes) {
    const double share = solid_share(exemplar);
    constexpr double far_off = 0.2;
    if (std::abs(share - volume) > far_off) {
        notes.push_back(fmt::format(
            "the picture is {:.0f} % solid and the plate at most {:.0f} %, so it shows in parts only; "
            "optimize.invert, threshold and volume bring them together",
            100 * share, 100 * volume));
    }
    const GreyImage coarse = box_filtered(exemplar, std::max(1, width >> (levels - 1)));
    const auto is_grey = [](double v) { return v > 0.25 && v < 0.75; };
    const double grey = static_cast<double>(std::ranges::count_if(coarse.values, is_grey)) /
                        static_cast<double>(coarse.values.size());
    constexpr double much = 0.5;
    if (grey <= much) return;
    notes.push_back(fmt::format(
        "{:.0f} % of the picture are grey on the coarsest of {} grids, whose elements are as wide as its "
        "lines; more elements, fewer levels or a larger image_size show it better",
        100 * grey, levels));
}

/// The plate on grids of several widths.
class PlateProblems {
  public:
    PlateProblems(const Recipe& recipe, const Field& body, const BuiltRegions& regions, Gradings& gradings,
                  const CancelToken* cancel)
        : recipe_(recipe),
          body_(body),
          regions_(regions),
          gradings_(gradings),
          cancel_(cancel),
          finest_(element_domain(recipe, body, regions, cancel)) {}

    const ElementDomain& finest() const { return finest_; }

    /// Returns the problem of a grid, see PlaneProblemMaker; `domain` is what of the body it has.
    StructuralProblem<2> problem(glm::ivec3 size, int edge, ElementDomain& domain) const {
        domain = element_domain_of(recipe_, body_, regions_, finest_, size, edge, cancel_);
        StructuralProblem<2> made = structural_problem<2>(recipe_, domain, gradings_, material_poisson);
        const OptimizeRecipe& optimize = *recipe_.optimize;
        made.topology.law = penalty_law<2>(optimize);
        made.topology.volume = volume_bound(optimize, domain, made.material);
        make_loads_solid(0, domain, made);
        return made;
    }

  private:
    const Recipe& recipe_;
    const Field& body_;
    const BuiltRegions& regions_;
    Gradings& gradings_;
    const CancelToken* cancel_;
    ElementDomain finest_;
};

OptimizationStep step_of(const AppearanceStep& found, int index) {
    OptimizationStep step;
    step.index = index;
    step.compliance = found.compliance;
    step.volume = found.volume;
    step.greyness = found.greyness;
    step.change = found.change;
    step.sharpness = found.sharpness;
    step.solver_iterations = found.solver_iterations;
    step.appearance = found.appearance;
    return step;
}

}  // namespace

PartDesign pictured_plate(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                          Gradings& gradings, const OptimizeOptions& options) {
    const OptimizeRecipe& optimize = *recipe.optimize;
    if (options.resume)
        throw InputError(
            "--resume: a search for an appearance that was stopped is not kept; accepted: another kind, "
            "or no --resume");
    const PlateProblems problems(recipe, body, regions, gradings, options.cancel);
    ElementDomain domain;
    const StructuralProblem<2> problem = problems.problem(problems.finest().size, 1, domain);

    PartDesign design;
    design.box = domain.box;
    design.report = std::make_shared<StructureReport>();
    StructureReport& report = *design.report;
    describe(problem, domain, report);

    AppearanceSettings settings = appearance_settings(optimize, density_settings(optimize, domain));
    settings.volume = problem.topology.volume;
    settings.cancel = options.cancel;
    settings.shared = options.shared;
    settings.report = [&](const AppearanceStep& found) {
        report.history.push_back(step_of(found, static_cast<int>(report.history.size()) + 1));
        if (options.on_iteration) options.on_iteration(report.history.back(), step_count(settings));
    };
    const int width = std::max(1, static_cast<int>(std::lround(optimize.image_size / domain.edges.x)));
    const GreyImage exemplar = exemplar_of(optimize, width);
    check_room(optimize, domain, exemplar, width);
    note_unsuited(exemplar, width, settings.levels, settings.volume, report.notes);
    const PlaneProblemMaker make_problem = [&](glm::ivec3 size, int edge) {
        ElementDomain at_level;
        return problems.problem(size, edge, at_level).topology;
    };
    AppearanceResult found = optimize_appearance(make_problem, domain.size, exemplar, width, settings);

    report.densities_compliance = problem.displacement_unit * found.compliance;
    report.least_compliance = problem.displacement_unit * found.least_compliance;
    report.greyness = found.greyness;
    report.appearance = found.appearance;
    report.stiffest_appearance = found.stiffest_appearance;
    design.grid = {domain.size, domain.use, std::move(found.filtered)};
    const double volume = std::min(found.volume, settings.volume);
    report.stray_pieces = cut_shape(design.grid, {std::min(settings.volume_min, volume), volume},
                                    problem.anchored, problem.loaded);
    analyse(problem, domain, make_penalty_law({1, void_modulus_of<2>, 0}), solid_shares(design.grid, 0.5),
            false, options.cancel, report);
    return design;
}

}  // namespace lamella
