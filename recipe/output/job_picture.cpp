// Selects the fields and bounds of a job's picture.
#include "recipe/output/job_picture.h"

#include "recipe/build/build_process.h"

namespace lamella {
namespace {

/// The fields and bounds to draw.
struct Scenery {
    FieldPtr part, supports;
    Box bounds;
};

Scenery scenery(const Recipe& recipe, const BuiltJob& built, const std::optional<BuiltSupports>& added) {
    // In-plane offsets have no values from which a picture could be rendered in reasonable time.
    const FieldPtr supports = added ? added->before_offsets : nullptr;
    if (!supports) return {built.designed.part, nullptr, built.designed.bounds};
    // Supports are planned for the part as scaled for the machine.
    return {make_scaled(recipe, built.designed, built.designed.part), supports,
            unite(built.designed.bounds, supports->bounds())};
}

}  // namespace

Picture render_job(const Recipe& recipe, const BuiltJob& built, const std::optional<BuiltSupports>& supports,
                   const PreviewOptions& options) {
    const Scenery drawn = scenery(recipe, built, supports);
    return render_preview(drawn.part, drawn.supports, drawn.bounds, options);
}

std::unique_ptr<const PreviewScene> make_scene(const Recipe& recipe, const BuiltJob& built,
                                               const std::optional<BuiltSupports>& supports,
                                               const SceneOptions& options) {
    const Scenery drawn = scenery(recipe, built, supports);
    return std::make_unique<const PreviewScene>(drawn.part, drawn.supports, drawn.bounds, options);
}

void add_picture(const Recipe& recipe, BuiltJob& built, const std::optional<BuiltSupports>& supports,
                 int threads) {
    built.job.picture = [drawn = scenery(recipe, built, supports), threads](int size) {
        PreviewOptions options;
        options.width = options.height = size;
        options.cut = '-';
        options.threads = threads;
        return render_preview(drawn.part, drawn.supports, drawn.bounds, options);
    };
}

}  // namespace lamella
