// Recipes of any bytes through the C interface: read, built, and cut once. What a recipe asks for is kept
// small: the part is a ball of 2 mm, and neither surveys nor files are asked for.
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include "bindings/lamella.h"

namespace {

bool asks_for_much(std::string_view text) {
    for (const char* word :
         {"islands", "drain", "dowel", "cavity", "shield", "support", "repair", "file", "mesh", "image",
          "law", "table", "tests", "profile", "copies", "scale", "modulus"}) {
        if (text.find(word) != std::string_view::npos) return true;
    }
    return false;
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
        for (const auto& [key, value] : {std::pair{"part.shape", "sphere"},
                                         {"part.radius", "2"},
                                         {"layers.height", "0.5"},
                                         {"foam.cell_min", "0.5"},
                                         {"foam.wall_min", "0.2"},
                                         {"foam.beam_min", "0.05"}})
            lamella_recipe_set(context, recipe, key, value);
        if (lamella_job_build(context, recipe, nullptr, &job) == LAMELLA_OK &&
            lamella_section_open(context, job, 0.1, &section) == LAMELLA_OK) {
            lamella_contours* contours = nullptr;
            lamella_section_contours(context, section, LAMELLA_PART, 0.1, &contours);
            lamella_contours_destroy(contours);
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
