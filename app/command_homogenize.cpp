// `lamella homogenize`: how stiff the foam of a recipe is.
#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/build_job.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/recipe_options.h"
#include "app/text_output.h"
#include "procedural/field_sample.h"
#include "procedural/homogenization.h"

namespace lamella {

namespace {

constexpr double elements_in_a_radius = 4;
constexpr int least_elements = 32, most_elements = 160, elements_step = 16;

struct HomogenizeCommand {
    RecipeOptions recipe;
    std::string output;
    int elements = 0;
    int samples = 1;
    int threads = 0;
    IsotropicMaterial material;
    bool json = false;
    bool quiet = false;
};

/// What was found of all samples.
struct FoamStiffness {
    double period = 0;  ///< side of a sample, mm
    int elements = 0;   ///< along it
    std::vector<Homogenized> samples;

    template <typename Number>
    double mean(Number number) const {
        double sum = 0;
        for (const Homogenized& sample : samples) sum += number(sample);
        return sum / static_cast<double>(samples.size());
    }
    /// Of single samples about their mean: the standard deviation.
    template <typename Number>
    double spread(Number number) const {
        if (samples.size() < 2) return 0;
        const double middle = mean(number);
        double sum = 0;
        for (const Homogenized& sample : samples) sum += std::pow(number(sample) - middle, 2);
        return std::sqrt(sum / static_cast<double>(samples.size() - 1));
    }
    ElasticTensor stiffness() const {
        ElasticTensor c{};
        for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t j = 0; j < 6; ++j)
                c[i][j] = mean([&](const Homogenized& sample) { return sample.stiffness[i][j]; });
        }
        return c;
    }
};

double density_of(const Homogenized& sample) { return sample.density; }
double young_of(const Homogenized& sample) { return closest_isotropic(sample.stiffness).young; }
double poisson_of(const Homogenized& sample) { return closest_isotropic(sample.stiffness).poisson; }
double shear_of(const Homogenized& sample) { return closest_isotropic(sample.stiffness).shear(); }
double bulk_of(const Homogenized& sample) { return closest_isotropic(sample.stiffness).bulk(); }

double constant_of(const GradedUse& use) {
    const auto number = use.made->constant();
    if (!number)
        throw InputError(use.key +
                         ": it varies in space, and a sample stands for one place; accepted: a number");
    return *number;
}

/// The foam that repeats, over one period.
BuiltFoam repeating_foam(const Recipe& recipe, double& period) {
    const double cell = recipe.foam->cell.is_formula() ? 1 : recipe.foam->cell.number();
    const BuiltFoam first = build_foam_alone(recipe, {dvec3(0), dvec3(cell)});
    constant_of(first.cell);
    constant_of(first.member);
    if (!(first.period > 0))
        throw InputError("foam: with this stretch it does not repeat along x, y and z, as a sample has to");
    period = first.period;
    return build_foam_alone(recipe, {dvec3(0), dvec3(period)});
}

int suited_elements(const BuiltFoam& foam, const std::string& member, double period) {
    const double radius = member == "wall" ? foam.member.made->constant().value_or(0) / 2
                                           : foam.member.made->constant().value_or(0);
    const double wanted = elements_in_a_radius * period / radius;
    const int steps = static_cast<int>(std::ceil(std::min(wanted, 1e6) / elements_step));
    return std::clamp(steps * elements_step, least_elements, most_elements);
}

FoamStiffness homogenize_foam(const HomogenizeCommand& command, Recipe recipe, const CancelToken& cancel) {
    FoamStiffness found;
    recipe.foam->repeats_after = 1;
    for (int i = 0; i < command.samples; ++i) {
        if (i > 0) ++recipe.foam->seed;
        const BuiltFoam foam = repeating_foam(recipe, found.period);
        const bool walls = recipe.foam->wall.is_formula() || recipe.foam->wall.number() > 0;
        found.elements =
            command.elements > 0
                ? command.elements
                : suited_elements(foam, walls && !foam.beams_touching ? "wall" : "beam", found.period);
        HomogenizationOptions options;
        options.threads = command.threads;
        options.cancel = &cancel;
        if (!command.quiet) {
            options.on_progress = [&](int iteration, double left) {
                std::fputs(fmt::format("\rsample {} of {}: iteration {}, forces left {:.1e} ", i + 1,
                                       command.samples, iteration, left)
                               .c_str(),
                           stderr);
            };
        }
        oneapi::tbb::task_arena arena(command.threads > 0 ? command.threads
                                                          : oneapi::tbb::task_arena::automatic);
        const ElementMask sample = arena.execute([&] {
            return sample_field(*foam.field, {dvec3(0), dvec3(found.period)}, found.elements);
        });
        found.samples.push_back(homogenize(sample, command.material, options));
    }
    if (!command.quiet) std::fputs("\n", stderr);
    return found;
}

std::string report(const HomogenizeCommand& command, const Recipe& recipe, const FoamStiffness& found) {
    const ElasticTensor c = found.stiffness();
    const double density = found.mean(density_of), solid = command.material.young;
    const IsotropicMaterial closest = closest_isotropic(c),
                            bound = hashin_shtrikman(command.material, density);
    const auto line = [&](const char* name, double value, double spread, const char* more) {
        const std::string about = found.samples.size() > 1 ? fmt::format(" +- {:.2g}", spread) : "";
        return fmt::format("{:<18}{:.5g}{}{}\n", name, value, about, more);
    };
    const bool one = found.samples.size() == 1;
    std::string text = fmt::format(
        "{} foam: {} of {:.4g} mm, {} elements along a side, of a material with E = {:.6g} "
        "and nu = {:.4g}\n\n",
        recipe.foam->kind, one ? "a sample" : fmt::format("{} samples", found.samples.size()), found.period,
        found.elements, solid, command.material.poisson);
    text += line("density", density, found.spread(density_of), " of the solid");
    text += line("E", closest.young, found.spread(young_of),
                 fmt::format(", {:.4g} % of the material's", 100 * closest.young / solid).c_str());
    text += line("nu", closest.poisson, found.spread(poisson_of), "");
    text += line("G", closest.shear(), found.spread(shear_of), "");
    text += line("K", closest.bulk(), found.spread(bulk_of), "");
    text += fmt::format("{:<18}{:.2f} % from isotropic", "anisotropy", 100 * anisotropy(c));
    const Interval e = directional_moduli(compliance_of(c));
    text += fmt::format(", E from {:.5g} to {:.5g} by direction\n", e.lo, e.hi);
    text += fmt::format("{:<18}E at most {:.5g} (Voigt), isotropic {:.5g} (Hashin and Shtrikman)\n\n",
                        "bounds", density * solid, bound.young);
    text += "stiffness          xx          yy          zz          xy          yz          zx\n";
    const std::array<const char*, 6> names{"xx", "yy", "zz", "xy", "yz", "zx"};
    for (std::size_t i = 0; i < 6; ++i) {
        text += fmt::format("{:>9}", names[i]);
        for (const double v : c[i]) text += fmt::format("{:>12.5g}", v);
        text += "\n";
    }
    return text;
}

nlohmann::ordered_json json_of(const HomogenizeCommand& command, const Recipe& recipe,
                               const FoamStiffness& found) {
    const ElasticTensor c = found.stiffness();
    const IsotropicMaterial closest = closest_isotropic(c);
    auto samples = nlohmann::ordered_json::array();
    for (const Homogenized& sample : found.samples) {
        samples.push_back({{"density", sample.density},
                           {"iterations", sample.iterations},
                           {"E", young_of(sample)},
                           {"nu", poisson_of(sample)},
                           {"stiffness", sample.stiffness}});
    }
    const Interval e = directional_moduli(compliance_of(c));
    return {{"foam", recipe.foam->kind},
            {"period_mm", found.period},
            {"elements", found.elements},
            {"material", {{"E", command.material.young}, {"nu", command.material.poisson}}},
            {"density", found.mean(density_of)},
            {"E", closest.young},
            {"nu", closest.poisson},
            {"G", closest.shear()},
            {"K", closest.bulk()},
            {"anisotropy", anisotropy(c)},
            {"E_least", e.lo},
            {"E_greatest", e.hi},
            {"E_hashin_shtrikman", hashin_shtrikman(command.material, found.mean(density_of)).young},
            {"stiffness", c},
            {"samples", std::move(samples)}};
}

void run(const HomogenizeCommand& command) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const Recipe recipe = command.recipe.read(false);
    if (!recipe.foam)
        throw InputError(
            "[foam] is missing: there is nothing to homogenise; accepted: a recipe with one, or --cell and "
            "--beam");
    check_material(command.material);
    const FoamStiffness found = homogenize_foam(command, recipe, cancel);
    TextOutput out(command.output);
    out.write(command.json ? json_of(command, recipe, found).dump(2) + "\n" : report(command, recipe, found));
    out.close();
}

}  // namespace

void add_homogenize_command(CLI::App& root) {
    auto options = std::make_shared<HomogenizeCommand>();
    CLI::App& command =
        *root.add_subcommand("homogenize", "Compute how stiff the foam of a recipe is, to all sides");
    options->recipe.add_to(command);
    command
        .add_option("--rve", options->elements,
                    "Elements along a side of the sample, best a multiple of 16; 0: four a beam's radius, at "
                    "most 160")
        ->type_name("N")
        ->check(CLI::Range(0, 512));
    command
        .add_option("--samples", options->samples,
                    "Samples of a random foam, of 64 cells or more each: their mean and how far single ones "
                    "are from it")
        ->type_name("N")
        ->check(CLI::Range(1, 1000));
    command
        .add_option("--young", options->material.young,
                    "Young's modulus of the material; default 1: results are shares of it")
        ->type_name("MPA");
    command
        .add_option("--poisson", options->material.poisson, "Poisson's ratio of the material; default 1/3")
        ->type_name("NU");
    command.add_option("--threads", options->threads, "Threads to use; 0: one a core")
        ->check(CLI::Range(0, 1024));
    command.add_option("-o,--output", options->output, "File to write; default: standard output")
        ->type_name("FILE");
    command.add_flag("--json", options->json, "All of it for programs");
    command.add_flag("-q,--quiet", options->quiet, "Nothing on standard error but faults");
    finish_command(
        command,
        "  lamella homogenize --cell 2 --beam 0.2 --young 2300 --poisson 0.35\n"
        "  lamella homogenize insole.toml --samples 4 --json -o stiffness.json\n"
        "  lamella homogenize gyroid.toml --rve 128\n"
        "A sample is one period of the foam's, a cube; a random foam is made to repeat for it. Sizes do\n"
        "not matter, their ratio does: cells and beams twice as large are as stiff.");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
