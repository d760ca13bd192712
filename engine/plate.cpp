// Rows of parts.
#include "engine/plate.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/csg.h"
#include "engine/error.h"
#include "engine/number_format.h"

namespace lamella {
namespace {

FieldPtr moved(const FieldPtr& field, dvec3 by) {
    return by == dvec3(0) ? field : make_transform(field, glm::dmat3(1), by);
}

/// Length of rows that makes the plate about square, at least that of the longest part.
double row_length(std::span<const PlateItem> items, double gap, double width) {
    double area = 0, longest = 0;
    for (const PlateItem& item : items) {
        const dvec3 size = item.job.bounds.size();
        area += item.copies * (size.x + gap) * (size.y + gap);
        longest = std::max(longest, size.x);
    }
    return std::max(longest, std::min(std::sqrt(area), width));
}

}  // namespace

Job arrange_plate(std::span<const PlateItem> items, double gap, double width) {
    if (items.empty()) throw InputError("a plate needs a part");
    Job plate = items.front().job;
    if (items.size() == 1 && items.front().copies == 1) return plate;
    const dvec3 origin = plate.bounds.lo;
    const double length = row_length(items, gap, width);
    std::vector<FieldPtr> parts, supports;
    double x = 0, y = 0, row_depth = 0;
    for (const PlateItem& item : items) {
        const Job& job = item.job;
        if (job.layer_height != plate.layer_height) {
            throw InputError(job.name + " has layers of " + format_number(job.layer_height, 6) + " mm, " +
                             plate.name + " of " + format_number(plate.layer_height, 6) +
                             " mm; on one plate all need the same");
        }
        const dvec3 size = job.bounds.size();
        // Rounding must not end a row that is as long as its parts.
        constexpr double slack = 1e-9;
        for (int copy = 0; copy < item.copies; ++copy) {
            if (x > 0 && x + size.x > length * (1 + slack)) {
                x = 0;
                y += row_depth + gap;
                row_depth = 0;
            }
            const dvec3 place = origin + dvec3(x, y, 0);
            const dvec3 by = place - job.bounds.lo;
            parts.push_back(moved(job.part, by));
            if (job.supports) supports.push_back(moved(job.supports, by));
            plate.bounds = unite(plate.bounds, Box{place, place + size});
            x += size.x + gap;
            row_depth = std::max(row_depth, size.y);
        }
        plate.layer_count = std::max(plate.layer_count, job.layer_count);
        if (&item != items.data()) plate.identity += "+" + job.identity;
        if (item.copies > 1) plate.identity += "x" + std::to_string(item.copies);
    }
    plate.part = make_union(std::move(parts));
    plate.supports = supports.empty() ? nullptr : make_union(std::move(supports));
    return plate;
}

}  // namespace lamella
