// `lamella info`: describes the job of a recipe before it is made, or a finished job file.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.h"
#include "app/commands/prepare_job.h"
#include "app/commands/recipe_options.h"
#include "app/console/text_output.h"
#include "app/reports/element_report.h"
#include "app/reports/foam_statistics.h"
#include "app/reports/grading_report.h"
#include "app/reports/island_report.h"
#include "app/reports/job_report.h"
#include "app/reports/memory_bound.h"
#include "engine/base/text.h"
#include "printers/common/layer_heights.h"
#include "printers/readers/read_job.h"
#include "recipe/build/build_job.h"
#include "recipe/build/json_triple.h"
#include "recipe/build/support_plan.h"
#include "recipe/keys/settings_rows.h"
#include "recipe/recipe_regions.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
    RecipeOptions recipe;
    bool json = false;
    bool islands = false;
    int threads = 0;
};

Json mesh_json(const MeshReport& mesh) {
    return {{"path", mesh.path},
            {"vertices", mesh.vertices},
            {"triangles", mesh.triangles},
            {"caps", mesh.caps},
            {"oriented_manifold", mesh.oriented_manifold},
            {"volume_mm3", mesh.volume},
            {"notes", mesh.notes}};
}

/// Returns a number, or the formula that gives it.
Json graded_json(const GradedNumber& number) {
    return number.is_formula() ? Json(number.formula()) : Json(number.number());
}

Json foam_json(const FoamRecipe& recipe, const BuiltFoam& foam, const Box& bounds) {
    const FoamStatistics sums = foam_statistics(foam, bounds);
    const FoamBuilder& kind = builder_of(recipe);
    Json json{{"kind", recipe.kind}};
    const auto add = [&](const char* key, const GradedNumber& number) {
        if (number.is_formula() || number.number() > 0) json[key] = graded_json(number);
    };
    add("cell_mm", recipe.cell);
    add("beam_mm", recipe.beam);
    add("wall_mm", recipe.wall);
    add("modulus_MPa", recipe.modulus);
    if (kind.takes("window")) json["window"] = graded_json(recipe.window);
    if (kind.takes("neighbours")) json["neighbours"] = recipe.neighbours;
    if (foam.seeds_in) {
        json["seed"] = recipe.seed;
        json["expected_seeds_in_bounds"] = std::floor(sums.seeds + 0.5);
    }
    if (!std::isnan(sums.volume_fraction)) json["expected_volume_fraction"] = sums.volume_fraction;
    return json;
}

Json skin_json(const SkinRecipe& recipe, const BuiltJob& built) {
    Json json{{"thickness_mm", graded_json(recipe.thickness)}};
    if (built.pattern) {
        json["pattern"] = built.pattern->pattern;
        json["strut_mm"] = graded_json(recipe.strut);
        if (built.pattern->windows > 0) {
            json["windows"] = built.pattern->windows - built.pattern->closed;
            json["too_small_for_a_window"] = built.pattern->closed;
        } else {
            json["open_share"] = built.pattern->open_share;
            if (built.pattern->pieces > 0) {
                json["picture_open_share"] = built.pattern->picture_share;
                json["pieces"] = built.pattern->pieces;
                json["joins"] = built.pattern->joins;
                json["bridges"] = built.pattern->bridges;
                json["cut_struts"] = built.pattern->cut_struts;
                json["hanging"] = built.pattern->hanging;
                json["detours"] = built.pattern->detours;
                if (built.pattern->softness > 0) {
                    json["softness_before"] = built.pattern->softness_before;
                    json["softness"] = built.pattern->softness;
                }
                json["too_small_to_keep"] = built.pattern->dropped;
                json["site_mm"] = built.pattern->site;
                json["bytes"] = built.pattern->bytes;
            } else if (!built.elements) {
                json["islands_left_out"] = built.pattern->islands;
            }
        }
    }
    auto holes = Json::array();
    for (const DrilledHole& hole : built.holes) {
        holes.push_back({{"from_mm", json_triple(hole.from)},
                         {"to_mm", json_triple(hole.to)},
                         {"radius_mm", hole.radius}});
    }
    if (!holes.empty()) json["holes"] = std::move(holes);
    return json;
}

Json grading_json(const GradingReport& report) {
    const std::string unit = report.unit.empty() ? "" : "_" + report.unit;
    Json json{{"key", report.key},
              {"limits" + unit, {report.limits.lo, report.limits.hi}},
              {"clamped_share", report.clamped},
              {"undefined_share", report.undefined},
              {"steepest_cell_ratio", report.steepest},
              {"warnings", warnings(report)}};
    if (!report.asked.empty()) json["asked" + unit] = {report.asked.lo, report.asked.hi};
    return json;
}

Json regions_json(const Recipe& recipe, const BuiltRegions& regions) {
    Json json = Json::array();
    for (std::size_t i = 0; i < regions.list.size(); ++i) {
        const RegionRecipe& region = recipe.regions[i];
        json.push_back({{"field", region.field},
                        {"make", choice_names(region.make)[static_cast<std::size_t>(region.make)]},
                        {"blend_mm", region.blend}});
        for (const RegionNumber& given : numbers_of(region))
            json.back()[given.key] = graded_json(*given.number);
        if (region.layer_height > 0) json.back()["layer_height_mm"] = region.layer_height;
    }
    return json;
}

Json memory_json(const MemoryBound& bound) {
    return {{"bytes", bound.total()},
            {"layers_in_flight", bound.layers_in_flight},
            {"beams_per_layer", bound.beams_per_layer},
            {"layer_bytes", bound.layer_bytes},
            {"cell_cache_bytes", bound.cell_bytes},
            {"mesh_bytes", bound.mesh_bytes},
            {"picture_bytes", bound.picture_bytes},
            {"base_bytes", bound.base_bytes}};
}

Json describe(const Recipe& recipe, const BuiltJob& built, int threads) {
    const Job& job = built.job;
    Json info{{"name", job.name},
              {"identity", job.identity},
              {"bounds_mm", {{"lo", json_triple(job.bounds.lo)}, {"hi", json_triple(job.bounds.hi)}}},
              {"size_mm", json_triple(job.bounds.size())},
              {"layer_height_mm", layer_heights_json(job.layers)},
              {"layers", job.layers.count()}};
    if (built.layers.cusp) info["cusp_mm"] = *built.layers.cusp;
    if (built.mesh) info["mesh"] = mesh_json(*built.mesh);
    if (built.foam) info["foam"] = foam_json(*recipe.foam, *built.foam, built.designed.bounds);
    if (built.elements) info["elements"] = elements_json(*built.elements);
    if (recipe.skin) info["skin"] = skin_json(*recipe.skin, built);
    if (built.drains) info["drains"] = drains_json(*built.drains);
    if (built.cavities) info["cavities"] = cavities_json(*built.cavities);
    if (!built.regions.list.empty()) info["regions"] = regions_json(recipe, built.regions);
    if (!built.regions.warnings.empty()) info["region_warnings"] = built.regions.warnings;
    for (const GradingReport& report : grading_reports(built)) info["graded"].push_back(grading_json(report));
    if (built.modulus) info["modulus"] = modulus_json(*built.modulus);
    if (built.islands) info["islands"] = islands_json(*built.islands);
    info["printer"] = {{"profile", recipe.printer.name}, {"kind", recipe.printer.backend}};
    info["memory"] = memory_json(memory_bound(recipe, built, threads));
    return info;
}

std::string size_text(const Json& v) {
    return fmt::format("{:.3f} x {:.3f} x {:.3f} mm", v[0].get<double>(), v[1].get<double>(),
                       v[2].get<double>());
}

std::string point_text(const Json& v) {
    return fmt::format("({}, {}, {})", v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
}

std::string mesh_text(const Json& mesh) {
    std::string text = fmt::format("mesh      {} triangles, {} vertices, {:.1f} mm3{}\n",
                                   mesh["triangles"].get<std::size_t>(), mesh["vertices"].get<std::size_t>(),
                                   mesh["volume_mm3"].get<double>(),
                                   mesh["oriented_manifold"].get<bool>() ? "" : ", not an oriented manifold");
    if (mesh["caps"].get<std::size_t>() > 0) {
        text += fmt::format("          {} triangles added to close holes\n", mesh["caps"].get<std::size_t>());
    }
    for (const auto& note : mesh["notes"]) text += "          " + note.get<std::string>() + "\n";
    return text;
}

/// Returns "cells of 2 mm" or "cells of `1 + d` mm".
std::string graded_text(const Json& number) {
    return number.is_string() ? "`" + number.get<std::string>() + "`"
                              : fmt::format("{}", number.get<double>());
}

std::string foam_text(const Json& foam) {
    std::string text = fmt::format("foam      {}: ", foam["kind"].get<std::string>());
    text += foam.contains("cell_mm") ? "cells of " + graded_text(foam["cell_mm"]) + " mm" : "cells that suit";
    if (foam.contains("modulus_MPa")) text += ", a modulus of " + graded_text(foam["modulus_MPa"]) + " MPa";
    if (foam.contains("beam_mm")) text += ", beams of radius " + graded_text(foam["beam_mm"]) + " mm";
    if (foam.contains("wall_mm")) text += ", walls of " + graded_text(foam["wall_mm"]) + " mm";
    if (foam.contains("window")) text += ", windows " + graded_text(foam["window"]);
    if (foam.contains("neighbours")) {
        text += fmt::format(", {} neighbours", foam["neighbours"].get<std::int64_t>());
    }
    if (foam.contains("seed")) {
        text += fmt::format(", seed {}: about {:.0f} seeds in the bounds", foam["seed"].get<std::int64_t>(),
                            foam["expected_seeds_in_bounds"].get<double>());
    }
    if (foam.contains("expected_volume_fraction")) {
        text += fmt::format(", {:.1f} % solid", 100 * foam["expected_volume_fraction"].get<double>());
    }
    return text + "\n";
}

std::string grading_text(const Json& grading) {
    std::string text;
    for (const std::string unit : {"", "mm"}) {
        const std::string asked = unit.empty() ? "asked" : "asked_" + unit;
        if (!grading.contains(asked)) continue;
        text += fmt::format("graded    {} from {:.4g} to {:.4g}{}\n", grading["key"].get<std::string>(),
                            grading[asked][0].get<double>(), grading[asked][1].get<double>(),
                            unit.empty() ? "" : " " + unit);
    }
    for (const auto& warning : grading["warnings"]) text += "          " + warning.get<std::string>() + "\n";
    return text;
}

std::string region_text(const Json& region) {
    const std::string make = region["make"].get<std::string>();
    std::string text = fmt::format("region    `{}` {} {}", region["field"].get<std::string>(),
                                   make == "layers" ? "has" : "is", make);
    if (region.contains("layer_height_mm")) {
        text += fmt::format("{} {} mm", make == "layers" ? " of" : ", in layers of",
                            region["layer_height_mm"].get<double>());
    }
    for (const auto& [key, number] : region.items()) {
        if (key.find('.') != std::string::npos) text += fmt::format(", {} {}", key, graded_text(number));
    }
    const double blend = region["blend_mm"].get<double>();
    return text + (blend > 0 ? fmt::format(", blended over {} mm\n", blend) : "\n");
}

double mebibytes(const Json& bytes) { return bytes.get<double>() / (1 << 20); }

std::string memory_text(const Json& m) {
    return fmt::format(
        "memory    about {:.0f} MiB: {:.0f} for the program, {:.1f} for the mesh, {:.1f} for the picture,\n"
        "          {:.1f} for foam cells in reach, and {} layers in flight of {:.1f} each (rows of the "
        "plate, {:.0f} beams)\n",
        mebibytes(m["bytes"]), mebibytes(m["base_bytes"]), mebibytes(m["mesh_bytes"]),
        mebibytes(m["picture_bytes"]), mebibytes(m["cell_cache_bytes"]), m["layers_in_flight"].get<int>(),
        mebibytes(m["layer_bytes"]), m["beams_per_layer"].get<double>());
}

/// Says how a pattern by example hangs together.
std::string bridges_text(const Json& skin) {
    const auto count = [&](const char* key) { return skin[key].get<std::size_t>(); };
    std::string text =
        fmt::format("{}, joined by {}, and {} too small to keep", counted(count("pieces"), "piece"),
                    counted(count("joins"), "bridge"), count("too_small_to_keep"));
    if (count("bridges") > 0) text += "; sounder by " + counted(count("bridges"), "bridge");
    if (count("cut_struts") > 0)
        text +=
            fmt::format("; parts that hang on one strut alone, at {}", counted(count("cut_struts"), "place"));
    if (count("hanging") > 0) text += "; begins in the air at " + counted(count("hanging"), "place");
    if (count("detours") > 0) text += fmt::format("; a long way round {}", counted(count("detours"), "gap"));
    if (skin.contains("softness"))
        text += fmt::format("; {:.3g} times as soft as the closed skin, {:.3g} times by shape alone",
                            skin["softness"].get<double>(), skin["softness_before"].get<double>());
    return text;
}

std::string skin_text(const Json& skin) {
    std::string text = fmt::format("skin      {} mm", graded_text(skin["thickness_mm"]));
    if (skin.contains("windows")) {
        text += fmt::format(", {} windows ({}), {} cells too small for one",
                            skin["windows"].get<std::size_t>(), skin["pattern"].get<std::string>(),
                            skin["too_small_for_a_window"].get<std::size_t>());
    } else if (skin.contains("pieces")) {
        text += fmt::format(", {:.1f} % open (its picture {:.1f} %), computed every {:.3g} mm, {:.1f} MB; ",
                            100 * skin["open_share"].get<double>(),
                            100 * skin["picture_open_share"].get<double>(), skin["site_mm"].get<double>(),
                            skin["bytes"].get<double>() / 1e6);
        text += bridges_text(skin);
        constexpr double much = 0.05;
        if (skin["picture_open_share"].get<double>() - skin["open_share"].get<double>() > much)
            text += "; more solid than its picture: a larger image_size or a narrower strut keeps more gaps";
    } else if (skin.contains("islands_left_out")) {
        text +=
            fmt::format(", windows of a picture, {:.1f} % open, {} islands a tile left out",
                        100 * skin["open_share"].get<double>(), skin["islands_left_out"].get<std::size_t>());
    }
    if (skin.contains("pattern") && skin["pattern"] == "elements")
        text += fmt::format(" of elements, {:.1f} % open", 100 * skin["open_share"].get<double>());
    if (skin.contains("holes")) text += fmt::format(", {} drilled", skin["holes"].size());
    return text + "\n";
}

std::string as_text(const Json& info, const BuiltJob& built) {
    const std::optional<IslandReport>& islands = built.islands;
    const std::optional<DrainReport>& drains = built.drains;
    std::string text =
        fmt::format("part      {}, {}\n", info["name"].get<std::string>(), size_text(info["size_mm"]));
    text += fmt::format("bounds    {} to {}\n", point_text(info["bounds_mm"]["lo"]),
                        point_text(info["bounds_mm"]["hi"]));
    text += fmt::format("layers    {} of {}", info["layers"].get<int>(), built.job.layers.heights_text());
    if (built.layers.cusp) text += fmt::format(", cusps up to {:.3g} mm", *built.layers.cusp);
    text += "\n";
    if (info.contains("mesh")) text += mesh_text(info["mesh"]);
    if (info.contains("foam")) text += foam_text(info["foam"]);
    if (built.elements) text += fmt::format("elements  {}\n", elements_text(*built.elements));
    if (info.contains("skin")) text += skin_text(info["skin"]);
    if (drains) text += fmt::format("drains    {}\n", drains_text(*drains));
    if (built.cavities) text += fmt::format("cavities  {}\n", cavities_text(*built.cavities));
    for (const Json& region : info.value("regions", Json::array())) text += region_text(region);
    for (const Json& warning : info.value("region_warnings", Json::array())) {
        text += "          " + warning.get<std::string>() + "\n";
    }
    if (info.contains("graded")) {
        for (const Json& grading : info["graded"]) text += grading_text(grading);
    }
    for (const std::string& note : built.job.notes) text += "          " + note + "\n";
    if (islands)
        text += fmt::format("islands   {}; the part has {:.1f} mm3\n", islands_text(*islands),
                            islands->part_volume);
    text += fmt::format("printer   {} ({})\n", info["printer"]["profile"].get<std::string>(),
                        info["printer"]["kind"].get<std::string>());
    return text + memory_text(info["memory"]) + "identity  " + info["identity"].get<std::string>() + "\n";
}

/// Facts and areas of a finished job.
void run_job(const InfoOptions& options, const JobFile& job) {
    const AreaSummary areas = measure_areas(job, options.threads, isatty(STDERR_FILENO) == 0);
    TextOutput out("");
    if (options.json) {
        const Json info = job_json(options.recipe.input(), job.facts(), areas);
        out.write(info.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    } else {
        out.write(job_text(job.facts(), areas));
    }
    out.close();
}

void run(const InfoOptions& options) {
    if (!options.recipe.input().empty()) {
        if (const auto job = open_if_job(options.recipe.input())) {
            run_job(options, *job);
            return;
        }
    }
    const Recipe recipe = options.recipe.read();
    note_unused(options.recipe, recipe);
    BuiltJob built = build_job(recipe, with_kept_plans(false));
    if (options.islands) {
        IslandSurveyOptions survey;
        survey.threads = options.threads;
        drop_islands(recipe, built, survey);
    }
    const Json info = describe(recipe, built, options.threads);
    TextOutput out("");
    out.write(options.json ? info.dump(2) + "\n" : as_text(info, built));
    out.close();
}

}  // namespace

void add_info_command(CLI::App& root) {
    auto options = std::make_shared<InfoOptions>();
    CLI::App& command =
        *root.add_subcommand("info",
                             "Describe what a recipe will make: size, layers, foam, mesh, memory; or the "
                             "contents of a finished job of masks");
    options->recipe.add_to(command);
    command.get_option("INPUT")->description(fmt::format(
        "Recipe (.toml), model (.stl, .obj, .ply, .3mf) or finished job ({}, or a folder of masks with a "
        "job.json)",
        fmt::join(job_endings(), ", ")));
    command.add_flag("--json", options->json, "As JSON");
    command.add_flag("--islands", options->islands,
                     "Survey all layers for pieces that are not connected to the part");
    command.add_option("--threads", options->threads, "Threads for the memory estimate; 0: one per core")
        ->check(CLI::Range(0, 1024));
    finish_command(command,
                   "  lamella info insole.toml\n"
                   "  lamella info model.stl --cell 3 --beam 0.5 --json\n"
                   "  lamella info insole.sl1");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
