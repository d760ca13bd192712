// Judges by the volume that the back-end reports.
#include "app/reports/empty_job.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/text.h"

namespace lamella {

std::string empty_job_text(const Recipe& recipe, const Job& job, const StreamReport& report) {
    if (report.layers_written < job.layers.count() || report.volume > 0 || report.support_volume > 0)
        return "";
    const dvec3 size = job.bounds.size();
    const std::string found = fmt::format(
        "nothing is printed: the part, {:.4g} x {:.4g} x {:.4g} mm, leaves no trace in {} of {}; "
        "accepted: ",
        size.x, size.y, size.z, counted(static_cast<std::size_t>(job.layers.count()), "layer"),
        job.layers.heights_text());
    constexpr double smallest_likely = 2;  // mm
    if (!recipe.part.mesh.empty() && std::max({size.x, size.y, size.z}) < smallest_likely)
        return found + "--unit m or --unit inch, if the model is in metres or inches; or a larger --scale";
    return found + "a part thicker than half a layer and wider than a pixel or a bead";
}

}  // namespace lamella
