// From contours to islands, from islands to beads, and the beads into an order.
#include "printers/toolpath.h"

#include <algorithm>
#include <cmath>

#include "printers/center_lines.h"
#include "printers/nearest_points.h"
#include "printers/polygons.h"
#include "printers/thin_parts.h"

namespace lamella {
namespace {

constexpr double pi = 3.14159265358979323846;

/// How much of the layer's height a bead's two round sides take from its width together.
double side_loss(double height) { return height * (1 - pi / 4); }

/// The outer contours with the holes directly in them.
std::vector<Polygons> find_islands(const std::vector<Contour>& contours) {
    std::vector<std::size_t> island_of(contours.size());
    std::vector<Polygons> islands;
    for (std::size_t i = 0; i < contours.size(); ++i) {
        if (contours[i].hole) continue;
        island_of[i] = islands.size();
        islands.push_back({to_polygon(contours[i].points)});
    }
    for (const Contour& contour : contours) {
        if (!contour.hole || contour.parent < 0) continue;
        islands[island_of[static_cast<std::size_t>(contour.parent)]].push_back(to_polygon(contour.points));
    }
    return islands;
}

/// Makes the beads of one island.
class IslandPlanner {
  public:
    IslandPlanner(const ToolpathSettings& settings, int layer_index)
        : settings_(settings),
          width_(settings.line_width),
          spacing_(width_ - side_loss(settings.height)),
          direction_(layer_index % 2 == 0 ? dvec2(std::sqrt(0.5)) : dvec2(std::sqrt(0.5), -std::sqrt(0.5))) {}

    std::vector<Bead> plan(const Polygons& exact) {
        beads_.clear();
        Polygons island = simplified(exact, settings_.tolerance / 2);
        if (island.empty()) island = exact;
        // The flow makes up for what a coarse outline loses; its axis is found much faster.
        const Polygons outline = simplified(island, 1.5 * settings_.tolerance);
        const ThinParts thin = find_thin_parts(medial_axis(outline, settings_.tolerance / 2),
                                               narrowest * width_, thickest_line(), settings_.tolerance);
        if (thin.lines.empty()) {
            plan_piece(exact, island);
            return std::move(beads_);
        }
        // What is left in pieces too small for beads of their own comes with the lines, too.
        double area = area_of(exact);
        if (!thin.whole && area - thin.area >= least_area()) {
            for (const Polygons& rest : split_pieces(subtract_polygons(island, thin.covered))) {
                if (area_of(rest) < least_area()) continue;
                area -= area_of(rest);
                plan_piece(rest, rest);
            }
        }
        lay_thin_parts(thin, area);
        if (thin.whole && bead_volume(beads_.back(), settings_.height) < 0.9 * area * settings_.height &&
            beads_.size() == 1) {
            beads_.clear();  // a stub, whose line is too short
            plan_piece(exact, island);
        }
        return std::move(beads_);
    }

  private:
    /// Walls and infill of a piece with its volume, as far as beads neither starve nor bulge.
    void plan_piece(const Polygons& exact, const Polygons& piece) {
        const std::size_t first = beads_.size();
        const double wanted = area_of(exact) * settings_.height;
        const auto volume = [&] {
            double sum = 0;
            for (std::size_t i = first; i < beads_.size(); ++i)
                sum += bead_volume(beads_[i], settings_.height);
            return sum;
        };
        if (!plan_thick(exact, piece)) return;
        if (volume() * most_extra_flow < wanted) {
            // Its wall is a speck: loops nearer to the border are longer, and a chord spans it.
            beads_.resize(first);
            lay_loops(exact, width_ / 4, area_of(exact), Role::external_perimeter);
            if (volume() * most_extra_flow < wanted) {
                beads_.resize(first);
                lay_chord(exact, area_of(exact));
            }
        }
        const double laid = volume();
        if (!(laid > 0)) return;
        const double flow = std::clamp(wanted / laid, least_flow, most_extra_flow);
        for (Bead& bead : std::span(beads_).subspan(first)) {
            const double area = bead_area(bead.width, settings_.height) * flow;
            bead.width = std::min(bead_width(area, settings_.height), widest_line * width_);
        }
    }

    /// The same before the volume is looked at; `exact` is the piece before it was simplified. False where
    /// the beads do not fill it, because its inside is to be sparse.
    bool plan_thick(const Polygons& exact, const Polygons& island) {
        if (fill_wall(island, area_of(exact))) return true;
        const Polygons wall = offset_polygons(island, -width_ / 2);
        const Polygons inside = wall.empty() ? wall : offset_polygons(wall, -spacing_ / 2);
        if (inside.empty()) {
            fill_thin(exact, !wall.empty());  // simplified, a sliver could leave its own outline
            return true;
        }
        std::vector<Polygons> regions = split_pieces(inside);
        // What is too narrow for a bead of its own comes with the wall.
        double narrow = 0;
        std::erase_if(regions, [&](const Polygons& region) {
            if (wall_thickness(region) >= width_ * narrowest) return false;
            narrow += area_of(region);
            return true;
        });
        if (!(settings_.density > densest_lattice)) narrow = 0;
        const double length = perimeter_of(wall);
        add_loops(wall, width_for(length * spacing_ + narrow, length), Role::external_perimeter);
        fill_arms(island, wall);
        for (const Polygons& region : regions) fill_region(region);
        return settings_.density > densest_lattice;
    }

    /// Smaller pieces get no bead, mm^2.
    double least_area() const { return width_ * width_ / 4; }

    /// Thickness of what one bead of changing width fills at most, mm.
    double thickest_line() const { return widest_line * width_ - side_loss(settings_.height); }

    /// A bead along each line, with the volume of `area` mm^2. Beads become wider or narrower for that, and
    /// take more plastic than their length asks for where their round ends have room for it.
    void lay_thin_parts(const ThinParts& parts, double area) {
        double laid = 0, ends = 0;
        for (const TaperedLine& line : parts.lines) {
            laid += area_of(line);
            const double a = line.thickness.front(), b = line.thickness.back();
            if (!line.closed) ends += pi / 8 * (a * a + b * b);
        }
        const double wanted = area / laid;
        const double flow = std::clamp(wanted, 1.0, 1 + ends / laid);
        const double wider = std::clamp(wanted / flow, least_flow, most_extra_flow);
        for (const TaperedLine& line : parts.lines) {
            Bead bead;
            bead.points = line.points;
            bead.closed = line.closed;
            bead.flow = flow;
            for (const double thickness : line.thickness) {
                const double width = bead_width(wider * thickness * settings_.height, settings_.height);
                bead.widths.push_back(std::clamp(width, narrowest * width_, widest_line * width_));
            }
            bead.width = std::ranges::max(bead.widths);
            beads_.push_back(std::move(bead));
        }
    }

    void add_loops(const Polygons& loops, double width, Role role) {
        for (const ClipperLib::Path& loop : loops) beads_.push_back({to_points(loop), width, role, true, 0});
    }

    /// Width of the beads that lay `area` mm^2 over `length` mm, as far as they do not bulge.
    double width_for(double area, double length) const {
        return std::min(bead_width(area / length * settings_.height, settings_.height),
                        width_ * most_extra_flow);
    }

    /// One bead along the middle, or two side by side, in an island of even thickness for which that is
    /// right.
    bool fill_wall(const Polygons& island, double area) {
        const double thickness = wall_thickness(island);
        if (lay_center_lines(island, thickness, area, Role::external_perimeter)) return true;
        constexpr double unevenness = 1.15;
        const bool even = offset_polygons(island, -thickness / 2 * unevenness).empty();
        if (!even || thickness > 2 * thickest()) return false;
        if (thickness <= thickest() && area <= shortest_loop * thickness * thickness) {
            lay_chord(island, area);
            return true;
        }
        return lay_loops(island, thickness / 4, area, Role::external_perimeter);
    }

    /// Width of a wall that one bead with all its extra flow fills, mm.
    double thickest() const { return most_extra_flow * width_ - side_loss(settings_.height); }

    /// Single beads along the middle of a region of even thickness; false when it is not one for that.
    bool lay_center_lines(const Polygons& region, double thickness, double area, Role role) {
        if (thickness > thickest()) return false;
        const std::vector<CenterLine> lines = center_lines(region, thickness, settings_.tolerance);
        double length = 0;
        for (const CenterLine& line : lines) length += length_of(line);
        if (!(length > 0)) return false;
        const double width = width_for(area, length);
        for (const CenterLine& line : lines) beads_.push_back({line.points, width, role, line.closed, 0});
        return true;
    }

    /// Loops `inset` inside an island that lay down the volume of `area` mm^2; false when none are left.
    bool lay_loops(const Polygons& island, double inset, double area, Role role) {
        const Polygons loops = offset_polygons(island, -inset);
        const double length = perimeter_of(loops);
        if (!(length > 0)) return false;
        add_loops(loops, width_for(area, length), role);
        return true;
    }

    /// An island that has room for loops at most.
    void fill_thin(const Polygons& island, bool full_width_fits) {
        const double area = area_of(island);
        if (full_width_fits) {
            // Two full beads side by side would be too much: take the width at which they just fill it.
            const double half_thickness = area / perimeter_of(island);
            const double inset = std::clamp(half_thickness, width_ / 2, width_) / 2;
            if (lay_loops(island, inset, area, Role::external_perimeter)) return;
        }
        for (const double share : {0.75, 0.5, 0.25}) {
            if (lay_loops(island, share * width_ / 2, area, Role::external_perimeter)) return;
        }
        lay_chord(island, area);
    }

    /// One short bead with the volume of a small region, of `area` mm^2.
    void lay_chord(const Polygons& region, double area) {
        const Segment chord = longest_chord(region);
        const double length = chord.length();
        if (!(length > 0)) return;
        const double least = std::min(area / thickest(), length);
        const double shrink = std::min({width_ / 2, length / 4, (length - least) / 2}) / length;
        const dvec2 step = (chord.b - chord.a) * shrink;
        const Segment bead{chord.a + step, chord.b - step};
        beads_.push_back({{bead.a, bead.b}, width_for(area, bead.length()), Role::gap_fill, false, 0});
    }

    /// The parts of an island that are too thin for its wall.
    void fill_arms(const Polygons& island, const Polygons& wall) {
        const double least = width_ * width_ / 4;
        const Polygons reached = offset_polygons(wall, width_ / 2 + settings_.tolerance);
        if (area_of(island) - area_of(reached) + perimeter_of(wall) * settings_.tolerance < least) return;
        for (const Polygons& arm : split_pieces(subtract_polygons(island, reached))) {
            if (area_of(arm) < least) continue;
            if (lay_center_lines(arm, wall_thickness(arm), area_of(arm), Role::gap_fill)) continue;
            for (const double share : {0.75, 0.5}) {
                if (lay_loops(arm, share * width_ / 2, area_of(arm), Role::gap_fill)) break;
            }
        }
    }

    /// Infill of one connected region inside the wall.
    void fill_region(const Polygons& region) {
        if (!(settings_.density > 0)) return;
        // A line's round end reaches further than its last point; a quarter width of overlap bonds it.
        const Polygons clip = offset_polygons(region, width_ / 4 - spacing_ / 2);
        if (settings_.density > densest_lattice) {
            fill_solid(region, clip);
            return;
        }
        // One lattice for the whole layer, so that lines stand on the lines two layers below.
        const Interval across = extent(region, normal());
        const double pitch = spacing_ / settings_.density;
        const double first = std::floor(across.lo / pitch) * pitch;
        const int count = static_cast<int>(across.width() / pitch) + 2;
        add_lines(lines_in(clip, first, pitch, count), width_, Role::internal_infill);
    }

    /// Lines spread evenly over a region, with the flow that gives its volume.
    void fill_solid(const Polygons& region, const Polygons& clip) {
        if (lay_center_lines(region, wall_thickness(region), area_of(region), Role::solid_infill)) return;
        const Interval across = extent(region, normal());
        const int count = std::max(1, static_cast<int>(std::lround(across.width() / spacing_)));
        const double pitch = across.width() / count;
        // In a narrow region the lines' ends matter: there they are taken up to its border.
        for (const Polygons* within : {&clip, &region}) {
            const std::vector<Segment> lines = lines_in(*within, across.lo + pitch / 2, pitch, count);
            double length = 0;
            for (const Segment& line : lines) length += line.length();
            const bool enough = area_of(region) <= length * spacing_ * most_extra_flow;
            if (!enough && (within != &region || length < spacing_)) continue;
            const double width = bead_width(area_of(region) / length * settings_.height, settings_.height);
            add_lines(lines, std::min(width, width_ * most_extra_flow), Role::solid_infill);
            return;
        }
        if (area_of(region) > spacing_ * spacing_ / 8) lay_chord(region, area_of(region));
    }

    dvec2 normal() const { return {-direction_.y, direction_.x}; }

    std::vector<Segment> lines_in(const Polygons& region, double first, double pitch, int count) const {
        std::vector<Segment> lines = cut_lines(region, direction_, first, pitch, count);
        std::erase_if(lines, [&](const Segment& line) { return line.length() < spacing_ / 4; });
        return lines;
    }

    void add_lines(const std::vector<Segment>& lines, double width, Role role) {
        for (const Segment& line : lines) beads_.push_back({{line.a, line.b}, width, role, false, 0});
    }

    static constexpr double densest_lattice = 0.999;  // from here on regions are filled solid
    static constexpr double most_extra_flow = 1.3;    // more would bulge over the layer
    static constexpr double least_flow = 0.7;         // less would leave gaps
    static constexpr double narrowest = 0.3;          // thinner threads, in widths, tear
    static constexpr double widest_line = 1.5;        // in widths; thicker parts take two
    static constexpr double shortest_loop = 1;        // shorter islands, in thicknesses, get a chord

    ToolpathSettings settings_;
    double width_;
    double spacing_;  // from bead to bead when they fill the plane
    dvec2 direction_;
    std::vector<Bead> beads_;
};

double squared_distance(dvec2 a, dvec2 b) {
    const dvec2 d = a - b;
    return d.x * d.x + d.y * d.y;
}

/// Turns a loop so that it begins, and hence ends, at its point nearest to `from`.
void begin_near(Bead& loop, dvec2 from) {
    const auto nearest =
        std::ranges::min_element(loop.points, {}, [&](dvec2 p) { return squared_distance(p, from); });
    const auto first = nearest - loop.points.begin();
    std::rotate(loop.points.begin(), nearest, loop.points.end());
    if (!loop.widths.empty())
        std::rotate(loop.widths.begin(), loop.widths.begin() + first, loop.widths.end());
}

dvec2 end_of(const Bead& bead) { return bead.closed ? bead.points.front() : bead.points.back(); }

/// Appends beads [first, last) to `out` by nearest neighbour from `at`, which moves along.
void append_nearest(std::span<Bead> beads, dvec2& at, std::vector<Bead>& out) {
    std::vector<dvec2> ends;  // two for each bead; a loop may begin anywhere, its first point stands for it
    for (const Bead& bead : beads) {
        ends.push_back(bead.points.front());
        ends.push_back(bead.closed ? bead.points.front() : bead.points.back());
    }
    NearestPoints left(ends);
    while (!left.empty()) {
        const std::size_t end = left.nearest(at);
        Bead& bead = beads[end / 2];
        left.remove(end);
        left.remove(end ^ 1);
        if (bead.closed) {
            begin_near(bead, at);
        } else if (end % 2 == 1) {
            std::ranges::reverse(bead.points);
            std::ranges::reverse(bead.widths);
        }
        at = end_of(bead);
        out.push_back(std::move(bead));
    }
}

}  // namespace

double bead_area(double width, double height) {
    return width > height ? height * (width - side_loss(height)) : pi / 4 * width * height;
}

double bead_width(double area, double height) {
    return area > pi / 4 * height * height ? area / height + side_loss(height) : area / (pi / 4 * height);
}

double bead_volume(const Bead& bead, double height) {
    double volume = 0;
    const std::size_t n = bead.points.size();
    for (std::size_t i = 0; i + (bead.closed ? 0 : 1) < n; ++i) {
        const std::size_t j = (i + 1) % n;
        volume += std::sqrt(squared_distance(bead.points[i], bead.points[j])) *
                  (bead_area(bead.width_at(i), height) + bead_area(bead.width_at(j), height)) / 2;
    }
    return volume * bead.flow;
}

Toolpaths plan_toolpaths(const std::vector<Contour>& contours, const ToolpathSettings& settings,
                         int layer_index) {
    Toolpaths result;
    const std::vector<Polygons> islands = find_islands(contours);
    result.islands = static_cast<int>(islands.size());
    std::vector<std::vector<Bead>> planned;
    std::vector<dvec2> entries;
    Rect all;
    IslandPlanner planner(settings, layer_index);
    for (const Polygons& island : islands) {
        for (const dvec2& p : to_points(island.front())) all = unite(all, Rect{p, p});
        std::vector<Bead> beads;
        if (area_of(island) >= settings.line_width * settings.line_width / 4) beads = planner.plan(island);
        if (beads.empty()) {
            ++result.islands_left_out;
            continue;
        }
        entries.push_back(beads.front().points.front());
        planned.push_back(std::move(beads));
    }
    NearestPoints left(entries);
    dvec2 at = all.lo;
    for (int island = 0; !left.empty(); ++island) {
        const std::size_t next = left.nearest(at);
        left.remove(next);
        std::vector<Bead>& beads = planned[next];
        for (Bead& bead : beads) bead.island = island;
        // Walls before infill: they hold what comes inside.
        const auto infill =
            std::stable_partition(beads.begin(), beads.end(), [](const Bead& bead) { return bead.closed; });
        const auto walls = static_cast<std::size_t>(infill - beads.begin());
        append_nearest(std::span(beads).first(walls), at, result.beads);
        append_nearest(std::span(beads).subspan(walls), at, result.beads);
    }
    return result;
}

}  // namespace lamella
