// Recipes of any bytes through the C interface: read, built, and cut once. What a recipe asks for is kept
// small: the part is a ball of 2 mm, and no files are asked for.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lamella.h"

namespace {

bool asks_for_much(std::string_view text) {
    for (const char* word :
         {"file", "mesh", "image", "law", "table", "tests", "profile", "copies", "scale", "element "}) {
        if (text.find(word) != std::string_view::npos) return true;
    }
    return false;
}

/// What bounds the work, besides the part: the keys of a foam depend on its kind, and without a foam there
/// are none.
std::vector<std::pair<const char*, const char*>> bounds_for(std::string_view text) {
    std::vector<std::pair<const char*, const char*>> keys{
        {"part.shape", "sphere"}, {"part.radius", "2"}, {"layers.height", "0.5"}};
    if (text.find("optimize") != std::string_view::npos) {
        keys.emplace_back("optimize.elements", "8");
        keys.emplace_back("optimize.iterations", "2");
    }
    if (text.find("foam") == std::string_view::npos) return keys;
    keys.emplace_back("foam.cell_min", "1");
    bool is_surface = false;
    for (const char* kind : {"gyroid", "schwarz", "neovius"})
        is_surface = is_surface || text.find(kind) != std::string_view::npos;
    keys.emplace_back(is_surface ? "foam.wall_min" : "foam.beam_min", is_surface ? "0.2" : "0.05");
    return keys;
}

/// Contours have finite points, and runs are in order.
void cut(lamella_context* context, lamella_section* section) {
    lamella_contours* contours = nullptr;
    lamella_contours_view outline{};
    outline.struct_size = sizeof outline;
    if (lamella_section_contours(context, section, LAMELLA_PART | LAMELLA_SUPPORTS, 0.1, &contours) ==
            LAMELLA_OK &&
        lamella_contours_view_get(context, contours, &outline) == LAMELLA_OK) {
        for (std::size_t i = 0; i < 2 * outline.first[outline.count]; ++i) {
            if (!std::isfinite(outline.points[i])) std::abort();
        }
    }
    lamella_contours_destroy(contours);
    lamella_raster raster{};
    raster.struct_size = sizeof raster;
    raster.columns = raster.rows = 20;
    raster.lines = 2;
    raster.x = raster.y = -2.5;
    raster.pitch_x = raster.pitch_y = 0.25;
    lamella_runs* runs = nullptr;
    lamella_runs_view view{};
    view.struct_size = sizeof view;
    if (lamella_section_runs(context, section, LAMELLA_PART | LAMELLA_SUPPORTS, &raster, &runs) ==
            LAMELLA_OK &&
        lamella_runs_view_get(context, runs, &view) == LAMELLA_OK) {
        for (std::size_t line = 0; line < view.line_count; ++line) {
            std::int32_t last = -1;
            for (std::size_t end = 2 * view.first[line]; end < 2 * view.first[line + 1]; ++end) {
                if (view.ends[end] <= last) std::abort();
                last = view.ends[end];
            }
        }
    }
    lamella_runs_destroy(runs);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const char* text = reinterpret_cast<const char*>(data);
    lamella_context* context = nullptr;
    lamella_recipe* recipe = nullptr;
    lamella_job* job = nullptr;
    lamella_section* section = nullptr;
    if (lamella_context_create(LAMELLA_ABI_VERSION, &context) != LAMELLA_OK) return 0;
    lamella_recipe_create(context, &recipe);
    const bool is_toml = lamella_recipe_add_text(context, recipe, text, size, "fuzz.toml") == LAMELLA_OK;
    if (is_toml && !asks_for_much({text, size})) {
        for (const auto& [key, value] : bounds_for({text, size}))
            lamella_recipe_set(context, recipe, key, value);
        if (lamella_job_build(context, recipe, nullptr, &job) == LAMELLA_OK &&
            lamella_section_open(context, job, 0.1, &section) == LAMELLA_OK) {
            cut(context, section);
        }
    }
    lamella_error error{};
    error.struct_size = sizeof error;
    lamella_last_error(context, &error);
    lamella_section_destroy(section);
    lamella_job_destroy(job);
    lamella_recipe_destroy(recipe);
    lamella_context_destroy(context);
    return 0;
}
