// Walks a part's layers on pictures of them: whether all that hangs is held by support tips, and how much
// dense support straight down would take.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "engine/surveys/overhang_survey.h"
#include "procedural/scaffold/scaffold.h"
#include "tests/procedural/foam/layer_picture.h"

namespace lamella {

/// Where tips of a scaffold hold the part: the points of the held that a connector really comes to.
inline std::vector<dvec3> held_places(const Scaffold& scaffold) {
    const ScaffoldShape& shape = scaffold.shape;
    std::vector<dvec3> places;
    for (const SupportPoint& point : scaffold.points) {
        const dvec3 tip = point.at - dvec3(0, 0, shape.gap > 0 ? shape.gap + shape.tip / 2 : 0);
        const auto comes = [&](const Beam& beam) { return glm::distance(beam.a, tip) < 1e-9; };
        if (std::any_of(scaffold.connectors.begin(), scaffold.connectors.end(), comes)) {
            places.push_back(point.at);
        }
    }
    return places;
}

/// What hangs unheld.
struct PartFindings {
    std::size_t hanging = 0;      ///< pixels of outlines that the layer below does not reach
    std::size_t unheld = 0;       ///< of them, those that nothing holds and that may not hang
    std::size_t own_bridges = 0;  ///< stretches left to hang between their ends
    std::string where;            ///< of the first finding
};

/// Looks at the outer half of the outermost bead of each layer, independently of the survey. A pixel of it
/// hangs when no pixel of the layer below lies within `overhang`. It is held within `spacing` of a place, not
/// above the lower side of its layer. Of what is left, connected stretches are allowed
///  - that are no longer across than `free_stretch`,
///  - that lie within half a width of a straight line no longer than `bridge`, with something held at both
///  its
///    ends: no further away than the overhang, so an edge from corner to corner may be laid like a bridge,
/// all to two pixels (the outline's place is known to one, that of the layer below to another).
class PartWalk {
  public:
    /// The layers are those of the grid.
    PartWalk(const LayerGrid& grid, const std::vector<LayerPicture>& layers, const OverhangLimits& limits)
        : grid_(grid), layers_(layers), limits_(limits), slack_(2 * grid.pixel) {}

    PartFindings run(std::vector<dvec3> places) {
        std::sort(places.begin(), places.end(), [](dvec3 a, dvec3 b) { return a.z < b.z; });
        findings_ = {};
        for (int i = 1; i < grid_.layers; ++i) look_at(i, places);
        return findings_;
    }

  private:
    using Stretch = std::vector<PixelPlace>;
    using Tips = std::span<const dvec3>;  ///< that may hold a layer

    const LayerPicture& layer(int i) const { return layers_[static_cast<std::size_t>(i)]; }
    double lower_side(int i) const { return grid_.bed + i * grid_.layer_height; }

    double reach() const { return limits_.spacing + slack_; }
    bool over_below(int x, int y, int i) const {
        return grid_.near(layer(i - 1), x, y, limits_.overhang + grid_.blur());
    }
    bool held(int x, int y, int i, Tips tips) const {
        const dvec3 p = grid_.place(x, y, lower_side(i));
        return over_below(x, y, i) || std::any_of(tips.begin(), tips.end(), [&](dvec3 tip) {
                   return glm::distance(p, tip) <= reach();
               });
    }
    /// Whether a pixel of a layer lies within `depth` mm of the void.
    bool near_void(const LayerPicture& picture, int x, int y, double depth) const {
        const double most = (depth + grid_.blur()) / grid_.pixel;
        const int r = static_cast<int>(most);
        for (int j = -r; j <= r; ++j) {
            for (int i = -r; i <= r; ++i) {
                if (i * i + j * j <= most * most && !picture.at(x + i, y + j)) return true;
            }
        }
        return false;
    }

    void look_at(int i, const std::vector<dvec3>& places) {
        const LayerPicture& here = layer(i);
        const double z = lower_side(i);
        const auto lowest =
            std::partition_point(places.begin(), places.end(), [&](dvec3 p) { return p.z < z - reach(); });
        const auto above =
            std::partition_point(places.begin(), places.end(), [&](dvec3 p) { return p.z <= z + 1e-6; });
        const Tips tips(lowest, above);
        LayerPicture unheld(here.width(), here.height());
        here.visit([&](int x, int y) {
            if (!near_void(here, x, y, limits_.width / 2) || over_below(x, y, i)) return;
            ++findings_.hanging;
            if (!held(x, y, i, tips)) unheld.set(x, y, true);
        });
        for (const Stretch& stretch : stretches(unheld)) judge(stretch, i, tips);
    }

    /// What is connected, also over a pixel left out where the part is thinner than that.
    static std::vector<Stretch> stretches(LayerPicture picture) {
        std::vector<Stretch> found;
        picture.visit([&](int x0, int y0) {
            Stretch stretch{{x0, y0}};
            picture.set(x0, y0, false);
            for (std::size_t k = 0; k < stretch.size(); ++k) {
                const PixelPlace p = stretch[k];
                for (int y = p.y - 2; y <= p.y + 2; ++y) {
                    for (int x = p.x - 2; x <= p.x + 2; ++x) {
                        if (!picture.at(x, y)) continue;
                        picture.set(x, y, false);
                        stretch.push_back({x, y});
                    }
                }
            }
            found.push_back(std::move(stretch));
        });
        return found;
    }

    void judge(const Stretch& stretch, int i, Tips tips) {
        const auto place = [&](PixelPlace p) { return dvec2(grid_.place(p.x, p.y, 0)); };
        // Its ends: the furthest from any, and the furthest from that.
        const auto furthest_from = [&](PixelPlace from) {
            return *std::max_element(stretch.begin(), stretch.end(), [&](PixelPlace a, PixelPlace b) {
                return glm::distance(place(a), place(from)) < glm::distance(place(b), place(from));
            });
        };
        const PixelPlace first = furthest_from(stretch.front()), last = furthest_from(first);
        const dvec2 a = place(first), chord = place(last) - a;
        const double length = std::sqrt(glm::dot(chord, chord));
        if (length <= limits_.free_stretch + slack_) return;
        const bool straight = std::all_of(stretch.begin(), stretch.end(), [&](PixelPlace p) {
            const dvec2 d = place(p) - a;
            return std::abs(chord.x * d.y - chord.y * d.x) / length <= limits_.width / 2 + slack_;
        });
        if (straight && length <= limits_.bridge + slack_ && held_about(first, i, tips) &&
            held_about(last, i, tips)) {
            ++findings_.own_bridges;
            return;
        }
        findings_.unheld += stretch.size();
        if (findings_.where.empty()) {
            findings_.where = std::to_string(a.x) + ", " + std::to_string(a.y) + ", " +
                              std::to_string(lower_side(i)) + ", " + std::to_string(length) + " mm";
        }
    }

    /// Whether something near a place of a layer is held.
    bool held_about(PixelPlace p, int i, Tips tips) const {
        const int r = static_cast<int>(std::ceil((limits_.overhang + slack_) / grid_.pixel));
        for (int y = p.y - r; y <= p.y + r; ++y) {
            for (int x = p.x - r; x <= p.x + r; ++x) {
                if (layer(i).at(x, y) && held(x, y, i, tips)) return true;
            }
        }
        return false;
    }

    const LayerGrid& grid_;
    const std::vector<LayerPicture>& layers_;
    const OverhangLimits limits_;
    double slack_;
    PartFindings findings_;
};

/// Dense support of the same part: its volume in mm^3.
class DenseSupport {
  public:
    DenseSupport(const LayerGrid& grid, const std::vector<LayerPicture>& layers, const OverhangLimits& limits)
        : grid_(grid), layers_(layers), limits_(limits) {}

    /// The union of the columns straight down, to the bed or the part below, from every pixel that hangs; but
    /// for connected regions no larger across than the free stretch, and those that one direction of eight
    /// leads through from hold to hold, everywhere within the length of a bridge.
    double volume() const {
        LayerPicture columns(layers_.front().width(), layers_.front().height());
        double pixels = 0;
        for (int i = grid_.layers - 1; i > 0; --i) {
            const LayerPicture hanging = needing_support(i);
            hanging.visit([&](int x, int y) { columns.set(x, y, true); });
            const LayerPicture& below = layers_[static_cast<std::size_t>(i - 1)];
            below.visit([&](int x, int y) { columns.set(x, y, false); });
            pixels += static_cast<double>(columns.count());
        }
        return pixels * grid_.pixel * grid_.pixel * grid_.layer_height;
    }

  private:
    LayerPicture needing_support(int i) const {
        const LayerPicture& here = layers_[static_cast<std::size_t>(i)];
        const LayerPicture& below = layers_[static_cast<std::size_t>(i - 1)];
        LayerPicture hanging(here.width(), here.height());
        here.visit([&](int x, int y) {
            if (!grid_.near(below, x, y, limits_.overhang + grid_.blur())) hanging.set(x, y, true);
        });
        LayerPicture left = hanging;
        hanging.visit([&](int x0, int y0) {
            if (!left.at(x0, y0)) return;
            std::vector<PixelPlace> region{{x0, y0}};
            left.set(x0, y0, false);
            for (std::size_t k = 0; k < region.size(); ++k) {
                for (int y = region[k].y - 1; y <= region[k].y + 1; ++y) {
                    for (int x = region[k].x - 1; x <= region[k].x + 1; ++x) {
                        if (!left.at(x, y)) continue;
                        left.set(x, y, false);
                        region.push_back({x, y});
                    }
                }
            }
            if (!small(region) && !bridged(region, here, hanging)) return;
            for (const PixelPlace p : region) hanging.set(p.x, p.y, false);
        });
        return hanging;
    }

    bool small(const std::vector<PixelPlace>& region) const {
        const auto [left, right] = std::minmax_element(region.begin(), region.end(),
                                                       [](PixelPlace a, PixelPlace b) { return a.x < b.x; });
        const auto [front, back] = std::minmax_element(region.begin(), region.end(),
                                                       [](PixelPlace a, PixelPlace b) { return a.y < b.y; });
        const double dx = right->x - left->x + 1, dy = back->y - front->y + 1;
        return std::sqrt(dx * dx + dy * dy) * grid_.pixel <= limits_.free_stretch;
    }

    bool bridged(const std::vector<PixelPlace>& region, const LayerPicture& here,
                 const LayerPicture& hanging) const {
        constexpr PixelPlace ways[] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}, {2, 1}, {1, 2}, {2, -1}, {1, -2}};
        return std::any_of(std::begin(ways), std::end(ways), [&](PixelPlace way) {
            const double step = std::sqrt(double(way.x * way.x + way.y * way.y)) * grid_.pixel;
            return std::all_of(region.begin(), region.end(), [&](PixelPlace p) {
                double length = step;
                for (const int side : {1, -1}) {
                    PixelPlace q = p;
                    while (hanging.at(q) && length <= limits_.bridge) {
                        q = {q.x + side * way.x, q.y + side * way.y};
                        length += step;
                    }
                    if (!here.at(q)) return false;
                }
                return length <= limits_.bridge;
            });
        });
    }

    const LayerGrid& grid_;
    const std::vector<LayerPicture>& layers_;
    OverhangLimits limits_;
};

}  // namespace lamella
