// Picks one of the plates.
#include "recipe/output/plated_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/base/error.h"
#include "printers/registry.h"
#include "printers/toolpath/purge_tower.h"

namespace lamella {

namespace {

/// Returns how much of the plate's depth a purge tower takes where there are several parts, mm. A single part
/// may have it at its side.
double room_for_tower(std::span<const PlateItem> items, const PurgeProfile& purge) {
    if (items.size() == 1 && items.front().copies == 1) return 0;
    std::set<int> tools;
    for (const PlateItem& item : items) {
        for (const int tool : tools_of(item.job)) tools.insert(tool);
    }
    const double depth = purge_tower_size(tools.size(), items.front().job.layers, purge).y;
    return depth > 0 ? depth + purge.gap : 0;
}

void check_one_by_one(const PrinterProfile& printer, bool has_tower) {
    if (!makes_beads(printer))
        throw InputError(
            fmt::format("plate.one_by_one / --one-by-one: {} makes layers of the whole plate; accepted: a "
                        "filament printer, "
                        "or --no-one-by-one",
                        printer.name));
    if (has_tower)
        throw InputError(
            "plate.one_by_one / --one-by-one: a purge tower grows with all parts; accepted: purge.volume = "
            "0, or "
            "--no-one-by-one");
}

/// Back-ends put the middle of a job in the middle of the plate: grows the job until that is as far from the
/// middle of the part as asked for.
void put_at(Job& job, const Box& part, dvec2 at) {
    const dvec2 middle = dvec2(part.center()) - at;
    const dvec2 reach = glm::max(dvec2(job.bounds.hi) - middle, middle - dvec2(job.bounds.lo));
    job.bounds.lo = dvec3(middle - reach, job.bounds.lo.z);
    job.bounds.hi = dvec3(middle + reach, job.bounds.hi.z);
}

}  // namespace

PlatedJob put_on_plates(const Recipe& recipe, std::span<const PlateItem> items, const PassControl& control) {
    PlateOptions options;
    options.threads = control.threads;
    options.cancel = control.cancel;
    options.gap = recipe.plate.gap;
    const dvec2 machine(build_volume_limits(recipe.printer, items.front().job.layers.height(0)));
    const PurgeProfile& purge = recipe.printer.purge;
    options.machine = machine;
    if (makes_beads(recipe.printer)) options.machine.y -= room_for_tower(items, purge);
    options.turns = recipe.plate.turn;
    const bool are_several = items.size() > 1 || items.front().copies > 1;
    options.one_by_one = recipe.plate.one_by_one && are_several;
    if (options.one_by_one) {
        check_one_by_one(recipe.printer, room_for_tower(items, purge) > 0);
        options.gap = std::max(options.gap, recipe.printer.gcode.head_radius);
    }
    std::vector<Job> plates = arrange_plates(items, options);
    const auto count = static_cast<int>(plates.size());
    if (recipe.plate.number > count) {
        throw InputError(
            fmt::format("plate.number / --plate: {}, but the parts need {} plate{}; accepted: 1 to {}",
                        recipe.plate.number, count, count == 1 ? "" : "s", count));
    }
    Job job = std::move(plates[static_cast<std::size_t>(recipe.plate.number - 1)]);
    if (makes_beads(recipe.printer)) add_purge_tower(job, purge, machine);
    if (!recipe.part.at.empty()) {
        if (are_several)
            throw InputError(
                "part.at / --at: several parts are arranged on the plate; accepted: a single part");
        put_at(job, items.front().job.bounds, {recipe.part.at[0][0], recipe.part.at[0][1]});
    }
    return {std::move(job), count};
}

}  // namespace lamella
