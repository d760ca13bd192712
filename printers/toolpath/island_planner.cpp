// Plans thin parts, walls from the outside in, and the filling of the rest.
#include "printers/toolpath/island_planner.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "printers/toolpath/center_lines.h"
#include "printers/toolpath/infill.h"
#include "printers/toolpath/inner_regions.h"
#include "printers/toolpath/thin_beads.h"

namespace lamella {
namespace {

constexpr double shortest_loop = 1;  // in thicknesses; shorter islands get a chord

Role wall_role(int walls_laid) { return walls_laid == 0 ? Role::external_perimeter : Role::perimeter; }

}  // namespace

IslandPlanner::IslandPlanner(const ToolpathSettings& settings, int layer_index,
                             const LayerNeighborhood& around, const CancelToken* cancel)
    : settings_(settings),
      line_(settings.line),
      around_(around),
      cancel_(cancel),
      direction_(layer_index % 2 == 0 ? dvec2(std::sqrt(0.5)) : dvec2(std::sqrt(0.5), -std::sqrt(0.5))) {}

std::vector<Bead> IslandPlanner::plan(const Polygons& island) {
    beads_.clear();
    sparse_regions_ = 0;
    Polygons piece = simplified(island, line_.tolerance / 2);
    if (piece.empty()) piece = island;
    fill(island, piece, 0);
    // Drops threads that would tear, unless the island has no other beads.
    const auto is_thread = [&](const Bead& bead) {
        return bead.width < LineSettings::narrowest * line_.width;
    };
    if (!std::ranges::all_of(beads_, is_thread)) std::erase_if(beads_, is_thread);
    return std::move(beads_);
}

void IslandPlanner::add(std::vector<Bead> beads) {
    beads_.insert(beads_.end(), std::move_iterator(beads.begin()), std::move_iterator(beads.end()));
}

double IslandPlanner::volume_from(std::size_t first) const {
    double sum = 0;
    for (std::size_t i = first; i < beads_.size(); ++i) sum += bead_volume(beads_[i], line_.height);
    return sum;
}

/// Fills a piece inside `walls_laid` walls; `exact` is the piece before simplification.
void IslandPlanner::fill(const Polygons& exact, const Polygons& piece, int walls_laid) {
    stop_if_cancelled(cancel_);
    // The axis of a coarse outline has fewer branches. The flow compensates for the lost area.
    const Polygons outline = simplified(piece, 1.5 * line_.tolerance);
    const ThinParts thin =
        find_thin_parts(medial_axis(outline, line_.tolerance / 2), LineSettings::narrowest * line_.width,
                        line_.thickest_tapered(), line_.tolerance);
    if (thin.lines.empty()) return fill_thick(exact, piece, walls_laid);
    // The area of remaining pieces too small for beads of their own is added to the lines.
    double area = area_of(exact);
    if (!thin.whole && area - thin.area >= line_.min_area()) {
        for (const Polygons& rest : split_pieces(subtract_polygons(piece, thin.covered))) {
            if (area_of(rest) < line_.min_area()) continue;
            area -= area_of(rest);
            fill_thick(rest, rest, walls_laid);
        }
    }
    const Role role = walls_laid == 0 ? Role::external_perimeter : Role::gap_fill;
    std::vector<Bead> lines = tapered_beads(thin, area, line_, role);
    constexpr double enough = 0.9;
    // The line of a piece hardly longer than thick is too short for the piece's volume.
    if (thin.whole && lines.size() == 1 &&
        bead_volume(lines.front(), line_.height) < enough * area * line_.height) {
        return fill_thick(exact, piece, walls_laid);
    }
    add(std::move(lines));
}

/// Lays walls and infill with the volume of the piece, as far as the limits of flow permit.
void IslandPlanner::fill_thick(const Polygons& exact, const Polygons& piece, int walls_laid) {
    const std::size_t first = beads_.size();
    const double area = area_of(exact), wanted = area * line_.height;
    if (!lay_walls(exact, piece, walls_laid)) return;
    const auto starves = [&] { return volume_from(first) * LineSettings::max_extra_flow < wanted; };
    if (starves()) {
        // The wall is tiny. Loops nearer to the border are longer, and a chord spans the piece.
        beads_.resize(first);
        add(loop_beads(exact, line_.width / 4, area, line_, wall_role(walls_laid)));
        if (starves()) {
            beads_.resize(first);
            add(chord_bead(exact, area, line_));
        }
    }
    const double laid = volume_from(first);
    if (!(laid > 0)) return;
    const double flow = std::clamp(wanted / laid, LineSettings::min_flow, LineSettings::max_extra_flow);
    const auto scale = [&](double& width) {
        const double section = bead_area(width, line_.height) * flow;
        width = std::min(bead_width(section, line_.height), LineSettings::widest_tapered * line_.width);
    };
    for (Bead& bead : std::span(beads_).subspan(first)) {
        scale(bead.width);
        std::ranges::for_each(bead.widths, scale);
    }
}

/// Lays walls and infill without regard to the volume. Returns false if the beads do not fill the piece
/// because its interior is sparse.
bool IslandPlanner::lay_walls(const Polygons& exact, const Polygons& piece, int walls_laid) {
    stop_if_cancelled(cancel_);
    const Role role = wall_role(walls_laid);
    const InscribedDisc disc(piece);
    if (fill_even_wall(piece, disc, area_of(exact), role)) return true;
    // The outermost bead lies entirely inside the contour; inner beads overlap by their round sides.
    const double spacing = line_.spacing(), inset = (walls_laid == 0 ? line_.width : spacing) / 2;
    Polygons wall, inside;
    if (disc.fits(inset + spacing / 2)) {
        wall = offset_polygons(piece, -inset);
        inside = offset_polygons(wall, -spacing / 2);
    }
    if (inside.empty()) {
        fill_narrow(exact, disc.fits(inset), role);  // exact: a simplified sliver might leave its own outline
        return true;
    }
    std::vector<Polygons> regions = split_pieces(inside);
    // The area of regions too narrow for a bead of their own is added to the wall.
    double narrow = 0;
    std::erase_if(regions, [&](const Polygons& region) {
        if (wall_thickness(region) >= line_.width * LineSettings::narrowest) return false;
        narrow += area_of(region);
        return true;
    });
    const double length = perimeter_of(wall);
    const double width = line_.width_for(length * spacing + narrow, length);
    for (const ClipperLib::Path& loop : wall) beads_.push_back({to_points(loop), width, role, true, 0});
    const int sparse_before = sparse_regions_;
    for (const Polygons& region : regions) {
        if (walls_laid + 1 < settings_.walls) {
            if (area_of(region) >= line_.min_area()) fill(region, region, walls_laid + 1);
        } else {
            fill_inside(region);
        }
    }
    return sparse_regions_ == sparse_before;
}

/// Lays one bead along the middle, or two side by side, if the piece has a suitable uniform thickness.
bool IslandPlanner::fill_even_wall(const Polygons& piece, const InscribedDisc& disc, double area, Role role) {
    const double thickness = wall_thickness(piece);
    if (std::vector<Bead> beads = center_line_beads(piece, thickness, area, line_, role); !beads.empty()) {
        add(std::move(beads));
        return true;
    }
    constexpr double unevenness = 1.15;
    if (thickness > 2 * line_.thickest() || disc.fits(thickness / 2 * unevenness)) return false;
    if (thickness <= line_.thickest() && area <= shortest_loop * thickness * thickness) {
        add(chord_bead(piece, area, line_));
        return true;
    }
    std::vector<Bead> loops = loop_beads(piece, thickness / 4, area, line_, role);
    add(loops);
    return !loops.empty();
}

/// Fills a piece that has no room for more than loops.
void IslandPlanner::fill_narrow(const Polygons& piece, bool full_width_fits, Role role) {
    const double area = area_of(piece);
    const auto lay = [&](double inset) {
        std::vector<Bead> loops = loop_beads(piece, inset, area, line_, role);
        add(loops);
        return !loops.empty();
    };
    if (full_width_fits) {
        // Two full beads side by side would be too much, so the width is chosen at which they exactly fill
        // it.
        const double half_thickness = area / perimeter_of(piece);
        if (lay(std::clamp(half_thickness, line_.width / 2, line_.width) / 2)) return;
    }
    for (const double share : {0.75, 0.5, 0.25}) {
        if (lay(share * line_.width / 2)) return;
    }
    add(chord_bead(piece, area, line_));
}

/// Fills one connected region inside the walls with the infill that the adjacent layers require.
void IslandPlanner::fill_inside(const Polygons& inside) {
    stop_if_cancelled(cancel_);
    for (const InnerRegion& part : divide_inside(inside, around_, settings_.density, line_)) {
        switch (part.fill) {
            case InnerRegion::Fill::sparse:
                ++sparse_regions_;
                if (settings_.density > 0) fill_region(part.region, settings_.density);
                break;
            case InnerRegion::Fill::solid:
                fill_region(part.region, 1);
                break;
            case InnerRegion::Fill::bridge: {
                std::vector<Bead> lines = solid_lines(part.region, part.along, line_);
                for (Bead& line : lines) line.hangs = true;
                add(std::move(lines));
                break;
            }
        }
    }
}

void IslandPlanner::fill_region(const Polygons& region, double density) {
    if (settings_.infill == InfillPattern::concentric)
        add(concentric_loops(region, density, line_));
    else if (density < 1)
        add(sparse_lines(region, density, direction_, line_));
    else
        add(solid_lines(region, direction_, line_));
}

}  // namespace lamella
