// `lamella homogenize`: computes the stiffness of a recipe's foam.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <memory>

#include "app/charts/stiffness_plot.h"
#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/console/interrupt.h"
#include "app/console/progress.h"
#include "app/console/text_output.h"
#include "app/ranks/distribute_solves.h"
#include "app/ranks/run_on_ranks.h"
#include "app/reports/stiffness_report.h"
#include "engine/base/error.h"
#include "recipe/build/foam_modulus.h"
#include "recipe/settings.h"

namespace lamella {

namespace {

constexpr int samples_of_a_law = 4;

struct HomogenizeCommand {
    RecipeOptions recipe;
    std::string output;
    std::string ratios;
    std::string plot;
    StiffnessOptions options;
    bool table = false;
    bool json = false;
    bool quiet = false;
};

/// From beams that are barely printable to those that leave little void.
const std::vector<double> default_ratios{0.03, 0.04, 0.055, 0.075, 0.1, 0.14, 0.19, 0.26};

std::vector<double> ratios_of(const std::string& text) {
    if (text.empty()) return default_ratios;
    const auto count = static_cast<std::size_t>(std::ranges::count(text, ',')) + 1;
    const auto ratios = parse_numbers(text, count);
    if (!ratios || !std::ranges::is_sorted(*ratios, std::ranges::less_equal{}) || ratios->front() < 1e-3 ||
        ratios->back() > 1)
        throw InputError("--ratios: \"" + text.substr(0, 64) +
                         "\" is not a list of ascending ratios; accepted: ascending numbers from 0.001 to 1, "
                         "separated by commas");
    return *ratios;
}

void draw(const HomogenizeCommand& command, const StiffnessPlot& plot) {
    if (command.plot.empty()) return;
    TextOutput out(command.plot);
    out.write(stiffness_svg(plot));
    out.close();
}

/// The plan of a command: the solves for one result, or for each point of a law.
struct Homogenizing {
    Recipe recipe;
    StiffnessOptions options;
    std::vector<double> ratios;  ///< ratios of members to cells, one for each point of a law
    std::vector<StiffnessSolve> solves;
};

/// Makes the plan. Checks everything before the first solve. Throws InputError.
Homogenizing planned(const HomogenizeCommand& command, const CancelToken& cancel) {
    Homogenizing plan{command.recipe.read(false), command.options, {}, {}};
    const Recipe& recipe = plan.recipe;
    StiffnessOptions& options = plan.options;
    options.cancel = &cancel;
    options.material = homogenized_material(recipe);
    if (options.samples == 0) options.samples = command.table ? samples_of_a_law : 1;
    if (!command.table) {
        plan.solves = foam_solves(recipe, options);
        return plan;
    }
    plan.ratios = ratios_of(command.ratios);
    for (const double ratio : plan.ratios) {
        check_law_point(recipe, ratio);
        std::ranges::copy(law_solves(recipe, ratio, options), std::back_inserter(plan.solves));
    }
    return plan;
}

/// Writes a law, each point as soon as it is computed.
void write_table(const HomogenizeCommand& command, const Homogenizing& plan, DistributedSolves& solves,
                 TextOutput& out) {
    const std::string name = law_name(*plan.recipe.foam);
    const std::vector<double>& ratios = plan.ratios;
    const std::size_t each = plan.solves.size() / ratios.size();
    out.write(law_heading());
    StiffnessPlot plot{name, {}, plan.options.material, {}};
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        ProgressDisplay display(command.quiet,
                                fmt::format("ratio {:.4g}, {} of {}: ", ratios[i], i + 1, ratios.size()));
        const auto solved = solves.next(each, [&](double share) { display.show(share); });
        plot.law.push_back(law_point(ratios[i], solved));
        out.write(law_row(name, plot.law.back()));
    }
    draw(command, plot);
}

void write_stiffness(const HomogenizeCommand& command, const Homogenizing& plan, DistributedSolves& solves,
                     TextOutput& out) {
    const FoamRecipe& foam = *plan.recipe.foam;
    const IsotropicMaterial& material = plan.options.material;
    ProgressDisplay display(command.quiet);
    const FoamStiffness found =
        foam_stiffness(solves.next(plan.solves.size(), [&](double share) { display.show(share); }));
    display.finish();
    if (!command.plot.empty()) {
        const ElasticTensor stiffness = found.stiffness();
        const StiffnessPlot::Sample sample{found.mean(density_of), closest_isotropic(stiffness).young,
                                           stiffness};
        const auto law = known_law(foam);
        draw(command, {fmt::format("{} foam, {:.3g} mm a sample", law_name(foam), found.period),
                       law ? law->points : std::vector<FoamLawPoint>(), material, sample});
    }
    out.write(command.json ? stiffness_json(foam, material, found).dump(2) + "\n"
                           : stiffness_text(foam, material, found));
}

/// `ranks`: the processes that share the solves; null for a single process.
void run(const HomogenizeCommand& command, Ranks* ranks) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const Homogenizing plan = planned(command, cancel);
    TextOutput out(command.output);
    DistributedSolves solves(ranks, plan.recipe, plan.solves, plan.options);
    (command.table ? write_table : write_stiffness)(command, plan, solves, out);
    solves.finish();
    out.close();
}

/// The work of ranks other than 0.
void run_worker(const HomogenizeCommand& command, Ranks& ranks) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const Homogenizing plan = planned(command, cancel);
    help_with_solves(ranks, plan.recipe, plan.solves, plan.options);
}

}  // namespace

void add_homogenize_command(CLI::App& root) {
    auto options = std::make_shared<HomogenizeCommand>();
    options->options.samples = 0;
    CLI::App& command = *root.add_subcommand(
        "homogenize", "Compute the elastic stiffness of a recipe's foam by homogenisation");
    options->recipe.add_to(command);
    command
        .add_option("--rve", options->options.elements,
                    "Elements along a side of the sample, preferably a multiple of 16; 0: four per beam "
                    "radius, up to a million solid elements")
        ->type_name("N")
        ->check(CLI::Range(0, 1024));
    command
        .add_option("--samples", options->options.samples,
                    "Number of samples of a random foam, of 64 cells or more each; the result is their mean "
                    "and deviation; default: 1, for a table 4")
        ->type_name("N")
        ->check(CLI::Range(1, 1000));
    command.add_flag(
        "--table", options->table,
        "Write the foam's law as a file for foam.law: its stiffness over a range of member sizes");
    command
        .add_option("--ratios", options->ratios,
                    "Ratios of beam radius (wall thickness) to cell size in the table; default: 0.03 to 0.26")
        ->type_name("A,B,...");
    command
        .add_option("--plot", options->plot,
                    "Chart (SVG) of the modulus over the density, with bounds and the foam's law, and of the "
                    "modulus in all directions")
        ->type_name("FILE");
    command.add_option("--threads", options->options.threads, "Threads to use; 0: one per core")
        ->check(CLI::Range(0, 1024));
    command.add_option("-o,--output", options->output, "File to write; default: standard output")
        ->type_name("FILE");
    command.add_flag("--json", options->json, "Write the whole result as JSON");
    command.add_flag("-q,--quiet", options->quiet, "Nothing on standard error but errors");
    finish_command(
        command,
        "  lamella homogenize --cell 2 --beam 0.2 --young 2300 --poisson 0.35\n"
        "  lamella homogenize insole.toml --samples 4 --json -o stiffness.json\n"
        "  lamella homogenize gyroid.toml --rve 128 --plot gyroid.svg\n"
        "  lamella homogenize mine.toml --table -o mine.csv\n"
        "  mpirun -n 4 lamella homogenize mine.toml --table -o mine.csv\n"
        "A sample is one period of the foam, a cube; a random foam is made periodic for it. Only the "
        "ratio of\n"
        "sizes matters: cells and beams twice as large are equally stiff.\n"
        "mpirun distributes whole samples, for a table those of all ratios: a single sample uses one "
        "process.");
    command.callback([options] {
        const auto lead = [&](Ranks* ranks) { return run(*options, ranks), std::string(); };
        run_on_ranks(lead, [&](Ranks& ranks) { run_worker(*options, ranks); });
    });
}

}  // namespace lamella
