// Prim's algorithm with a priority queue that may hold outdated entries, and the bars of its tree.
#include "printers/vector/tie_bars.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <span>

#include "printers/polygons/nearest_points.h"

namespace lamella {
namespace {

/// Sample points along all outlines, piece by piece.
struct Samples {
    std::vector<dvec2> points;
    std::vector<std::size_t> owners;
    std::vector<std::size_t> begins;  ///< first sample of each piece, and the number of samples
};

Samples sample_outlines(const std::vector<Polygons>& pieces, double spacing) {
    Samples samples;
    for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
        samples.begins.push_back(samples.points.size());
        for (const ClipperLib::Path& outline : pieces[piece]) {
            const std::vector<dvec2> points = to_points(outline);
            double next = 0;  // distance to the next sample
            for (std::size_t i = 0; i < points.size(); ++i) {
                const dvec2 way = points[(i + 1) % points.size()] - points[i];
                const double length = std::sqrt(dot(way, way));
                for (; next < length; next += spacing)
                    samples.points.push_back(points[i] + way * (next / length));
                next -= length;
            }
        }
        samples.owners.resize(samples.points.size(), piece);
    }
    samples.begins.push_back(samples.points.size());
    return samples;
}

dvec2 nearest_on(const Polygons& piece, dvec2 from) {
    dvec2 nearest = from;
    double least = infinity;
    for (const ClipperLib::Path& outline : piece) {
        const std::vector<dvec2> points = to_points(outline);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const dvec2 way = points[(i + 1) % points.size()] - points[i];
            const double length = dot(way, way);
            const double t = length > 0 ? std::clamp(dot(from - points[i], way) / length, 0.0, 1.0) : 0;
            const dvec2 at = points[i] + way * t;
            const double d = dot(at - from, at - from);
            if (d >= least) continue;
            least = d;
            nearest = at;
        }
    }
    return nearest;
}

ClipperLib::Path bar(dvec2 a, dvec2 b, double width) {
    const dvec2 way = b - a;
    const double length = std::sqrt(dot(way, way));
    const dvec2 along = length > 0 ? way / length : dvec2(1, 0);
    const dvec2 side = dvec2(-along.y, along.x) * (width / 2);
    a -= along * (width / 4);
    b += along * (width / 4);
    return to_polygon({a - side, b - side, b + side, a + side});
}

/// Among the samples of one piece near `from` that face another piece at about the least distance, returns
/// the middle one: a bar between straight borders should not overhang a corner.
dvec2 middle_of_facing(std::span<const dvec2> samples, const Polygons& other, dvec2 from, double width) {
    const auto distance = [](dvec2 a, dvec2 b) { return std::sqrt(dot(b - a, b - a)); };
    const double longest = distance(from, nearest_on(other, from)) + width / 8;
    std::vector<dvec2> facing;
    dvec2 sum{0};
    for (const dvec2& p : samples) {
        if (distance(p, from) > 2 * width || distance(p, nearest_on(other, p)) > longest) continue;
        facing.push_back(p);
        sum += p;
    }
    if (facing.empty()) return from;
    const dvec2 mean = sum / static_cast<double>(facing.size());
    return *std::ranges::min_element(facing, {}, [&](dvec2 p) { return distance(p, mean); });
}

struct Neighbour {
    double distance;  ///< squared, mm^2
    std::size_t from, to;
    bool operator>(const Neighbour& other) const {
        if (distance != other.distance) return distance > other.distance;
        return from != other.from ? from > other.from : to > other.to;
    }
};

}  // namespace

Polygons tie_bars(const std::vector<Polygons>& pieces, double width) {
    Polygons bars;
    if (pieces.size() < 2) return bars;
    const Samples samples = sample_outlines(pieces, width / 2);
    NearestPoints loose(samples.points);
    std::vector<bool> joined(pieces.size(), false);
    std::priority_queue<Neighbour, std::vector<Neighbour>, std::greater<>> queue;
    const auto look_from = [&](std::size_t from) {
        if (loose.empty()) return;
        const std::size_t to = loose.nearest(samples.points[from]);
        const dvec2 way = samples.points[to] - samples.points[from];
        queue.push({dot(way, way), from, to});
    };
    const auto join = [&](std::size_t piece) {
        joined[piece] = true;
        for (std::size_t i = samples.begins[piece]; i < samples.begins[piece + 1]; ++i) loose.remove(i);
        for (std::size_t i = samples.begins[piece]; i < samples.begins[piece + 1]; ++i) look_from(i);
    };
    join(0);
    while (bars.size() + 1 < pieces.size()) {
        const Neighbour next = queue.top();
        queue.pop();
        const std::size_t piece = samples.owners[next.to];
        if (joined[piece]) {  // already joined by another bar
            look_from(next.from);
            continue;
        }
        const std::size_t owner = samples.owners[next.from];
        const std::span<const dvec2> along(samples.points.data() + samples.begins[owner],
                                           samples.points.data() + samples.begins[owner + 1]);
        const dvec2 from = middle_of_facing(along, pieces[piece], samples.points[next.from], width);
        const dvec2 b = nearest_on(pieces[piece], from);
        bars.push_back(bar(nearest_on(pieces[owner], b), b, width));
        join(piece);
    }
    return bars;
}

}  // namespace lamella
