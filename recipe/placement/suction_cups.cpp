// Runs one print check over coarse layers.
#include "recipe/placement/suction_cups.h"

#include <algorithm>

#include "engine/checks/print_check.h"

namespace lamella {

double cup_volume(const FieldPtr& body, double layer_height, double least, const PassControl& control) {
    constexpr double most_layers = 200, most_rows = 200;
    Job job;
    job.part = body;
    job.bounds = body->bounds();
    const dvec3 size = job.bounds.size();
    job.layers = equal_layers(size.z, std::max(layer_height, size.z / most_layers));
    PrintCheckOptions options;
    options.limits.verdicts[static_cast<std::size_t>(Check::cups)] = Severity::warn;
    options.limits.cup = least;
    options.pitch = std::max(std::max(size.x, size.y) / most_rows, 0.02);
    options.max_places = 1;
    PrintCheck check(job, options);
    survey_layers(job, check, control);
    return check.report().results.front().total;
}

}  // namespace lamella
