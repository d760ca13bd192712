// Picks one of the plates.
#include "recipe/output/plated_job.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "printers/registry.h"

namespace lamella {

PlatedJob put_on_plates(const Recipe& recipe, std::span<const PlateItem> items, const PassControl& control) {
    PlateOptions options;
    options.threads = control.threads;
    options.cancel = control.cancel;
    options.gap = recipe.plate.gap;
    options.machine = dvec2(build_volume_limits(recipe.printer, items.front().job.layers.height(0)));
    options.turns = recipe.plate.turn;
    std::vector<Job> plates = arrange_plates(items, options);
    const auto count = static_cast<int>(plates.size());
    if (recipe.plate.number > count) {
        throw InputError(
            fmt::format("plate.number / --plate: {}, but the parts need {} plate{}; accepted: 1 to {}",
                        recipe.plate.number, count, count == 1 ? "" : "s", count));
    }
    return {std::move(plates[static_cast<std::size_t>(recipe.plate.number - 1)]), count};
}

}  // namespace lamella
