// `lamella orient`: ranks the ways to stand a part on the bed.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/commands/written_orientation.h"
#include "app/console/interrupt.h"
#include "app/console/picture_output.h"
#include "app/console/text_output.h"
#include "recipe/build/json_triple.h"
#include "recipe/output/orientation_sheet.h"
#include "recipe/placement/orient_part.h"
#include "recipe/settings.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

struct OrientCommand {
    RecipeOptions recipe;
    OrientOptions orient;
    std::string goal = "supports";
    std::string output;
    std::string load;
    std::string picture;
    bool json = false;
    int write = 0;  ///< the orientation to write into the recipe, from 1; 0: none
};

const std::map<std::string, OrientGoal> goals{{"supports", OrientGoal::supports},
                                              {"height", OrientGoal::height},
                                              {"surface", OrientGoal::surface},
                                              {"area", OrientGoal::area},
                                              {"strength", OrientGoal::strength}};

Json as_json(const Orientation& orientation, bool has_loads) {
    const OrientationFigures& figures = orientation.figures;
    return {{"lay_on", json_triple(orientation.lay_on)},
            {"supports_mm3", orientation.planned ? Json(*orientation.planned) : Json()},
            {"estimated_supports_mm3", figures.support_volume},
            {"overhang_mm2", figures.overhang_area},
            {"height_mm", figures.height},
            {"on_bed_mm2", figures.bed_area},
            {"largest_layer_mm2", figures.largest_layer},
            {"largest_step_mm2", figures.largest_step},
            {"stands_mm", figures.stands},
            {"cups_mm3", orientation.cups ? Json(*orientation.cups) : Json()},
            {"load_across", has_loads ? Json(figures.load_across) : Json()}};
}

Json as_json(const OrientReport& report) {
    Json best = Json::array();
    for (const Orientation& orientation : report.best) best.push_back(as_json(orientation, report.has_loads));
    return {{"now", as_json(report.now, report.has_loads)}, {"best", std::move(best)}};
}

std::string row(const std::string& name, const Orientation& orientation, bool has_loads) {
    const OrientationFigures& f = orientation.figures;
    const std::string planned = orientation.planned ? fmt::format("{:.0f}", *orientation.planned) : "";
    const std::string across = has_loads ? fmt::format(" {:>6.0f}", 100 * f.load_across) : "";
    const std::string cups = orientation.cups ? fmt::format(" {:>6.0f}", *orientation.cups) : "";
    return fmt::format(
        "{:<4} {:>8} {:>8.0f} {:>8.0f} {:>6.1f} {:>6.0f} {:>7.0f} {:>8.0f} {:>6.1f}{}{}   {}\n", name,
        planned, f.support_volume, f.overhang_area, f.height, f.bed_area, f.largest_layer, f.largest_step,
        f.stands, cups, across, lay_on_text(orientation.lay_on));
}

std::string as_text(const OrientReport& report) {
    const bool has_loads = report.has_loads, has_cups = report.now.cups.has_value();
    std::string text;
    const auto head = [&](auto... words) {
        text += fmt::format("{:<4} {:>8} {:>8} {:>8} {:>6} {:>6} {:>7} {:>8} {:>6}{}{}   {}\n", "", words...);
    };
    head("supports", "estimate", "overhang", "height", "on bed", "largest", "largest", "stands",
         has_cups ? "   cups" : "", has_loads ? " across" : "", "lay_on");
    head("mm3", "mm3", "mm2", "mm", "mm2", "layer", "step mm2", "mm", has_cups ? "    mm3" : "",
         has_loads ? "      %" : "", "x,y,z");
    text += row("now", report.now, has_loads);
    for (std::size_t i = 0; i < report.best.size(); ++i)
        text += row(fmt::format("{}", i + 1), report.best[i], has_loads);
    return text;
}

dvec3 direction_of(const std::string& text) {
    const auto numbers = parse_numbers(text, 3);
    const dvec3 direction = numbers ? dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]) : dvec3(0);
    if (!(length(direction) > 0 && length(direction) < infinity))
        throw InputError("--load: " + text + " is no direction; accepted: X,Y,Z, three numbers, not all 0");
    return direction;
}

void run(const OrientCommand& command) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    OrientOptions options = command.orient;
    options.goal = goals.at(command.goal);
    options.cancel = &cancel;
    if (!command.load.empty()) options.loads = {direction_of(command.load)};
    if (command.write > 0) check_is_recipe(command.recipe.input());
    if (!command.picture.empty()) check_is_picture("--picture", command.picture);
    const Recipe recipe = command.recipe.read();
    const OrientReport report = orient_part(recipe, options);
    if (!command.picture.empty())
        write_picture(command.picture, orientation_sheet(recipe, report.best, options.threads));
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
                    "What the orientation is to be good for: supports, height, surface, area or strength; "
                    "default: supports")
        ->check(CLI::IsMember({"supports", "height", "surface", "area", "strength"}))
        ->type_name("WORD");
    command
        .add_option("--load", options->load,
                    "Direction of the load, of the part as it was designed; default: the forces of [[load]]")
        ->type_name("X,Y,Z");
    command
        .add_option("--plan", options->orient.plan,
                    "Plan the supports of this many orientations, where supports are the goal; default: as "
                    "many as take some seconds")
        ->check(CLI::Range(0, 100));
    command.add_option("--count", options->orient.count, "Orientations to list; default: 10")
        ->check(CLI::Range(1, 100));
    command
        .add_option("--write", options->write,
                    "Write this orientation of the list into the recipe, as part.lay_on; 1: the best")
        ->check(CLI::Range(1, 100));
    command
        .add_option("--picture", options->picture,
                    "Picture of the first ten, numbered, with the overhangs in red")
        ->type_name("FILE");
    command.add_flag("--json", options->json, "Write the list as JSON");
    command.add_option("-o,--output", options->output, "File; default: standard output")->type_name("FILE");
    command.add_option("--threads", options->orient.threads, "Threads to use; 0: one per core")
        ->check(CLI::Range(0, 1024));
    finish_command(command,
                   "  lamella orient model.stl --printer marlin --layer-height 0.2\n"
                   "  lamella orient figure.toml --for area --write 1\n"
                   "  lamella orient bracket.stl --for strength --load 0,0,-1 --picture bracket.png\n"
                   "Supports are estimated by pillars below overhangs; those of the best are planned.");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
