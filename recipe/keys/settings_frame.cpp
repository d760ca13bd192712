// The rows of the settings table about the frame under the surface.
#include "recipe/keys/settings_rows.h"

namespace lamella {
namespace {

constexpr Limits radii{0.005, 500};

template <auto member>
void add_frame_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    t.push_back(optional_row<&Recipe::frame, member>("frame", key, flag, std::move(facts)));
}

}  // namespace

void add_frame_settings(std::vector<Setting>& table) {
    add_frame_row<&FrameRecipe::beam>(
        table, "beam", "--frame",
        {.unit = "mm",
         .limits = radii,
         .fallback = "required in [frame]",
         .help = "Radius of the frame's beams; the foam's radius where that is larger."});
    add_frame_row<&FrameRecipe::beam_min>(
        table, "beam_min", "--frame-min",
        {.unit = "mm",
         .limits = radii,
         .fallback = "0.005",
         .help = "Smallest radius: graded beams of the frame are clamped to it."});
    add_frame_row<&FrameRecipe::beam_max>(
        table, "beam_max", "--frame-max",
        {.unit = "mm",
         .limits = radii,
         .fallback = "500",
         .help = "Largest radius: graded beams of the frame are clamped to it."});
    add_frame_row<&FrameRecipe::interior>(
        table, "interior", "--frame-interior",
        {.fallback = "true", .help = "Make the foam inside as well; false: the frame alone."});
}

}  // namespace lamella
