// Bottom-left placement: each row of the plate is searched from the left, and every overlap says by how much
// the shape has to move on.
#include "engine/layers/outline_nesting.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>

#include "engine/base/error.h"

namespace lamella {
namespace {

using Line = std::vector<Run>;

/// Unites a run with the sorted runs of a line.
void include(Run run, Line& line) {
    const auto first = std::ranges::partition_point(line, [&](const Run& r) { return r.end < run.begin; });
    auto last = first;
    for (; last != line.end() && last->begin <= run.end; ++last) {
        run.begin = std::min(run.begin, last->begin);
        run.end = std::max(run.end, last->end);
    }
    line.insert(line.erase(first, last), run);
}

/// Where a shape may lie: lower places come first.
struct Spot {
    int y = 0;
    std::int32_t x = 0;
};

class Plate {
  public:
    Plate(std::int32_t width, int height) : width_(width), taken_(static_cast<std::size_t>(height)) {}

    /// Returns the first spot from `from` on where a shape fits whose upper end lies below `top`.
    std::optional<Spot> spot_for(const NestTurn& shape, Spot from, int top) const {
        const int lines = static_cast<int>(shape.rows.lines());
        const int last = std::min(top, static_cast<int>(taken_.size())) - lines;
        for (int y = from.y; y <= last; ++y) {
            if (const auto x = leftmost(shape.rows, y, y == from.y ? from.x : 0, width_ - shape.width))
                return Spot{y, *x};
        }
        return std::nullopt;
    }

    /// Takes the shape's pixels and all that are nearer than `gap`.
    void take(const RunRows& shape, Spot at, std::int32_t gap) {
        const int reach = gap / run_unit;
        for (int l = 0; l < static_cast<int>(shape.lines()); ++l) {
            for (int d = -reach; d <= reach; ++d) {
                const int row = at.y + l + d;
                if (row < 0 || row >= static_cast<int>(taken_.size())) continue;
                const double away = static_cast<double>(d) * run_unit, all = gap;
                const auto half = static_cast<std::int32_t>(std::ceil(std::sqrt(all * all - away * away)));
                for (const Run& run : shape.line(static_cast<std::size_t>(l)))
                    include({run.begin + at.x - half, run.end + at.x + half},
                            taken_[static_cast<std::size_t>(row)]);
            }
        }
    }

  private:
    /// Returns the least x in [from, last] where the shape overlaps nothing, with its line 0 at row y.
    std::optional<std::int32_t> leftmost(const RunRows& shape, int y, std::int32_t from,
                                         std::int32_t last) const {
        std::int32_t x = from;
        const std::size_t lines = shape.lines();
        // Once all lines in a row are free at one x, none is left to look at.
        for (std::size_t free = 0, l = 0; free < lines; l = l + 1 == lines ? 0 : l + 1) {
            const std::int32_t moved = free_from(shape.line(l), taken_[static_cast<std::size_t>(y) + l], x);
            free = moved == x ? free + 1 : 1;
            x = moved;
            if (x > last) return std::nullopt;
        }
        return x <= last ? std::optional(x) : std::nullopt;
    }

    /// Returns the least x from which on a line of the shape overlaps no run of a taken line.
    static std::int32_t free_from(std::span<const Run> line, const Line& taken, std::int32_t x) {
        for (bool is_moved = !taken.empty(); is_moved;) {
            is_moved = false;
            for (const Run& run : line) {
                const auto other =
                    std::ranges::partition_point(taken, [&](const Run& r) { return r.end <= run.begin + x; });
                if (other == taken.end() || other->begin >= run.end + x) continue;
                x = other->end - run.begin;
                is_moved = true;
            }
        }
        return x;
    }

    std::int32_t width_;
    std::vector<Line> taken_;
};

class Nesting {
  public:
    Nesting(std::span<const NestShape> shapes, std::int32_t width, int height, std::int32_t gap)
        : shapes_(shapes), width_(width), height_(height), gap_(gap) {}

    NestPlace place(std::size_t shape) {
        for (std::size_t plate = 0; plate < plates_.size(); ++plate) {
            if (const auto found = place_on(plate, shape)) return *found;
        }
        plates_.emplace_back(width_, height_);
        if (const auto found = place_on(plates_.size() - 1, shape)) return *found;
        throw InputError("shape " + std::to_string(shape) + " is larger than the plate");
    }

  private:
    std::optional<NestPlace> place_on(std::size_t plate, std::size_t shape) {
        std::optional<NestPlace> best;
        int top = height_;
        for (std::size_t turn = 0; turn < shapes_[shape].turns.size(); ++turn) {
            const NestTurn& turned = shapes_[shape].turns[turn];
            // Plates only get fuller: what did not fit below a spot fits there no more.
            Spot& searched = searched_[{plate, shape, turn}];
            const auto spot = plates_[plate].spot_for(turned, searched, top);
            if (!spot) continue;
            searched = *spot;
            const int end = spot->y + static_cast<int>(turned.rows.lines());
            if (best && std::tuple(end, spot->x) >= std::tuple(top, best->x)) continue;
            top = end;
            best = NestPlace{shape, turn, static_cast<int>(plate), spot->x, spot->y};
        }
        if (best) plates_[plate].take(shapes_[shape].turns[best->turn].rows, {best->y, best->x}, gap_);
        return best;
    }

    std::span<const NestShape> shapes_;
    std::int32_t width_;
    int height_;
    std::int32_t gap_;
    std::vector<Plate> plates_;
    std::map<std::tuple<std::size_t, std::size_t, std::size_t>, Spot> searched_;
};

}  // namespace

std::vector<NestPlace> nest_outlines(std::span<const NestShape> shapes, std::int32_t width, int height,
                                     std::int32_t gap) {
    std::vector<std::size_t> order(shapes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater<>(),
                             [&](std::size_t i) { return shapes[i].turns.front().rows.total_length(); });
    Nesting nesting(shapes, width, height, gap);
    std::vector<NestPlace> places;
    for (const std::size_t shape : order) {
        for (int copy = 0; copy < shapes[shape].copies; ++copy) places.push_back(nesting.place(shape));
    }
    return places;
}

}  // namespace lamella
