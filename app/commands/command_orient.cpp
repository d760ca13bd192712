// `lamella orient`: ranks the ways to stand a part on the bed.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/commands/written_orientation.h"
#include "app/console/interrupt.h"
#include "app/console/text_output.h"
#include "recipe/build/json_triple.h"
#include "recipe/placement/orient_part.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

struct OrientCommand {
    RecipeOptions recipe;
    OrientOptions orient;
    std::string goal = "supports";
    std::string output;
    bool json = false;
    int write = 0;  ///< the orientation to write into the recipe, from 1; 0: none
};

const std::map<std::string, OrientGoal> goals{{"supports", OrientGoal::supports},
                                              {"height", OrientGoal::height},
                                              {"surface", OrientGoal::surface},
                                              {"area", OrientGoal::area}};

Json as_json(const Orientation& orientation) {
    const OrientationFigures& figures = orientation.figures;
    return {{"lay_on", json_triple(orientation.lay_on)},
            {"supports_mm3", orientation.planned ? Json(*orientation.planned) : Json()},
            {"estimated_supports_mm3", figures.support_volume},
            {"overhang_mm2", figures.overhang_area},
            {"height_mm", figures.height},
            {"on_bed_mm2", figures.bed_area},
            {"largest_layer_mm2", figures.largest_layer}};
}

Json as_json(const OrientReport& report) {
    Json best = Json::array();
    for (const Orientation& orientation : report.best) best.push_back(as_json(orientation));
    return {{"now", as_json(report.now)}, {"best", std::move(best)}};
}

std::string row(const std::string& name, const Orientation& orientation) {
    const OrientationFigures& f = orientation.figures;
    const std::string planned = orientation.planned ? fmt::format("{:.0f}", *orientation.planned) : "";
    return fmt::format("{:<4} {:>12} {:>12.0f} {:>12.0f} {:>10.1f} {:>11.0f} {:>14.0f}   {}\n", name, planned,
                       f.support_volume, f.overhang_area, f.height, f.bed_area, f.largest_layer,
                       lay_on_text(orientation.lay_on));
}

std::string as_text(const OrientReport& report) {
    std::string text =
        fmt::format("{:<4} {:>12} {:>12} {:>12} {:>10} {:>11} {:>14}   {}\n", "", "supports mm3",
                    "estimate mm3", "overhang mm2", "height mm", "on bed mm2", "largest layer", "lay_on");
    text += row("now", report.now);
    for (std::size_t i = 0; i < report.best.size(); ++i)
        text += row(fmt::format("{}", i + 1), report.best[i]);
    return text;
}

void run(const OrientCommand& command) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    OrientOptions options = command.orient;
    options.goal = goals.at(command.goal);
    options.cancel = &cancel;
    if (command.write > 0) check_is_recipe(command.recipe.input());
    const OrientReport report = orient_part(command.recipe.read(), options);
    if (command.write > 0) {
        const auto chosen = static_cast<std::size_t>(command.write);
        if (chosen > report.best.size())
            throw InputError(fmt::format("--write: there is no orientation {}; accepted: 1 to {}", chosen,
                                         report.best.size()));
        write_orientation(command.recipe.input(), report.best[chosen - 1].lay_on);
    }
    TextOutput out(command.output);
    out.write(command.json ? as_json(report).dump(2) + "\n" : as_text(report));
    out.close();
}

}  // namespace

void add_orient_command(CLI::App& root) {
    auto options = std::make_shared<OrientCommand>();
    CLI::App& command = *root.add_subcommand("orient", "Rank the ways to stand a part on the bed");
    options->recipe.add_to(command);
    command
        .add_option("--for", options->goal,
                    "What the orientation is to be good for: supports, height, surface or area; default: "
                    "supports")
        ->check(CLI::IsMember({"supports", "height", "surface", "area"}))
        ->type_name("WORD");
    command
        .add_option("--plan", options->orient.plan,
                    "Plan the supports of this many of the best by estimate, where supports are the goal; "
                    "default: 3")
        ->check(CLI::Range(0, 100));
    command.add_option("--count", options->orient.count, "Orientations to list; default: 10")
        ->check(CLI::Range(1, 100));
    command
        .add_option("--write", options->write,
                    "Write this orientation of the list into the recipe, as part.lay_on; 1: the best")
        ->check(CLI::Range(1, 100));
    command.add_flag("--json", options->json, "Write the list as JSON");
    command.add_option("-o,--output", options->output, "File; default: standard output")->type_name("FILE");
    command.add_option("--threads", options->orient.threads, "Threads to use; 0: one per core")
        ->check(CLI::Range(0, 1024));
    finish_command(
        command,
        "  lamella orient model.stl --printer marlin --layer-height 0.2\n"
        "  lamella orient figure.toml --for area --write 1\n"
        "Supports are estimated by a pillar below each overhang; those of the first three are planned.");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
