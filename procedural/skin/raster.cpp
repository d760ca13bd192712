// Distance transform by lower envelopes of parabolas; components by flood fill with unwrapped coordinates.
#include "procedural/skin/raster.h"

#include <algorithm>
#include <array>
#include <limits>

namespace lamella {
namespace {

constexpr std::array<std::array<int, 2>, 8> neighbors{
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

/// Evaluates the lower envelope of the parabolas (x - i)^2 + heights[i], over all i, at `count` integers from
/// `first`.
void lower_envelope(const std::vector<std::int64_t>& heights, int first, int count,
                    std::vector<std::int64_t>& out) {
    const int n = static_cast<int>(heights.size());
    std::vector<int> apex;
    std::vector<double> from;  // where each parabola starts to be the lowest
    const auto height = [&](int i) { return heights[static_cast<std::size_t>(i)]; };
    for (int i = 0; i < n; ++i) {
        if (height(i) >= no_pixel) continue;
        double begin = -std::numeric_limits<double>::infinity();
        while (!apex.empty()) {
            const int k = apex.back();
            const auto rise = height(i) - height(k) + std::int64_t{i} * i - std::int64_t{k} * k;
            begin = static_cast<double>(rise) / (2.0 * (i - k));
            if (begin > from.back()) break;
            apex.pop_back();
            from.pop_back();
            begin = -std::numeric_limits<double>::infinity();
        }
        apex.push_back(i);
        from.push_back(begin);
    }
    out.assign(static_cast<std::size_t>(count), no_pixel);
    if (apex.empty()) return;
    std::size_t k = 0;
    for (int x = first; x < first + count; ++x) {
        while (k + 1 < apex.size() && from[k + 1] <= x) ++k;
        const std::int64_t way = x - apex[k];
        out[static_cast<std::size_t>(x - first)] = way * way + height(apex[k]);
    }
}

}  // namespace

std::size_t TiledMask::count() const {
    return static_cast<std::size_t>(std::count(marked.begin(), marked.end(), std::uint8_t{1}));
}

std::vector<std::int64_t> squared_distances(const TiledMask& mask) {
    const int w = mask.width, h = mask.height;
    std::vector<std::int64_t> squares(mask.marked.size(), no_pixel), line, found;
    // Three copies of a line give the middle one its neighbours across both borders.
    for (int x = 0; x < w; ++x) {
        line.clear();
        for (int k = 0; k < 3 * h; ++k) line.push_back(mask.marked[mask.index(x, k % h)] ? 0 : no_pixel);
        lower_envelope(line, h, h, found);
        for (int y = 0; y < h; ++y) squares[mask.index(x, y)] = found[static_cast<std::size_t>(y)];
    }
    for (int y = 0; y < h; ++y) {
        line.clear();
        for (int k = 0; k < 3 * w; ++k) line.push_back(squares[mask.index(k % w, y)]);
        lower_envelope(line, w, w, found);
        for (int x = 0; x < w; ++x) squares[mask.index(x, y)] = found[static_cast<std::size_t>(x)];
    }
    return squares;
}

std::vector<TiledComponent> components_of(const TiledMask& mask) {
    struct Place {
        int x, y;  ///< unwrapped
    };
    constexpr int unseen = std::numeric_limits<int>::min();
    std::vector<Place> seen(mask.marked.size(), Place{unseen, 0});
    std::vector<TiledComponent> components;
    std::vector<Place> open;
    const auto wrapped = [&](Place p) {
        return mask.index((p.x % mask.width + mask.width) % mask.width,
                          (p.y % mask.height + mask.height) % mask.height);
    };
    for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < mask.width; ++x) {
            if (!mask.marked[mask.index(x, y)] || seen[mask.index(x, y)].x != unseen) continue;
            TiledComponent& component = components.emplace_back();
            seen[mask.index(x, y)] = {x, y};
            open.assign(1, {x, y});
            while (!open.empty()) {
                const Place at = open.back();
                open.pop_back();
                component.pixels.push_back(static_cast<std::uint32_t>(wrapped(at)));
                for (const auto& step : neighbors) {
                    const Place next{at.x + step[0], at.y + step[1]};
                    const std::size_t i = wrapped(next);
                    if (!mask.marked[i]) continue;
                    if (seen[i].x == unseen) {
                        seen[i] = next;
                        open.push_back(next);
                    } else if (seen[i].x != next.x || seen[i].y != next.y) {
                        component.goes_on = true;
                    }
                }
            }
        }
    }
    return components;
}

}  // namespace lamella
