// `lamella supports`: describes the supports of a part, as statistics or piece by piece.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/prepare_job.h"
#include "app/console/interrupt.h"
#include "app/console/text_output.h"
#include "engine/base/error.h"
#include "recipe/build/json_triple.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

struct SupportsCommand : JobOptions {
    std::string output;
    bool json = false;
};

constexpr const char* reasons[] = {"overhang", "island", "span", "stability"};

Json pieces_json(const SupportPlan& plan) {
    const Scaffold& scaffold = plan.scaffold;
    Json points = Json::array(), bridges = Json::array(), pillars = Json::array(), connectors = Json::array();
    for (std::size_t i = 0; i < scaffold.points.size(); ++i) {
        const SupportPoint& point = scaffold.points[i];
        const bool held = !std::binary_search(scaffold.unheld.begin(), scaffold.unheld.end(), i);
        points.push_back({{"at_mm", json_triple(point.at)},
                          {"reason", reasons[static_cast<std::size_t>(point.reason)]},
                          {"held", held}});
    }
    for (const ScaffoldBar& bar : scaffold.bars) {
        bridges.push_back({{"from_mm", json_triple(bar.a)}, {"to_mm", json_triple(bar.b)}});
    }
    for (const ScaffoldPillar& pillar : scaffold.pillars) {
        pillars.push_back({{"at_mm", {pillar.at.x, pillar.at.y}},
                           {"bottom_mm", pillar.bottom},
                           {"top_mm", pillar.top},
                           {"on", pillar.foot > 0 ? "bed" : "part"}});
    }
    for (const Beam& beam : scaffold.connectors) {
        connectors.push_back({{"from_mm", json_triple(beam.b)},
                              {"from_radius_mm", beam.rb},
                              {"to_mm", json_triple(beam.a)},
                              {"to_radius_mm", beam.ra}});
    }
    return {{"points", std::move(points)},
            {"bridges", std::move(bridges)},
            {"pillars", std::move(pillars)},
            {"connectors", std::move(connectors)}};
}

/// Returns the lengths of the scaffold's pieces, mm.
struct Lengths {
    double bridges = 0, pillars = 0, connectors = 0;
};

Lengths lengths_of(const Scaffold& scaffold) {
    Lengths lengths;
    for (const ScaffoldBar& bar : scaffold.bars) lengths.bridges += glm::distance(bar.a, bar.b);
    for (const ScaffoldPillar& pillar : scaffold.pillars) lengths.pillars += pillar.top - pillar.bottom;
    for (const Beam& beam : scaffold.connectors) lengths.connectors += glm::distance(beam.a, beam.b);
    return lengths;
}

std::string as_json(const BuiltSupports& supports, const Job& job) {
    const OverhangSurvey& survey = supports.plan.survey;
    const Lengths lengths = lengths_of(supports.plan.scaffold);
    Json json{{"identity", job.identity},
              {"bed_mm", job.z0()},
              {"volume_mm3", support_volume(job)},
              {"bridges_length_mm", lengths.bridges},
              {"pillars_length_mm", lengths.pillars},
              {"connectors_length_mm", lengths.connectors},
              {"hanging_length_mm", survey.hanging_length},
              {"own_bridges", survey.own_bridges},
              {"left_out", survey.blocked},
              {"unheld", supports.plan.scaffold.unheld.size()},
              {"topples_at_mm", survey.topples_at ? Json(*survey.topples_at) : Json()}};
    json.update(pieces_json(supports.plan));
    return json.dump(2) + "\n";
}

std::string as_text(const BuiltSupports& supports, const Job& job) {
    const SupportPlan& plan = supports.plan;
    const Lengths lengths = lengths_of(plan.scaffold);
    std::map<SupportReason, std::size_t> counts;
    for (const SupportPoint& point : plan.scaffold.points) ++counts[point.reason];
    std::vector<std::string> parts;
    parts.reserve(counts.size());
    for (const auto& [reason, count] : counts) {
        parts.push_back(fmt::format("{} for {}", count, reasons[static_cast<std::size_t>(reason)]));
    }
    std::string text = "supports  " + supports_text(supports);
    if (!parts.empty()) text += fmt::format("points    {}\n", fmt::join(parts, ", "));
    text += fmt::format("hanging   {:.1f} mm of outline; the part bridges {} gaps by itself\n",
                        plan.survey.hanging_length, plan.survey.own_bridges);
    text += fmt::format("lengths   bridges {:.1f} mm, pillars {:.1f} mm, connectors {:.1f} mm\n",
                        lengths.bridges, lengths.pillars, lengths.connectors);
    return text + fmt::format("material  {:.1f} mm3\n", support_volume(job));
}

void run(const SupportsCommand& options) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    Recipe recipe = options.recipe.read();
    if (recipe.support == SupportKind::none) recipe.support = SupportKind::bridges;
    if (!options.quiet) note_unused(options.recipe, recipe);
    BuiltJob built = build_job(recipe, with_kept_plans(options.quiet));
    recipe.shield.reset();  // not needed here
    const BuiltSupports supports = *finish_with_progress(recipe, built, options, cancel).supports;
    TextOutput out(options.output);
    out.write(options.json ? as_json(supports, built.job) : as_text(supports, built.job));
    out.close();
    const std::size_t unheld = supports.plan.scaffold.unheld.size();
    if (unheld > 0 || supports.plan.survey.topples_at) {
        throw ConstraintError(unheld > 0 ? fmt::format("{} of {} points are not held", unheld,
                                                       supports.plan.scaffold.points.size())
                                         : "the print may topple");
    }
}

}  // namespace

void add_supports_command(CLI::App& root) {
    auto options = std::make_shared<SupportsCommand>();
    CLI::App& command =
        *root.add_subcommand("supports", "Plan the supports of the part: points, bridges, pillars, material");
    options->recipe.add_to(command);
    command.add_flag("--json", options->json, "Write every piece as JSON");
    command.add_option("-o,--output", options->output, "File; default: standard output")->type_name("FILE");
    command
        .add_option("--plans", options->plans,
                    "Folder in which plans are kept for later runs of the same job, \"\" for none; default: "
                    "lamella/plans in the user's cache")
        ->type_name("DIR");
    command.add_option("--threads", options->threads, "Threads to use; 0: one per core")
        ->check(CLI::Range(0, 1024));
    command.add_flag("-q,--quiet", options->quiet, "No progress on standard error");
    finish_command(command,
                   "  lamella supports model.stl --printer marlin --layer-height 0.2\n"
                   "  lamella supports figure.toml --support pillars --json -o supports.json\n"
                   "Exit code 1 when a point cannot be held or the print would topple.");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
