// Plates: parts in rows, with a search for the best row length, or nested by their outlines.
#include "engine/layers/plate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "engine/base/error.h"
#include "engine/layers/outline_nesting.h"
#include "engine/layers/plate_outline.h"
#include "engine/runs/row_sets.h"
#include "engine/solids/csg.h"
#include "engine/solids/quarter_turn.h"

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

/// A part's place: turned by right angles, then moved.
struct Standing {
    const PlateItem* item = nullptr;
    int quarters = 0;
    dvec2 by{0};    ///< mm
    Rect covers{};  ///< before it is turned and moved, mm
};

/// Puts parts on one plate, whose bed is that of `first`.
class PlateJob {
  public:
    PlateJob(const Job& first, bool one_by_one) : plate_(first), bed_(first.z0()), one_by_one_(one_by_one) {
        plate_.part = plate_.supports = nullptr;
        plate_.part_tools.clear();
        plate_.support_tools.clear();
        plate_.bounds = {};
        plate_.layers = {};
        plate_.identity.clear();
    }

    void add(const Standing& standing) {
        const Job& job = standing.item->job;
        if (one_by_one_) {
            stacks_.push_back(job.layers);
        } else {
            join_layers(job);
        }
        const dvec3 by(standing.by, bed_ - job.z0());
        const auto placed = [&](const FieldPtr& field) {
            return moved(make_quarter_turn(field, standing.quarters), by);
        };
        parts_.push_back(placed(job.part));
        if (job.supports) supports_.push_back(placed(job.supports));
        const auto add_tools = [&](const std::vector<ToolZone>& zones, const FieldPtr& solid,
                                   std::vector<ToolZone>& all) {
            for (const ToolZone& zone : zones)
                all.push_back({zone.tool, zone.zone ? make_intersection({placed(zone.zone), solid}) : solid});
        };
        add_tools(job.part_tools, parts_.back(), plate_.part_tools);
        if (job.supports) add_tools(job.support_tools, supports_.back(), plate_.support_tools);
        const Rect covers = quarter_turned(standing.covers, standing.quarters);
        plate_.objects.push_back({fmt::format("{}_{}", job.name, parts_.size()),
                                  parts_.back(),
                                  job.supports ? supports_.back() : nullptr,
                                  {covers.lo + standing.by, covers.hi + standing.by}});
        plate_.bounds = unite(plate_.bounds, Box{dvec3(covers.lo, job.bounds.lo.z) + by,
                                                 dvec3(covers.hi, job.bounds.hi.z) + by});
        count(*standing.item);
    }

    Job take() {
        for (const auto& [item, copies] : counts_) {
            if (!plate_.identity.empty()) plate_.identity += "+";
            plate_.identity += item->job.identity;
            if (copies > 1) plate_.identity += "x" + std::to_string(copies);
        }
        // Parts without zones are made by the first tool.
        for (std::vector<ToolZone>* zones : {&plate_.part_tools, &plate_.support_tools}) {
            if (!zones->empty()) zones->insert(zones->begin(), ToolZone{});
        }
        if (one_by_one_) stack_up();
        plate_.part = make_union(std::move(parts_));
        if (!supports_.empty()) plate_.supports = make_union(std::move(supports_));
        return std::move(plate_);
    }

  private:
    /// Gives each part a stack of layers, the lowest first: the print head has to pass those that are done.
    void stack_up() {
        std::vector<std::size_t> order(stacks_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, {}, [&](std::size_t i) { return stacks_[i].total(); });
        std::vector<LayerPlan> stacks;
        std::vector<JobObject> objects;
        for (const std::size_t i : order) {
            stacks.push_back(stacks_[i]);
            objects.push_back(plate_.objects[i]);
        }
        plate_.layers = LayerPlan::stacked(stacks);
        plate_.objects = std::move(objects);
        plate_.identity += "one by one";
    }
    void join_layers(const Job& job) {
        const bool is_higher = job.layers.count() > plate_.layers.count();
        if (!(is_higher ? job : plate_).layers.begins_like((is_higher ? plate_ : job).layers)) {
            throw InputError(fmt::format("{} has layers of {}, {} of {}; on one plate all need the same",
                                         job.name, job.layers.heights_text(), plate_.name,
                                         plate_.layers.heights_text()));
        }
        if (is_higher) plate_.layers = job.layers;
    }
    void count(const PlateItem& item) {
        const auto found = std::ranges::find(counts_, &item, &std::pair<const PlateItem*, int>::first);
        if (found == counts_.end()) {
            counts_.emplace_back(&item, 1);
        } else {
            ++found->second;
        }
    }

    Job plate_;
    double bed_;
    bool one_by_one_;
    std::vector<LayerPlan> stacks_;  // of the parts, where they are printed one by one
    std::vector<FieldPtr> parts_, supports_;
    std::vector<std::pair<const PlateItem*, int>> counts_;
};

Job plate_in_rows(std::span<const PlateItem> items, const Rows& rows, bool one_by_one) {
    PlateJob plate(items.front().job, one_by_one);
    const dvec2 origin = items.front().job.bounds.rect().lo;
    std::size_t next = 0;
    for (const PlateItem& item : items) {
        const Rect rect = item.job.bounds.rect();
        for (int copy = 0; copy < item.copies; ++copy)
            plate.add({&item, 0, origin + rows.places[next++] - rect.lo, rect});
    }
    return plate.take();
}

/// Returns the pixels of a part that have something in them, mm, and one more all about, within its bounds.
Rect covered(const PlateOutline& outline, const Job& job) {
    const RunRows& rows = outline.rows;
    const std::size_t first = rows.line_with_runs(0);
    if (first == rows.lines()) return job.bounds.rect();
    std::size_t last = first;
    for (std::size_t l = first; l < rows.lines(); l = rows.line_with_runs(l + 1)) last = l;
    const Run along = extent_of(rows);
    const double unit = outline.pitch / run_unit;
    const Rect rect{outline.origin + dvec2(along.begin * unit, static_cast<double>(first) * outline.pitch),
                    outline.origin + dvec2(along.end * unit, static_cast<double>(last + 1) * outline.pitch)};
    return intersect(grown(rect, outline.pitch), job.bounds.rect());
}

/// Turned outlines are known to a pixel of `pitch` mm.
void check_sizes(std::span<const PlateItem> items, const PlateOptions& options, double pitch) {
    for (const PlateItem& item : items) {
        const dvec2 size(item.job.bounds.size()), plate = options.machine;
        const bool fits = size.x <= plate.x && size.y <= plate.y;
        if (fits || (options.turns && size.y + pitch <= plate.x && size.x + pitch <= plate.y)) continue;
        throw InputError(
            fmt::format("{} is {:.2f} x {:.2f} mm, but the plate has room for {:.2f} x {:.2f} mm",
                        item.job.name, size.x, size.y, plate.x, plate.y));
    }
}

std::vector<Job> nested_plates(std::span<const PlateItem> items, const PlateOptions& options) {
    constexpr double pixels = 1000;  // along the plate
    // A part as deep as the plate has as many rows as the plate.
    const double rows =
        std::ceil(pixels * options.machine.y / std::max(options.machine.x, options.machine.y));
    const double pitch = options.machine.y / rows;
    check_sizes(items, options, pitch);
    std::vector<PlateOutline> outlines;
    std::vector<Rect> covers;
    std::vector<NestShape> shapes;
    for (const PlateItem& item : items) {
        outlines.push_back(survey_outline(item.job, pitch, options));
        covers.push_back(covered(outlines.back(), item.job));
        NestShape& shape = shapes.emplace_back(NestShape{{}, item.copies});
        for (int quarters = 0; quarters < (options.turns ? 4 : 1); ++quarters) {
            const bool is_upright = quarters % 2 == 0;
            const RunRows& across = is_upright ? outlines.back().columns : outlines.back().rows;
            const double width =
                quarters == 0 ? item.job.bounds.size().x / pitch : static_cast<double>(across.lines());
            shape.turns.push_back({outlines.back().turned(quarters),
                                   static_cast<std::int32_t>(std::ceil(width * run_unit - 1e-6))});
        }
    }
    // What lies between rows may be a pixel nearer than they are.
    constexpr double between_rows = 1.5;
    const auto units = [&](double mm) { return static_cast<std::int32_t>(mm / pitch * run_unit + 1e-6); };
    const std::vector<NestPlace> places = nest_outlines(
        shapes, units(options.machine.x), static_cast<int>(rows), units(options.gap + between_rows * pitch));
    std::vector<PlateJob> plates;
    const dvec2 origin = items.front().job.bounds.rect().lo;
    for (const NestPlace& place : places) {
        while (static_cast<int>(plates.size()) <= place.plate)
            plates.emplace_back(items.front().job, options.one_by_one);
        const PlateOutline& outline = outlines[place.shape];
        const auto quarters = static_cast<int>(place.turn);
        const dvec2 size(static_cast<double>(outline.columns.lines()),
                         static_cast<double>(outline.rows.lines()));
        const Rect whole{outline.origin, outline.origin + size * pitch};
        const dvec2 at = origin + dvec2(place.x, place.y * run_unit) * (pitch / run_unit);
        plates[static_cast<std::size_t>(place.plate)].add(
            {&items[place.shape], quarters, at - quarter_turned(whole, quarters).lo, covers[place.shape]});
    }
    std::vector<Job> jobs;
    for (PlateJob& plate : plates) {
        jobs.push_back(plate.take());
        jobs.back().identity += fmt::format("p{}", jobs.size());
    }
    return jobs;
}

}  // namespace

std::vector<Job> arrange_plates(std::span<const PlateItem> items, const PlateOptions& options) {
    if (items.empty()) throw InputError("a plate needs a part");
    if (items.size() == 1 && items.front().copies == 1) return {items.front().job};
    std::vector<dvec2> sizes;
    for (const PlateItem& item : items)
        sizes.insert(sizes.end(), static_cast<std::size_t>(item.copies), dvec2(item.job.bounds.size()));
    const Rows rows = best_rows(sizes, options.gap, options.machine);
    constexpr double slack = 1 + 1e-9;
    if (rows.size.x <= options.machine.x * slack && rows.size.y <= options.machine.y * slack)
        return {plate_in_rows(items, rows, options.one_by_one)};
    return nested_plates(items, options);
}

}  // namespace lamella
