// The problem on grids from coarse to fine, the picture in elements, shape and analysis.
#include "recipe/structure/pictured_plate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.h"
#include "procedural/appearance/appearance_optimizer.h"
#include "procedural/optimization/greyness.h"
#include "recipe/structure/design_settings.h"
#include "recipe/structure/loaded_elements.h"
#include "recipe/structure/stopped_search.h"
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
          finest_(element_domain(recipe, body, regions, cancel)) {}

    const ElementDomain& finest() const { return finest_; }

    /// Returns the problem of a grid, see PlaneProblemMaker; `domain` is what of the body it has.
    StructuralProblem<2> problem(glm::ivec3 size, int edge, const CancelToken* cancel,
                                 ElementDomain& domain) const {
        domain = element_domain_of(recipe_, body_, regions_, finest_, size, edge, cancel);
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
    ElementDomain finest_;
};

/// One search, and the plate that it ends with or has got to.
class PlateSearch {
  public:
    PlateSearch(const Recipe& recipe, const PlateProblems& problems, const OptimizeOptions& options,
                const std::filesystem::path& file)
        : options_(options),
          file_(file),
          problems_(problems),
          cancel_(options.cancel),
          problem_(problems.problem(problems.finest().size, 1, options.cancel, domain_)),
          settings_(appearance_settings(*recipe.optimize, density_settings(*recipe.optimize, domain_))) {
        settings_.volume = problem_.topology.volume;
        settings_.cancel = options.cancel;
        settings_.shared = options.shared;
    }

    PartDesign optimize(const OptimizeRecipe& optimize);

  private:
    void search(AppearanceOptimizer& optimizer, StructureReport& report);
    void keep(const AppearanceOptimizer& optimizer, StructureReport& report) const;
    void show_picture(const AppearanceResult& found, PartDesign& design) const;
    void show_stiffest(const AppearanceResult& found, PartDesign& design) const;
    bool try_to_show_picture(const AppearanceResult& found, PartDesign& design) const;
    void cut(std::vector<double> density, double volume, PartDesign& design) const;
    bool is_cancelled() const { return options_.cancel != nullptr && options_.cancel->cancelled(); }

    const OptimizeOptions& options_;
    const std::filesystem::path& file_;  ///< of a search that is stopped
    const PlateProblems& problems_;
    const CancelToken* cancel_;  ///< of making grids; null once it was obeyed
    ElementDomain domain_;
    StructuralProblem<2> problem_;  ///< of the finest grid
    AppearanceSettings settings_;
};

/// Steps to the end, or until it is cancelled.
void PlateSearch::search(AppearanceOptimizer& optimizer, StructureReport& report) {
    if (options_.resume) optimizer.set_state(kept_search<AppearanceState>(file_, report));
    while (!optimizer.is_finished()) {
        try {
            const AppearanceStep found = optimizer.iterate();
            OptimizationStep& step = report.history.emplace_back(OptimizationStep{found});
            step.index = static_cast<int>(report.history.size());
            step.appearance = found.appearance;
        } catch (const Interrupted&) {
            if (!optimizer.has_result()) throw;
            keep(optimizer, report);
            cancel_ = nullptr;
            return;
        }
        if (options_.on_iteration) options_.on_iteration(report.history.back(), step_count(settings_));
        if (options_.on_design) {
            options_.on_design(
                {domain_.size, domain_.box, &domain_.use, [&] { return optimizer.result().filtered; }});
        }
    }
}

void PlateSearch::keep(const AppearanceOptimizer& optimizer, StructureReport& report) const {
    const bool is_kept = keep_search(file_, optimizer.state(), report);
    report.notes.push_back(fmt::format("the search was stopped after {} of about {} steps{}",
                                       report.history.size(), step_count(settings_),
                                       is_kept ? "; --resume goes on with it" : ""));
}

/// Cuts the shape that fills a share of the plate, and analyses it.
void PlateSearch::cut(std::vector<double> density, double volume, PartDesign& design) const {
    design.grid = {domain_.size, domain_.use, std::move(density)};
    design.report->stray_pieces = cut_shape(design.grid, {std::min(settings_.volume_min, volume), volume},
                                            problem_.anchored, problem_.loaded);
    analyse(problem_, domain_, make_penalty_law({1, void_modulus_of<2>, 0}), solid_shares(design.grid, 0.5),
            false, nullptr, *design.report);
}

void PlateSearch::show_picture(const AppearanceResult& found, PartDesign& design) const {
    design.report->densities_compliance = problem_.displacement_unit * found.compliance;
    design.report->greyness = found.greyness;
    design.report->appearance = found.appearance;
    cut(found.filtered, std::min(found.volume, settings_.volume), design);
}

void PlateSearch::show_stiffest(const AppearanceResult& found, PartDesign& design) const {
    design.report->densities_compliance = design.report->least_compliance;
    design.report->greyness = greyness(domain_.use, found.stiffest);
    design.report->appearance = found.stiffest_appearance;
    cut(found.stiffest, settings_.volume, design);
}

/// Before the projection has parted solid from void, the shape may lack members. Returns whether it bears the
/// loads, if not as stiff as at the end.
bool PlateSearch::try_to_show_picture(const AppearanceResult& found, PartDesign& design) const {
    if (design.report->history.empty()) return false;
    constexpr double far_too_soft = 2;  // times what is allowed
    try {
        show_picture(found, design);
    } catch (const FaultError&) {  // so soft that the solver gives up
        return false;
    }
    const StructureReport& report = *design.report;
    return report.compliance <= far_too_soft * settings_.compliance * report.least_compliance;
}

PartDesign PlateSearch::optimize(const OptimizeRecipe& optimize) {
    PartDesign design;
    design.box = domain_.box;
    design.report = std::make_shared<StructureReport>();
    StructureReport& report = *design.report;
    describe(problem_, domain_, report);
    const int width = std::max(1, static_cast<int>(std::lround(optimize.image_size / domain_.edges.x)));
    const GreyImage exemplar = exemplar_of(optimize, width);
    check_room(optimize, domain_, exemplar, width);
    note_unsuited(exemplar, width, settings_.levels, settings_.volume, report.notes);
    const PlaneProblemMaker make_problem = [this](glm::ivec3 size, int edge) {
        ElementDomain at_level;
        return problems_.problem(size, edge, cancel_, at_level).topology;
    };
    AppearanceOptimizer optimizer(make_problem, domain_.size, exemplar, width, settings_);
    search(optimizer, report);

    const AppearanceResult found = optimizer.result();
    report.least_compliance = problem_.displacement_unit * found.least_compliance;
    report.stiffest_appearance = found.stiffest_appearance;
    if (optimizer.is_finished()) {
        show_picture(found, design);
        if (is_cancelled()) keep(optimizer, report);
        return design;
    }
    const StructureReport before = report;
    if (try_to_show_picture(found, design)) return design;
    report = before;
    report.notes.emplace_back(
        "nothing like the picture is stiff enough yet; this is the stiffest plate so far");
    show_stiffest(found, design);
    return design;
}

}  // namespace

PartDesign pictured_plate(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                          Gradings& gradings, const OptimizeOptions& options,
                          const std::filesystem::path& search) {
    const PlateProblems problems(recipe, body, regions, gradings, options.cancel);
    return PlateSearch(recipe, problems, options, search).optimize(*recipe.optimize);
}

}  // namespace lamella
