// Steps between neighbours, once for each pair; then a walk over the offsets of each window.
#include "procedural/texture/site_windows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/texture/carried_tangent.h"

namespace lamella {

namespace {

constexpr int largest_size = 11;

/// A step to a neighbour, in the frame of the site that it leaves, in spacings; and the frame there.
struct Step {
    float x, y;
    float cosine, sine;  ///< of the angle from the frame of the site to that of the neighbour
};

std::vector<Step> steps_of(const SurfaceSites& sites) {
    std::vector<Step> steps(sites.adjacent.size());
    parallel_for(sites.size(), [&](std::size_t i) {
        const dvec3 n = sites.normals[i], t = sites.tangents[i], b = glm::cross(n, t);
        for (std::size_t k = sites.first[i]; k < sites.first[i + 1]; ++k) {
            const std::size_t other = sites.adjacent[k];
            const dvec3 way = sites.way(sites.places[i], sites.places[other]);
            dvec2 flat(glm::dot(way, t), glm::dot(way, b));
            const double length = std::sqrt(glm::dot(flat, flat));
            if (length > 0) flat *= std::sqrt(glm::dot(way, way)) / length;
            flat /= sites.spacing;
            const dvec3 there = sites.tangents[other], up = glm::cross(sites.normals[other], there);
            const dvec3 here = carried_tangent(t, n, sites.normals[other]);
            dvec2 turn(glm::dot(here, there), -glm::dot(here, up));
            const double size = std::sqrt(glm::dot(turn, turn));
            turn = size > 0 ? turn / size : dvec2(1, 0);
            steps[k] = {static_cast<float>(flat.x), static_cast<float>(flat.y), static_cast<float>(turn.x),
                        static_cast<float>(turn.y)};
        }
    });
    return steps;
}

/// A site of a window: where it lies in the window, in spacings, and how its frame is turned.
struct Found {
    std::uint32_t site = 0;
    float x = 0, y = 0;
    float cosine = 1, sine = 0;
};

struct Offset {
    int across, up;
    std::size_t place, before;  ///< in the window; `before` is one step nearer to the middle
};

/// Returns the offsets of a window but the middle one, the nearest first.
std::vector<Offset> outward_offsets(const SiteWindows& windows) {
    std::vector<Offset> offsets;
    const int radius = windows.radius();
    for (int up = -radius; up <= radius; ++up) {
        for (int across = -radius; across <= radius; ++across) {
            if (across == 0 && up == 0) continue;
            const bool goes_across = std::abs(across) >= std::abs(up);
            const int left = goes_across ? across - (across > 0 ? 1 : -1) : across,
                      below = goes_across ? up : up - (up > 0 ? 1 : -1);
            offsets.push_back({across, up, windows.place(across, up), windows.place(left, below)});
        }
    }
    std::ranges::stable_sort(offsets, {}, [](const Offset& o) { return o.across * o.across + o.up * o.up; });
    return offsets;
}

class WindowWalk {
  public:
    WindowWalk(const SurfaceSites& sites, SiteWindows& windows)
        : sites_(sites), windows_(windows), steps_(steps_of(sites)), offsets_(outward_offsets(windows)) {}

    void fill(std::size_t middle) const {
        std::array<Found, static_cast<std::size_t>(largest_size) * largest_size> found;
        std::uint32_t* const window = &windows_.sites[middle * windows_.area()];
        const auto site = static_cast<std::uint32_t>(middle);
        found[windows_.place(0, 0)].site = window[windows_.place(0, 0)] = site;
        for (const Offset& offset : offsets_) {
            found[offset.place] = next(found[offset.before], offset);
            window[offset.place] = found[offset.place].site;
        }
    }

  private:
    /// Returns the neighbour that is nearest to an offset; the site itself if it has none.
    Found next(const Found& from, const Offset& offset) const {
        Found best = from;
        float least = infinity_of_float;
        for (std::size_t k = sites_.first[from.site]; k < sites_.first[from.site + 1]; ++k) {
            const Step& step = steps_[k];
            const float x = from.x + from.cosine * step.x - from.sine * step.y,
                        y = from.y + from.sine * step.x + from.cosine * step.y;
            const float right = x - static_cast<float>(offset.across), up = y - static_cast<float>(offset.up);
            const float square = right * right + up * up;
            if (!(square < least)) continue;
            least = square;
            best = {sites_.adjacent[k], x, y, from.cosine * step.cosine - from.sine * step.sine,
                    from.sine * step.cosine + from.cosine * step.sine};
        }
        return best;
    }

    static constexpr float infinity_of_float = std::numeric_limits<float>::infinity();
    const SurfaceSites& sites_;
    SiteWindows& windows_;
    std::vector<Step> steps_;
    std::vector<Offset> offsets_;
};

}  // namespace

SiteWindows site_windows(const SurfaceSites& sites, int size) {
    if (size < 3 || size > largest_size || size % 2 == 0)
        throw InputError("a window of " + std::to_string(size) + " sites; expected 3, 5, 7, 9 or 11");
    SiteWindows windows;
    windows.size = size;
    windows.sites.resize(sites.size() * windows.area());
    const WindowWalk walk(sites, windows);
    parallel_for(sites.size(), [&](std::size_t i) { walk.fill(i); });
    return windows;
}

}  // namespace lamella
