// `lamella info`: what a recipe will make, before it is made.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/build_job.h"
#include "app/commands.h"
#include "app/memory_bound.h"
#include "app/recipe_options.h"
#include "app/text_output.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
    RecipeOptions recipe;
    bool json = false;
    int threads = 0;
};

Json triple(dvec3 v) { return Json::array({v.x, v.y, v.z}); }

Json mesh_json(const MeshReport& mesh) {
    return {{"path", mesh.path},
            {"vertices", mesh.vertices},
            {"triangles", mesh.triangles},
            {"caps", mesh.caps},
            {"oriented_manifold", mesh.oriented_manifold},
            {"volume_mm3", mesh.volume},
            {"notes", mesh.notes}};
}

Json foam_json(const FoamRecipe& recipe, const VoronoiFoam& foam, const Box& bounds) {
    const dvec3 size = bounds.size();
    const double seeds = size.x * size.y * size.z / cell_volume(recipe.cell);
    return {{"cell_mm", recipe.cell},
            {"beam_mm", recipe.beam},
            {"seed", recipe.seed},
            {"expected_seeds_in_bounds", std::floor(seeds + 0.5)},
            {"expected_volume_fraction", foam.expected_volume_fraction(bounds.center())}};
}

Json memory_json(const MemoryBound& bound) {
    return {{"bytes", bound.total()},
            {"layers_in_flight", bound.layers_in_flight},
            {"beams_per_layer", bound.beams_per_layer},
            {"layer_bytes", bound.layer_bytes},
            {"cell_cache_bytes", bound.cell_bytes},
            {"mesh_bytes", bound.mesh_bytes},
            {"base_bytes", bound.base_bytes}};
}

Json describe(const Recipe& recipe, const BuiltJob& built, int threads) {
    const Job& job = built.job;
    Json info{{"name", job.name},
              {"identity", job.identity},
              {"bounds_mm", {{"lo", triple(job.bounds.lo)}, {"hi", triple(job.bounds.hi)}}},
              {"size_mm", triple(job.bounds.size())},
              {"layer_height_mm", job.layer_height},
              {"layers", job.layer_count}};
    if (built.mesh) info["mesh"] = mesh_json(*built.mesh);
    if (built.foam) info["foam"] = foam_json(*recipe.foam, *built.foam, job.bounds);
    if (recipe.skin) info["skin"] = {{"thickness_mm", recipe.skin->thickness}};
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

double mebibytes(const Json& bytes) { return bytes.get<double>() / (1 << 20); }

std::string memory_text(const Json& m) {
    return fmt::format(
        "memory    about {:.0f} MiB: {:.0f} for the program, {:.1f} for the mesh, {:.1f} for foam cells in "
        "reach,\n"
        "          and {} layers in flight of {:.1f} each (rows of the plate, {:.0f} beams)\n",
        mebibytes(m["bytes"]), mebibytes(m["base_bytes"]), mebibytes(m["mesh_bytes"]),
        mebibytes(m["cell_cache_bytes"]), m["layers_in_flight"].get<int>(), mebibytes(m["layer_bytes"]),
        m["beams_per_layer"].get<double>());
}

std::string as_text(const Json& info) {
    std::string text =
        fmt::format("part      {}, {}\n", info["name"].get<std::string>(), size_text(info["size_mm"]));
    text += fmt::format("bounds    {} to {}\n", point_text(info["bounds_mm"]["lo"]),
                        point_text(info["bounds_mm"]["hi"]));
    text += fmt::format("layers    {} of {} mm\n", info["layers"].get<int>(),
                        info["layer_height_mm"].get<double>());
    if (info.contains("mesh")) text += mesh_text(info["mesh"]);
    if (info.contains("foam")) {
        const Json& foam = info["foam"];
        text += fmt::format(
            "foam      cells of {} mm, beams of radius {} mm, seed {}: about {:.0f} seeds in the bounds, "
            "{:.1f} % solid\n",
            foam["cell_mm"].get<double>(), foam["beam_mm"].get<double>(), foam["seed"].get<std::int64_t>(),
            foam["expected_seeds_in_bounds"].get<double>(),
            100 * foam["expected_volume_fraction"].get<double>());
    }
    if (info.contains("skin"))
        text += fmt::format("skin      {} mm\n", info["skin"]["thickness_mm"].get<double>());
    text += fmt::format("printer   {} ({})\n", info["printer"]["profile"].get<std::string>(),
                        info["printer"]["kind"].get<std::string>());
    return text + memory_text(info["memory"]) + "identity  " + info["identity"].get<std::string>() + "\n";
}

void run(const InfoOptions& options) {
    const Recipe recipe = options.recipe.read();
    const BuiltJob built = build_job(recipe);
    const Json info = describe(recipe, built, options.threads);
    TextOutput out("");
    out.write(options.json ? info.dump(2) + "\n" : as_text(info));
    out.close();
}

}  // namespace

void add_info_command(CLI::App& root) {
    auto options = std::make_shared<InfoOptions>();
    CLI::App& command =
        *root.add_subcommand("info", "Say what a recipe will make: size, layers, foam, mesh, memory");
    options->recipe.add_to(command);
    command.add_flag("--json", options->json, "As JSON");
    command.add_option("--threads", options->threads, "Threads the memory is reckoned for; 0: one a core")
        ->check(CLI::Range(0, 1024));
    finish_command(command,
                   "  lamella info insole.toml\n  lamella info model.stl --cell 3 --beam 0.5 --json");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
