// Plates: parts in rows, with a search for the best row length.
#include "engine/layers/plate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/error.h"
#include "engine/solids/csg.h"

namespace lamella {
namespace {

FieldPtr moved(const FieldPtr& field, dvec3 by) {
    return by == dvec3(0) ? field : make_transform(field, glm::dmat3(1), by);
}

/// The positions of parts, from the lower left, and the size of the arrangement.
struct Rows {
    std::vector<dvec2> places;
    dvec2 size{0};
};

Rows in_rows(const std::vector<dvec2>& sizes, double gap, double length) {
    // Rounding must not break a row that is exactly as long as its parts.
    constexpr double slack = 1e-9;
    Rows rows;
    dvec2 at{0};
    double depth = 0;
    for (const dvec2 size : sizes) {
        if (at.x > 0 && at.x + size.x > length * (1 + slack)) {
            at = {0, at.y + depth + gap};
            depth = 0;
        }
        rows.places.push_back(at);
        rows.size = glm::max(rows.size, at + size);
        depth = std::max(depth, size.y);
        at.x += size.x + gap;
    }
    return rows;
}

/// Returns the rows that take up the least share of the machine's plate, or the squarest if it is infinite.
Rows best_rows(const std::vector<dvec2>& sizes, double gap, dvec2 machine) {
    double longest = 0, all = 0;
    for (const dvec2 size : sizes) {
        longest = std::max(longest, size.x);
        all += size.x + gap;
    }
    const dvec2 whole(std::isfinite(machine.x) ? machine.x : 1, std::isfinite(machine.y) ? machine.y : 1);
    constexpr int tries = 64;
    Rows best;
    double least = infinity;
    for (int k = 0; k <= tries; ++k) {
        Rows rows = in_rows(sizes, gap, longest + (all - longest) * k / tries);
        const double share = std::max(rows.size.x / whole.x, rows.size.y / whole.y);
        if (share < least) {
            least = share;
            best = std::move(rows);
        }
    }
    return best;
}

}  // namespace

Job arrange_plate(std::span<const PlateItem> items, double gap, dvec2 machine) {
    if (items.empty()) throw InputError("a plate needs a part");
    Job plate = items.front().job;
    if (items.size() == 1 && items.front().copies == 1) return plate;
    std::vector<dvec2> sizes;
    for (const PlateItem& item : items) {
        sizes.insert(sizes.end(), static_cast<std::size_t>(item.copies), dvec2(item.job.bounds.size()));
    }
    const Rows rows = best_rows(sizes, gap, machine);
    const dvec3 origin = plate.bounds.lo;
    std::vector<FieldPtr> parts, supports;
    for (const PlateItem& item : items) {
        const Job& job = item.job;
        const bool is_higher = job.layers.count() > plate.layers.count();
        if (!(is_higher ? job : plate).layers.begins_like((is_higher ? plate : job).layers)) {
            throw InputError(fmt::format("{} has layers of {}, {} of {}; on one plate all need the same",
                                         job.name, job.layers.heights_text(), plate.name,
                                         plate.layers.heights_text()));
        }
        for (int copy = 0; copy < item.copies; ++copy) {
            const dvec3 place = origin + dvec3(rows.places[parts.size()], 0);
            const dvec3 by = place - job.bounds.lo;
            parts.push_back(moved(job.part, by));
            if (job.supports) supports.push_back(moved(job.supports, by));
            plate.bounds = unite(plate.bounds, Box{place, place + job.bounds.size()});
        }
        if (is_higher) plate.layers = job.layers;
        if (&item != items.data()) plate.identity += "+" + job.identity;
        if (item.copies > 1) plate.identity += "x" + std::to_string(item.copies);
    }
    plate.part = make_union(std::move(parts));
    plate.supports = supports.empty() ? nullptr : make_union(std::move(supports));
    return plate;
}

}  // namespace lamella
