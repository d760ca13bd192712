// Turns a layer's section into paths: ties, kerf, scores, numbers, order.
#include "printers/vector/cut_plan.h"

#include <algorithm>
#include <optional>

#include "printers/polygons/polygons.h"
#include "printers/vector/stroke_digits.h"
#include "printers/vector/tie_bars.h"

namespace lamella {
namespace {

constexpr double score_inset = 0.2;       // mm; closer to the border the cut itself shows the outline
constexpr double shortest_score = 1;      // mm
constexpr double min_digit = 1.5;         // mm; smallest legible engraving
constexpr double number_clearance = 0.5;  // mm

double length_of(const std::vector<dvec2>& line) {
    double sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i) sum += Segment{line[i - 1], line[i]}.length();
    return sum;
}

struct Borders {
    int outer = 0;
    int holes = 0;
};

Borders count_borders(const Polygons& polygons) {
    Borders borders;
    for (const ClipperLib::Path& polygon : polygons)
        ++(ClipperLib::Orientation(polygon) ? borders.outer : borders.holes);
    return borders;
}

/// Returns the section with its borders moved out of the material by half the kerf.
Polygons moved_by_kerf(const Polygons& section, double kerf, CutPlan& plan) {
    if (kerf == 0) return section;
    Polygons moved = offset_polygons(section, kerf / 2);
    const Borders before = count_borders(section), after = count_borders(moved);
    plan.closed_holes = std::max(0, before.holes - after.holes);
    plan.merged_pieces = std::max(0, before.outer - after.outer);
    return moved;
}

/// Returns the outline of the layer above where it lies on this one.
std::vector<ClipperLib::Path> next_outline(const Job& job, int index, const Polygons& section,
                                           double tolerance) {
    if (index + 1 >= job.layers.count()) return {};
    const Polygons next = to_polygons(Layer(job, index + 1).contours(tolerance));
    std::vector<ClipperLib::Path> lines = rings_inside(next, offset_polygons(section, -score_inset));
    std::erase_if(lines, [](const auto& line) { return length_of(to_points(line)) < shortest_score; });
    return lines;
}

/// Returns the middle of the largest piece where a disc of this radius fits; nothing if there is none.
std::optional<dvec2> clear_place(const Polygons& section, const std::vector<ClipperLib::Path>& scores,
                                 double radius) {
    Polygons clear = erode_polygons(section, radius);
    if (!clear.empty() && !scores.empty()) clear = subtract_polygons(clear, around_lines(scores, radius));
    const std::vector<Polygons> pieces = split_pieces(clear);
    if (pieces.empty()) return std::nullopt;
    const Polygons& largest =
        *std::ranges::max_element(pieces, {}, [](const Polygons& piece) { return area_of(piece); });
    const Segment chord = longest_chord(largest);
    if (chord.length() == 0) return to_points(largest.front()).front();
    return (chord.a + chord.b) * 0.5;
}

struct NumberPlace {
    dvec2 center{0};
    double height = 0;
};

/// Returns the place where the number is largest, up to the requested height.
std::optional<NumberPlace> number_place(const Polygons& section, const std::vector<ClipperLib::Path>& scores,
                                        int number, double height) {
    const dvec2 unit = number_size(number, 1);
    const double reach = std::sqrt(unit.x * unit.x + unit.y * unit.y) / 2;
    const auto place = [&](double h) { return clear_place(section, scores, h * reach + number_clearance); };
    double lo = std::min(min_digit, height);
    if (const auto center = place(height)) return NumberPlace{*center, height};
    auto best = place(lo);
    if (!best) return std::nullopt;
    double hi = height;
    constexpr int halvings = 5;
    for (int i = 0; i < halvings; ++i) {
        const double middle = (lo + hi) / 2;
        const auto center = place(middle);
        (center ? lo : hi) = middle;
        if (center) best = center;
    }
    return NumberPlace{*best, lo};
}

class Planner {
  public:
    explicit Planner(int layer) : layer_(layer) {}

    void line(CutPurpose purpose, std::vector<dvec2> points) {
        const bool closed = points.size() > 3 && points.front() == points.back();
        if (closed) points.pop_back();
        plan.paths.push_back({purpose, layer_, closed, std::move(points)});
    }
    void cuts(const Polygons& borders) {
        std::vector<NestedPolygon> nested = nested_polygons(borders);
        std::ranges::stable_sort(nested, [](const auto& a, const auto& b) { return a.depth > b.depth; });
        for (const NestedPolygon& border : nested) {
            const CutPurpose purpose = border.depth > 0 ? CutPurpose::inner : CutPurpose::outer;
            plan.paths.push_back({purpose, layer_, true, to_points(border.polygon)});
        }
    }

    CutPlan plan;

  private:
    int layer_;
};

}  // namespace

CutPlan plan_cuts(const Job& job, const Layer& layer, const CuttingProfile& profile, double tolerance) {
    Planner planner(layer.index());
    CutPlan& plan = planner.plan;
    const std::vector<Contour> contours = layer.contours(tolerance);
    for (const Contour& contour : contours) plan.area += signed_area(contour.points);
    if (contours.empty()) return plan;
    Polygons section = to_polygons(contours);
    const std::vector<Polygons> pieces = split_pieces(section);
    plan.pieces = static_cast<int>(pieces.size());
    std::vector<ClipperLib::Path> scores;
    if (profile.next_outline) scores = next_outline(job, layer.index(), section, tolerance);
    if (profile.numbers) {
        auto place = number_place(section, scores, layer.index(), profile.number_height);
        if (!place && !scores.empty())
            place = number_place(section, {}, layer.index(), profile.number_height);
        plan.unnumbered = !place;
        if (place) {
            for (auto& stroke : number_strokes(layer.index(), place->center, place->height))
                planner.line(CutPurpose::engrave, std::move(stroke));
        }
    }
    for (const ClipperLib::Path& score : scores) planner.line(CutPurpose::score, to_points(score));
    // Marks are placed on the part only, because the tie bars are removed later.
    if (profile.ties == Ties::join && pieces.size() > 1) {
        section = unite_polygons(section, tie_bars(pieces, profile.tie_width));
    }
    planner.cuts(moved_by_kerf(section, profile.kerf, plan));
    for (const SheetPath& path : plan.paths) {
        for (const dvec2& p : path.points) plan.extent = unite(plan.extent, Rect{p, p});
    }
    return plan;
}

double cut_allowance(const CuttingProfile& profile) {
    return profile.kerf / 2 + (profile.ties == Ties::join ? profile.tie_width / 2 : 0);
}

}  // namespace lamella
