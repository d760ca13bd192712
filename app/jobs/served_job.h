// ServedJob: a job that a server holds, and how it is built from a recipe's text.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/jobs/served_folder.h"
#include "recipe/build/build_job.h"
#include "recipe/build/build_supports.h"
#include "recipe/inputs/input_cache.h"
#include "recipe/output/preview_render.h"

namespace lamella {

/// Voxels along the longest side of the volume that a page asks for first.
inline constexpr int coarse_volume = 64;

/// A built job with its recipe. Immutable, shared by the requests that read its layers.
struct ServedJob {
    std::string id;  ///< in addresses: the identity of the layers and a hash of the recipe's text
    Recipe recipe;
    BuiltJob built;
    std::optional<BuiltSupports> supports;
    int parts = 1;   ///< on the plate
    int plates = 1;  ///< that the parts need

    const Job& job() const { return built.job; }
    /// Returns a scene for pictures of so many pixels a side, which is kept for the next one.
    std::shared_ptr<const PreviewScene> scene(int pixels, int threads) const;
    /// Returns a volume of coverage as coverage_volume() does. A coarse one is kept: each page asks for it
    /// first.
    std::shared_ptr<const std::string> coverage(int longest, const PassControl& control) const;
    /// Name, machine, bounds, layers and notes, as the interface describes a job.
    nlohmann::ordered_json facts() const;

  private:
    mutable std::mutex scene_mutex_;
    mutable std::shared_ptr<const PreviewScene> scene_;
    mutable int scene_pixels_ = 0;
    mutable std::mutex volume_mutex_;
    mutable std::shared_ptr<const std::string> volume_;
    mutable int volume_longest_ = 0;
};

/// How far a build is: what is done, and how many steps of how many.
using BuildProgress = std::function<void(const std::string& what, std::int64_t done, std::int64_t of)>;

struct BuildControl {
    int threads = 0;  ///< 0: one per core
    const CancelToken* cancel = nullptr;
    BuildProgress on_progress{};
    InputCache* inputs = nullptr;  ///< what former builds know of files; may be null
};

/// Builds the job of a recipe's text, whose files lie in the folder, ready to be sliced: with supports,
/// repairs, and all parts on their plate. Throws RecipeMistakes for what is wrong with the recipe,
/// Interrupted when cancelled.
std::shared_ptr<const ServedJob> build_served_job(const std::string& text, const ServedFolder& folder,
                                                  const BuildControl& control);

/// Reads a recipe's text. Throws RecipeMistakes.
Recipe read_served_recipe(const std::string& text, const ServedFolder& folder);

/// Returns the name that messages give the recipe.
std::string served_recipe_name(const ServedFolder& folder);

/// Returns the id that the job of a recipe and its text will have.
std::string served_job_id(const Recipe& recipe, const std::string& text, InputCache* inputs = nullptr);

}  // namespace lamella
