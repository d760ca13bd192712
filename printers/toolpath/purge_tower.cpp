// Sizes, place and strips of the tower.
#include "printers/toolpath/purge_tower.h"

#include <algorithm>
#include <map>

#include "engine/solids/primitives.h"

namespace lamella {

namespace {

/// Returns the greatest height of each tool's zones, in the job's coordinates, mm.
std::map<int, double> tops(const Job& job) {
    std::map<int, double> heights;
    const auto reach = [&](int tool, const FieldPtr& zone, const FieldPtr& solid) {
        double top = std::min(solid->bounds().hi.z, job.bounds.hi.z);
        if (zone) top = std::min(top, zone->bounds().hi.z);
        const auto [found, is_new] = heights.emplace(tool, top);
        if (!is_new) found->second = std::max(found->second, top);
    };
    const auto reach_all = [&](const std::vector<ToolZone>& zones, const FieldPtr& solid) {
        if (!solid) return;
        if (zones.empty()) reach(0, nullptr, solid);
        for (const ToolZone& zone : zones) reach(zone.tool, zone.zone, solid);
    };
    reach_all(job.part_tools, job.part);
    reach_all(job.support_tools, job.supports);
    return heights;
}

/// Returns the height over the bed that the tower needs, mm.
double tower_height(const Job& job) {
    std::vector<double> heights;
    for (const auto& [tool, top] : tops(job)) heights.push_back(top);
    std::ranges::sort(heights, std::greater<>{});
    int last = job.layers.layer_at(heights[1] - job.z0());
    // The tool that is left may have to be changed to in the layer above the last that is cut below that.
    if (job.plane(last) < heights[1]) ++last;
    return job.layers.top(std::min(last, job.layers.count() - 1));
}

}  // namespace

std::vector<int> tools_of(const Job& job) {
    std::vector<int> tools;
    for (const auto& [tool, top] : tops(job)) tools.push_back(tool);
    return tools;
}

dvec2 purge_tower_size(std::size_t tools, const LayerPlan& layers, const PurgeProfile& profile) {
    if (tools < 2 || profile.volume == 0) return dvec2(0);
    const double strip = profile.volume / (layers.least_height() * profile.width);
    return {profile.width, strip * static_cast<double>(tools)};
}

void add_purge_tower(Job& job, const PurgeProfile& profile, dvec2 plate) {
    const dvec2 size = purge_tower_size(tools_of(job).size(), job.layers, profile);
    if (size == dvec2(0)) return;
    const Box& box = job.bounds;
    const bool is_behind = box.size().y + profile.gap + size.y <= plate.y || !std::isfinite(plate.y);
    const dvec2 middle(box.center());
    const dvec2 corner = is_behind ? dvec2(middle.x - size.x / 2, box.hi.y + profile.gap)
                                   : dvec2(box.hi.x + profile.gap, middle.y - size.y / 2);
    const Box tower{dvec3(corner, job.z0()), dvec3(corner + size, job.z0() + tower_height(job))};
    job.purge_tower = make_box(tower);
    job.bounds = unite(job.bounds, tower);
}

PurgeStrip purge_strip(const Job& job, int tool, double height) {
    const std::vector<int> tools = tools_of(job);
    const auto number = static_cast<double>(std::ranges::find(tools, tool) - tools.begin());
    const Box tower = job.purge_tower->bounds();
    const double depth = tower.size().y / static_cast<double>(tools.size());
    const double width = tower.size().x * std::min(1.0, job.layers.least_height() / height);
    const dvec2 lo(tower.lo.x, tower.lo.y + depth * number), hi(tower.hi.x, lo.y + depth);
    return {{lo, {lo.x + width, hi.y}}, {{lo.x + width, lo.y}, hi}};
}

}  // namespace lamella
