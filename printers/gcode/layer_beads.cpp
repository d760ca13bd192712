// Sections by tool, each filled; then the tower's strips.
#include "printers/gcode/layer_beads.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "printers/toolpath/purge_tower.h"
#include "printers/toolpath/skirt.h"
#include "printers/toolpath/tool_sections.h"

namespace lamella {

namespace {

void append(Toolpaths added, Toolpaths& paths, std::optional<Role> role = {}) {
    const auto islands = static_cast<int>(paths.outlines.size());
    for (Bead& bead : added.beads) {
        bead.island += islands;
        bead.role = role.value_or(bead.role);
    }
    std::ranges::move(added.beads, std::back_inserter(paths.beads));
    std::ranges::move(added.outlines, std::back_inserter(paths.outlines));
    paths.islands_left_out += added.islands_left_out;
}

double area_of(const std::vector<Contour>& contours) {
    double area = 0;
    for (const Contour& contour : contours) area += signed_area(contour.points);
    return area;
}

std::vector<dvec2> corners(const Rect& rect) {
    return {rect.lo, {rect.hi.x, rect.lo.y}, rect.hi, {rect.lo.x, rect.hi.y}};
}

bool has_tower(const Job& job, const Layer& layer) {
    return job.purge_tower && layer.z() < job.purge_tower->bounds().hi.z;
}

}  // namespace

LineSettings LayerBeads::line(const Layer& layer) const {
    return {profile_.filament.line_width, layer.thickness(), profile_.filament.tolerance};
}

Toolpaths LayerBeads::fill(const Layer& layer, const std::vector<Contour>& contours, double density,
                           const LayerNeighborhood& around) const {
    const ToolpathProfile& t = profile_.toolpath;
    return plan_toolpaths(contours,
                          {line(layer), t.walls, density, t.infill, t.seam, profile_.gcode.retract_from},
                          layer.index(), around, layer.cancel());
}

/// Returns the layer below; empty for the first layer.
std::optional<LayerBelow> LayerBeads::footing(const Layer& layer) const {
    if (layer.level() == 0) return std::nullopt;
    return neighbours_.footing(layer.index(), profile_.filament.line_width / 4, layer.cancel());
}

/// Returns the region where infill may be sparse; empty if no solid layers are required.
std::optional<PlacedPolygons> LayerBeads::core(const Layer& layer) const {
    const ToolpathProfile& t = profile_.toolpath;
    if (profile_.filament.infill_density >= 1 || t.top_layers + t.bottom_layers == 0) return std::nullopt;
    return neighbours_.core(layer.index(), t.bottom_layers, t.top_layers, layer.cancel());
}

/// Returns brim and skirt of the first layer; empty for other layers.
Toolpaths LayerBeads::skirt(const Layer& layer, const LayerOutlines& outlines) const {
    if (layer.level() > 0) return {};
    Polygons standing;
    for (const std::vector<Contour>* contours : {&outlines.part, &outlines.supports}) {
        for (const Contour& contour : *contours) standing.push_back(to_polygon(contour.points));
    }
    if (has_tower(job_, layer)) standing.push_back(to_polygon(corners(job_.purge_tower->bounds().rect())));
    Toolpaths paths;
    paths.beads = skirt_beads(standing, profile_.toolpath, line(layer));
    if (!paths.beads.empty()) paths.outlines.emplace_back();  // empty: travel is not confined
    return paths;
}

Toolpaths LayerBeads::tower_piece(const Layer& layer, const Rect& rect, double density) const {
    if (rect.size().x < profile_.filament.line_width) return {};
    const ToolpathProfile& t = profile_.toolpath;
    const bool is_first = layer.level() == 0;  // which holds the tower to the bed
    const std::vector<Contour> contours{{corners(rect), -1, false}};
    Toolpaths paths;
    append(plan_toolpaths(contours,
                          {line(layer), 1, is_first ? 1 : density, InfillPattern::lines, t.seam,
                           profile_.gcode.retract_from},
                          layer.index(), {}, layer.cancel()),
           paths, Role::purge_tower);
    return paths;
}

/// Puts the strips of the tower before the beads of the tools that lay them. The layer's first tool may have
/// been kept from the layer below; it also lays the strips of tools that the layer has no use for.
void LayerBeads::add_tower(const Layer& layer, const std::vector<int>& tools, LayerPaths& planned) const {
    const double sparse = profile_.purge.density;
    const auto whole = [](const PurgeStrip& strip) { return unite(strip.purged, strip.rest); };
    Toolpaths idle;
    for (const int tool : tools_of(job_)) {
        if (std::ranges::find(tools, tool) != tools.end()) continue;
        append(tower_piece(layer, whole(purge_strip(job_, tool, layer.thickness())), sparse), idle);
    }
    if (tools.empty()) {
        planned.beads.push_back({ToolBeads::any, LaidWhen::always, std::move(idle)});
        return;
    }
    std::vector<ToolBeads> with_tower;
    for (ToolBeads& beads : planned.beads) {
        const PurgeStrip strip = purge_strip(job_, beads.tool, layer.thickness());
        Toolpaths purge = tower_piece(layer, strip.purged, 1);
        append(tower_piece(layer, strip.rest, sparse), purge);
        with_tower.push_back({beads.tool, LaidWhen::tool_changed, std::move(purge)});
        if (beads.tool == tools.front()) {
            with_tower.push_back({beads.tool, LaidWhen::tool_kept, tower_piece(layer, whole(strip), sparse)});
            append(std::move(beads.paths), idle);
            beads.paths = std::move(idle);
        }
        with_tower.push_back(std::move(beads));
    }
    planned.beads = std::move(with_tower);
}

LayerPaths LayerBeads::plan(const Layer& layer, const ObjectLabels& labels) const {
    const auto outlines = neighbours_.outlines(layer.index(), layer.cancel());
    stop_if_cancelled(layer.cancel());
    const FilamentProfile& filament = profile_.filament;
    LayerPaths planned;
    planned.part_area = area_of(outlines->part);
    planned.support_area = area_of(outlines->supports);
    const std::optional<LayerBelow> footing = this->footing(layer);
    const std::optional<PlacedPolygons> core = this->core(layer);
    const auto pointer = [](const auto& held) { return held ? &*held : nullptr; };
    std::map<int, Toolpaths> by_tool;
    const auto add = [&](const std::vector<Contour>& section, const std::vector<ToolZone>& zones,
                         double density, const LayerNeighborhood& around, std::optional<Role> role) {
        for (const ToolSection& share :
             divide_by_tool(section, zones, layer.z(), filament.tolerance, filament.line_width / 4))
            append(fill(layer, share.contours, density, around), by_tool[share.tool], role);
    };
    // Supports are always filled completely.
    add(outlines->supports, job_.support_tools, 1, {pointer(footing), nullptr}, Role::support);
    add(outlines->part, job_.part_tools, filament.infill_density, {pointer(footing), pointer(core)}, {});
    std::vector<int> tools;
    for (const auto& [tool, paths] : by_tool) {
        planned.islands_left_out += paths.islands_left_out;
        if (!paths.beads.empty()) tools.push_back(tool);
    }
    if (layer.index() % 2 == 1) std::ranges::reverse(tools);
    for (const int tool : tools)
        planned.beads.push_back({tool, LaidWhen::always, std::move(by_tool.at(tool))});
    if (!tools.empty()) {
        Toolpaths paths = skirt(layer, *outlines);
        append(std::move(planned.beads.front().paths), paths);
        planned.beads.front().paths = std::move(paths);
    }
    if (has_tower(job_, layer)) add_tower(layer, tools, planned);
    for (ToolBeads& beads : planned.beads) {
        for (Bead& bead : beads.paths.beads) {
            if (bead.role != Role::skirt && bead.role != Role::purge_tower)
                bead.object = labels.object_at({bead.points[bead.points.size() / 2], layer.z()});
        }
    }
    return planned;
}

}  // namespace lamella
