// Calls of Clipper, and clipping of straight lines by polygons.
#include "printers/polygons/polygons.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

ClipperLib::cInt to_units(double mm) {
    return static_cast<ClipperLib::cInt>(std::floor(mm * polygon_scale + 0.5));
}

dvec2 to_point(const ClipperLib::IntPoint& p) {
    return dvec2(static_cast<double>(p.X), static_cast<double>(p.Y)) / polygon_scale;
}

/// Calls visit(a, b) for every edge, mm.
template <typename Visit>
void each_edge(const Polygons& polygons, Visit visit) {
    for (const ClipperLib::Path& polygon : polygons) {
        if (polygon.empty()) continue;
        dvec2 a = to_point(polygon.back());
        for (const ClipperLib::IntPoint& point : polygon) {
            const dvec2 b = to_point(point);
            visit(a, b);
            a = b;
        }
    }
}

void collect_pieces(const ClipperLib::PolyNode& outer, std::vector<Polygons>& pieces) {
    Polygons piece{outer.Contour};
    for (const ClipperLib::PolyNode* hole : outer.Childs) {
        piece.push_back(hole->Contour);
        for (const ClipperLib::PolyNode* inner : hole->Childs) collect_pieces(*inner, pieces);
    }
    pieces.push_back(std::move(piece));
}

/// Returns the direction of the largest second moment of area.
dvec2 principal_axis(const Polygons& polygons) {
    dvec2 reference = to_point(polygons.front().front());
    double area = 0;
    dvec2 first{0};
    double xx = 0;
    double xy = 0;
    double yy = 0;
    each_edge(polygons, [&](dvec2 a, dvec2 b) {  // Green's theorem, with triangles from the reference point
        a -= reference;
        b -= reference;
        const double cross = a.x * b.y - a.y * b.x;
        area += cross / 2;
        first += (a + b) * (cross / 6);
        xx += cross / 12 * (a.x * a.x + a.x * b.x + b.x * b.x);
        yy += cross / 12 * (a.y * a.y + a.y * b.y + b.y * b.y);
        xy += cross / 24 * (2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y);
    });
    xx -= first.x * first.x / area;
    yy -= first.y * first.y / area;
    xy -= first.x * first.y / area;
    const double difference = (xx - yy) / 2;
    const double root = std::sqrt(difference * difference + xy * xy);
    // Of the two equivalent forms of the eigenvector, use the one without cancellation.
    const dvec2 axis = difference >= 0 ? dvec2(difference + root, xy) : dvec2(xy, root - difference);
    const double length = std::sqrt(dot(axis, axis));
    return length > 0 ? axis / length : dvec2(1, 0);
}

/// Returns the squared distance from p to the segment ab, in units.
double squared_distance(const ClipperLib::IntPoint& p, const ClipperLib::IntPoint& a,
                        const ClipperLib::IntPoint& b) {
    const dvec2 way(static_cast<double>(b.X - a.X), static_cast<double>(b.Y - a.Y));
    dvec2 rest(static_cast<double>(p.X - a.X), static_cast<double>(p.Y - a.Y));
    const double length = dot(way, way);
    if (length > 0) rest -= way * std::clamp(dot(rest, way) / length, 0.0, 1.0);
    return dot(rest, rest);
}

/// Simplifies a ring by Douglas and Peucker (1973), split at its first point and the point farthest from it.
ClipperLib::Path simplified_ring(const ClipperLib::Path& ring, double tolerance) {
    const std::size_t n = ring.size();
    if (n <= 3) return ring;
    struct Chain {
        std::size_t first;
        std::size_t last;
    };
    const auto farthest = [&](Chain chain, double& most) {
        std::size_t found = chain.first;
        for (std::size_t i = chain.first + 1; i < chain.last; ++i) {
            const double d = squared_distance(ring[i], ring[chain.first], ring[chain.last % n]);
            if (d > most) {
                most = d;
                found = i;
            }
        }
        return found;
    };
    std::vector<bool> kept(n, false);
    double most = -1;
    const std::size_t opposite = farthest({0, n}, most);
    kept[0] = kept[opposite] = true;
    std::vector<Chain> open = {{0, opposite}, {opposite, n}};
    while (!open.empty()) {
        const Chain chain = open.back();
        open.pop_back();
        most = tolerance * tolerance;
        const std::size_t split = farthest(chain, most);
        if (split == chain.first) continue;
        kept[split] = true;
        open.push_back({chain.first, split});
        open.push_back({split, chain.last});
    }
    ClipperLib::Path simple;
    for (std::size_t i = 0; i < n; ++i) {
        if (kept[i]) simple.push_back(ring[i]);
    }
    return simple;
}

Polygons combined(ClipperLib::ClipType how, const Polygons& a, const Polygons& b) {
    ClipperLib::Clipper clipper;
    clipper.AddPaths(a, ClipperLib::ptSubject, true);
    clipper.AddPaths(b, ClipperLib::ptClip, true);
    Polygons result;
    clipper.Execute(how, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    return result;
}

Rect box_of(const ClipperLib::Path& polygon) {
    Rect box;
    for (const ClipperLib::IntPoint& point : polygon)
        box = unite(box, Rect{to_point(point), to_point(point)});
    return box;
}

/// Joins the two lines that end at a point. A ring that was opened there continues through it.
void join_at(const ClipperLib::IntPoint& point, Polygons& lines) {
    std::vector<std::size_t> ending;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].front() == point || lines[i].back() == point) ending.push_back(i);
    }
    if (ending.size() != 2) return;
    ClipperLib::Path& first = lines[ending[0]];
    ClipperLib::Path& second = lines[ending[1]];
    if (first.back() != point) std::ranges::reverse(first);
    if (second.front() != point) std::ranges::reverse(second);
    first.insert(first.end(), second.begin() + 1, second.end());
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(ending[1]));
}

/// A border of a union, and the index of the one that directly encloses it; -1: none.
struct Border {
    const ClipperLib::PolyNode* node;
    int parent;
};

/// Returns the borders of the polygons' union, breadth first. `tree` holds their points.
std::vector<Border> borders_of(const Polygons& polygons, ClipperLib::PolyTree& tree) {
    ClipperLib::Clipper clipper;
    clipper.AddPaths(polygons, ClipperLib::ptSubject, true);
    clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    std::vector<Border> borders;
    const auto take = [&](const ClipperLib::PolyNode& node, int parent) {
        for (const ClipperLib::PolyNode* child : node.Childs) borders.push_back({child, parent});
    };
    take(tree, -1);
    for (std::size_t i = 0; i < borders.size(); ++i) take(*borders[i].node, static_cast<int>(i));
    return borders;
}

}  // namespace

double Segment::length() const { return std::sqrt(dot(b - a, b - a)); }

Polygons to_polygons(const std::vector<Contour>& contours) {
    Polygons polygons;
    polygons.reserve(contours.size());
    for (const Contour& contour : contours) polygons.push_back(to_polygon(contour.points));
    return polygons;
}

ClipperLib::Path to_polygon(const std::vector<dvec2>& points) {
    ClipperLib::Path polygon;
    polygon.reserve(points.size());
    for (const dvec2& p : points) polygon.emplace_back(to_units(p.x), to_units(p.y));
    return polygon;
}

std::vector<dvec2> to_points(const ClipperLib::Path& polygon) {
    std::vector<dvec2> points;
    points.reserve(polygon.size());
    for (const ClipperLib::IntPoint& p : polygon) points.push_back(to_point(p));
    return points;
}

double area_of(const Polygons& polygons) {
    double sum = 0;
    for (const ClipperLib::Path& polygon : polygons) sum += ClipperLib::Area(polygon);
    return sum / (polygon_scale * polygon_scale);
}

double perimeter_of(const Polygons& polygons) {
    double sum = 0;
    each_edge(polygons, [&](dvec2 a, dvec2 b) { sum += Segment{a, b}.length(); });
    return sum;
}

Polygons offset_polygons(const Polygons& polygons, double by) {
    constexpr double miter_limit = 2;
    constexpr double arc_tolerance = 0.005 * polygon_scale;
    ClipperLib::ClipperOffset offset(miter_limit, arc_tolerance);
    offset.AddPaths(polygons, by > 0 ? ClipperLib::jtRound : ClipperLib::jtMiter,
                    ClipperLib::etClosedPolygon);
    Polygons result;
    offset.Execute(result, by * polygon_scale);
    return result;
}

Polygons erode_polygons(const Polygons& polygons, double radius) {
    constexpr double min_step = 0.25;  // mm
    Polygons result;
    for (Polygons& piece : split_pieces(polygons)) {
        const Interval x = extent(piece, {1, 0}), y = extent(piece, {0, 1});
        if (std::min(x.width(), y.width()) < 2 * radius) continue;
        double step = min_step;
        for (double done = 0; done < radius && !piece.empty(); done += step) {
            step = std::min(std::max(min_step, done), radius - done);
            piece = offset_polygons(piece, -step);
        }
        result.insert(result.end(), piece.begin(), piece.end());
    }
    return result;
}

Polygons subtract_polygons(const Polygons& a, const Polygons& b) {
    return combined(ClipperLib::ctDifference, a, b);
}

Polygons unite_polygons(const Polygons& a, const Polygons& b) { return combined(ClipperLib::ctUnion, a, b); }

Polygons intersect_polygons(const Polygons& a, const Polygons& b) {
    return combined(ClipperLib::ctIntersection, a, b);
}

std::vector<NestedPolygon> nested_polygons(const Polygons& polygons) {
    ClipperLib::PolyTree tree;
    std::vector<NestedPolygon> nested;
    for (const auto& [node, parent] : borders_of(polygons, tree)) {
        const int depth = parent < 0 ? 0 : nested[static_cast<std::size_t>(parent)].depth + 1;
        nested.push_back({node->Contour, depth});
    }
    return nested;
}

std::vector<Contour> to_contours(const Polygons& polygons) {
    ClipperLib::PolyTree tree;
    std::vector<Contour> contours;
    for (const auto& [node, parent] : borders_of(polygons, tree))
        contours.push_back({to_points(node->Contour), parent, node->IsHole()});
    return contours;
}

std::vector<ClipperLib::Path> rings_inside(const Polygons& rings, const Polygons& polygons) {
    std::vector<Rect> boxes;
    boxes.reserve(polygons.size());
    for (const ClipperLib::Path& polygon : polygons) boxes.push_back(box_of(polygon));
    std::vector<ClipperLib::Path> lines;
    for (ClipperLib::Path ring : rings) {
        if (ring.empty()) continue;
        const Rect box = box_of(ring);
        ring.push_back(ring.front());
        ClipperLib::Clipper clipper;
        clipper.AddPath(ring, ClipperLib::ptSubject, false);
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            if (!intersect(box, boxes[i]).empty()) clipper.AddPath(polygons[i], ClipperLib::ptClip, true);
        }
        ClipperLib::PolyTree tree;
        clipper.Execute(ClipperLib::ctIntersection, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
        Polygons stretches;
        ClipperLib::OpenPathsFromPolyTree(tree, stretches);
        join_at(ring.front(), stretches);
        lines.insert(lines.end(), stretches.begin(), stretches.end());
    }
    return lines;
}

Polygons around_lines(const std::vector<ClipperLib::Path>& lines, double reach) {
    ClipperLib::ClipperOffset offset(2, 0.005 * polygon_scale);
    offset.AddPaths(lines, ClipperLib::jtRound, ClipperLib::etOpenRound);
    Polygons result;
    offset.Execute(result, reach * polygon_scale);
    return result;
}

std::vector<Polygons> split_pieces(const Polygons& polygons) {
    const auto outers =
        std::ranges::count_if(polygons, [](const auto& p) { return ClipperLib::Area(p) > 0; });
    if (outers == 0) return {};
    if (outers == 1) return {polygons};
    ClipperLib::Clipper clipper;
    clipper.AddPaths(polygons, ClipperLib::ptSubject, true);
    ClipperLib::PolyTree tree;
    clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    std::vector<Polygons> pieces;
    for (const ClipperLib::PolyNode* outer : tree.Childs) collect_pieces(*outer, pieces);
    return pieces;
}

Polygons simplified(const Polygons& polygons, double tolerance) {
    Polygons result;
    for (const ClipperLib::Path& polygon : polygons) {
        ClipperLib::Path simple = simplified_ring(polygon, tolerance * polygon_scale);
        if (simple.size() >= 3) result.push_back(std::move(simple));
    }
    return result;
}

Interval extent(const Polygons& polygons, dvec2 direction) {
    Interval interval;
    each_edge(polygons, [&](dvec2, dvec2 b) {
        interval.lo = std::min(interval.lo, dot(direction, b));
        interval.hi = std::max(interval.hi, dot(direction, b));
    });
    return interval;
}

std::vector<Segment> cut_lines(const Polygons& polygons, dvec2 direction, double first, double pitch,
                               int count) {
    struct Crossing {
        int line;
        double along;
    };
    const dvec2 normal = left_of(direction);
    std::vector<Crossing> crossings;
    each_edge(polygons, [&](dvec2 a, dvec2 b) {
        if (dot(normal, a) > dot(normal, b)) std::swap(a, b);
        const double lo = dot(normal, a);
        const double hi = dot(normal, b);
        const auto line_from = [&](double v) {  // first line at or beyond v
            return static_cast<int>(std::clamp(std::ceil((v - first) / pitch), 0.0, double(count)));
        };
        // Half-open: a vertex on a line belongs to the edge that rises from it.
        for (int line = line_from(lo), end = line_from(hi); line < end; ++line) {
            const double t = std::clamp((first + line * pitch - lo) / (hi - lo), 0.0, 1.0);
            crossings.push_back({line, dot(direction, a + (b - a) * t)});
        }
    });
    std::ranges::sort(crossings, [](const Crossing& a, const Crossing& b) {
        return a.line != b.line ? a.line < b.line : a.along < b.along;
    });
    std::vector<Segment> segments;
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const dvec2 base = normal * (first + crossings[i].line * pitch);
        segments.push_back(
            {base + direction * crossings[i].along, base + direction * crossings[i + 1].along});
    }
    return segments;
}

Segment longest_chord(const Polygons& polygons) {
    constexpr int tries = 9;
    const dvec2 axis = principal_axis(polygons);
    const Interval across = extent(polygons, left_of(axis));
    const double pitch = across.width() / tries;
    Segment longest{};
    for (const Segment& chord : cut_lines(polygons, axis, across.lo + pitch / 2, pitch, tries)) {
        if (chord.length() > longest.length()) longest = chord;
    }
    return longest;
}

}  // namespace lamella
