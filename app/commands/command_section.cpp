// `lamella section`: writes one section of the part at any height.
#include <fmt/format.h>

#include <memory>
#include <string_view>

#include "app/commands/commands.h"
#include "app/commands/prepare_job.h"
#include "app/commands/recipe_options.h"
#include "app/console/text_output.h"
#include "app/reports/section_writer.h"
#include "engine/base/error.h"
#include "recipe/build/finish_job.h"

namespace lamella {

namespace {

struct SectionOptions {
    RecipeOptions recipe;
    double z = 0;
    std::string format;
    std::string output;
};

/// Returns the requested format, or else that of the file's ending.
std::string chosen_format(const SectionOptions& options) {
    if (!options.format.empty()) return options.format;
    const std::string_view path = options.output;
    for (const char* format : {"svg", "png", "json"}) {
        if (path.ends_with(std::string(".") + format)) return format;
    }
    return "svg";
}

std::string section(const SectionOptions& options, const std::string& format) {
    const Recipe recipe = options.recipe.read();
    note_unused(options.recipe, recipe);
    BuiltJob built = build_job(recipe, with_kept_plans(false));
    finish_job(recipe, built, {});
    const Box& bounds = built.job.bounds;
    if (!(bounds.lo.z <= options.z && options.z <= bounds.hi.z)) {
        throw InputError(fmt::format("--z: {} misses the part; accepted: a height from {} to {} mm",
                                     options.z, bounds.lo.z, bounds.hi.z));
    }
    SliceContext context;
    const FieldPtr& supports = built.job.supports;
    const PlaneCut cut{context.slice(*built.job.part, options.z),
                       supports ? &context.slice(*supports, options.z) : nullptr, options.z, bounds.rect()};
    if (format == "png") return section_png(cut, recipe.printer);
    const double tolerance = recipe.printer.vector.tolerance;
    return format == "svg" ? section_svg(cut, tolerance) : section_json(cut, tolerance);
}

void run(const SectionOptions& options) {
    const std::string format = chosen_format(options);
    TextOutput out(options.output);
    if (format == "png" && out.to_terminal()) {
        throw InputError(
            "--format: png is not written to a terminal; accepted: -o FILE, a pipe, or svg or json");
    }
    out.write(section(options, format));
    out.close();
}

}  // namespace

void add_section_command(CLI::App& root) {
    auto options = std::make_shared<SectionOptions>();
    CLI::App& command =
        *root.add_subcommand("section", "Cut part and supports at one height: contours or pixels");
    options->recipe.add_to(command);
    command
        .add_option("--z", options->z,
                    "Height of the plane in part coordinates (`lamella info` shows the bounds), mm")
        ->required()
        ->type_name("MM");
    command
        .add_option("--format", options->format,
                    "svg, png or json; default: from the ending of the file, else svg")
        ->check(CLI::IsMember({"svg", "png", "json"}))
        ->type_name("WORD");
    command.add_option("-o,--output", options->output, "File; default: standard output")->type_name("FILE");
    finish_command(command,
                   "  lamella section insole.toml --z 4.2 -o section.svg\n"
                   "  lamella section model.stl --cell 3 --beam 0.5 --z 10 --format png > section.png");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
