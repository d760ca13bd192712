// A priority queue of the best bar of every element and direction. A bar is checked against the part when it
// is taken from the queue. Once a bar is made, only the elements near it are updated.
#include "procedural/scaffold/scaffold_synthesis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>
#include <string>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/scaffold/bridge_sweep.h"
#include "procedural/scaffold/support_router.h"

namespace lamella {
namespace {

/// A bar with enough clearance, and the legs under its ends.
struct CheckedBar {
    BridgeCandidate bar;
    Leg first, last;
};

/// State of the search for the best bar through one element in one direction.
struct Anchor {
    std::optional<BridgeCandidate> best;
    std::optional<CheckedBar> checked;
    std::vector<std::array<std::int64_t, 3>> refused;
    std::uint32_t version = 0;
};

struct Entry {
    double score;
    std::size_t anchor;
    std::uint32_t version;
    bool operator<(const Entry& other) const {
        return score != other.score ? score < other.score : anchor > other.anchor;
    }
};

/// Returns the point on a bar's upper side where the connector to something above it stands.
dvec3 nearest_on(const ScaffoldBar& bar, dvec3 above) {
    const dvec2 way = dvec2(bar.b) - dvec2(bar.a);
    const double share = glm::dot(dvec2(above) - dvec2(bar.a), way) / glm::dot(way, way);
    return bar.a + dvec3(way * std::min(std::max(share, 0.0), 1.0), 0);
}

void check_shape(const ScaffoldShape& shape) {
    const auto require = [](bool holds, const char* message) {
        if (!holds) throw InputError(std::string("scaffold: ") + message);
    };
    constexpr double shortest = 0.001, longest = 1e6;
    const auto sensible = [](double v) { return v >= shortest && v <= longest; };
    require(std::abs(shape.bed) <= longest, "the bed's height must be a number of at most 1000000 mm");
    for (const double length : {shape.layer_height, shape.bridge, shape.reach, shape.connector, shape.tip,
                                shape.pillar, shape.wall, shape.bar_width, shape.bar_height, shape.foot,
                                shape.foot_height, shape.lean, shape.longest_connector}) {
        require(sensible(length), "every length of its shape, and its lean, must be 0.001 to 1000000 mm");
    }
    require(shape.clearance >= 0 && shape.clearance <= longest, "the clearance must be 0 mm or more");
    require(shape.gap >= 0 && shape.gap <= longest, "the gap must be 0 mm or more");
    require(shape.round_pillars || shape.wall <= shape.pillar,
            "the walls of its pillars must be no thicker than the pillars");
    require(shape.connector < shape.longest_connector,
            "the longest connector must be longer than the shortest");
}

void check_points(std::span<const SupportPoint> points) {
    constexpr double furthest = 1e6;
    for (const SupportPoint& point : points) {
        for (const double v : {point.at.x, point.at.y, point.at.z}) {
            if (!(std::abs(v) <= furthest)) {
                throw InputError("scaffold: a support point must lie within 1000000 mm of the origin");
            }
        }
    }
}

class Synthesis {
  public:
    Synthesis(std::span<const SupportPoint> points, const Field& part, const ScaffoldShape& shape,
              const SynthesisOptions& options)
        : space_(part, shape.bed),
          legs_(space_, shape),
          sweep_(shape),
          options_(options),
          arena_(options.threads) {
        scaffold_.shape = shape;
        scaffold_.points.assign(points.begin(), points.end());
    }

    Scaffold run() {
        find_legs();
        if (scaffold_.shape.bridges) make_bars();
        stand();
        return std::move(scaffold_);
    }

  private:
    static constexpr std::size_t max_refused = 12;  // bars per anchor; if so many fail, the rest will, too
    static constexpr auto directions = static_cast<std::size_t>(BridgeSweep::directions);

    bool cancelled() const { return options_.cancel && options_.cancel->cancelled(); }
    void stop_if_cancelled() const {
        if (cancelled()) throw Interrupted("stopped while supports were planned");
    }
    template <typename Work>
    void in_parallel(std::size_t count, const Work& work) {
        arena_.execute([&] {
            parallel_for(count, [&](std::size_t i) {
                if (!cancelled()) work(i);
            });
        });
        stop_if_cancelled();
    }
    void find_legs();
    void make_bars();
    void look_again(const std::vector<std::size_t>& elements);
    void look_again_at(std::size_t anchor_number);
    std::optional<CheckedBar> check(const BridgeCandidate& candidate);
    const std::optional<Leg>& leg_under(dvec3 end);
    bool reaches(std::size_t element, dvec3 bar_point) const;
    dvec3 under(const BridgeCandidate& bar, std::size_t element) const {
        return nearest_on({bar.a, bar.b}, sweep_.elements()[element].touch);
    }
    void accept(const CheckedBar& checked);
    void append_near(dvec3 place, std::vector<std::size_t>& elements) const;
    std::optional<Beam> lean_on(std::size_t element) const;
    void stand();

    FreeSpace space_;
    SupportRouter legs_;
    BridgeSweep sweep_;
    SynthesisOptions options_;
    ThreadArena arena_;
    Scaffold scaffold_;
    std::vector<std::optional<Leg>> leg_of_;  ///< by element
    std::vector<Anchor> anchors_;             ///< index: element * directions + direction
    std::priority_queue<Entry> queue_;
    /// by position; ends are often tried again
    std::map<std::array<double, 3>, std::optional<Leg>> legs_of_ends_;
};

void Synthesis::find_legs() {
    const std::size_t count = scaffold_.points.size();
    leg_of_.resize(count);
    in_parallel(count, [&](std::size_t i) { leg_of_[i] = legs_.under_point(scaffold_.points[i].at); });
    for (std::size_t i = 0; i < count; ++i) {
        sweep_.add({legs_.tip_center(scaffold_.points[i].at),
                    leg_of_[i] ? leg_of_[i]->landing : scaffold_.shape.bed, false, true});
    }
}

/// Recomputes the best bar of an anchor.
void Synthesis::look_again_at(std::size_t number) {
    Anchor& anchor = anchors_[number];
    anchor.best = sweep_.best(number / directions, static_cast<int>(number % directions), anchor.refused);
    anchor.checked.reset();
    ++anchor.version;
    if (anchor.best) queue_.push({anchor.best->score, number, anchor.version});
}

/// Recomputes the best bars of some elements in all directions.
void Synthesis::look_again(const std::vector<std::size_t>& elements) {
    anchors_.resize(sweep_.elements().size() * directions);
    in_parallel(elements.size() * directions, [&](std::size_t k) {
        const std::size_t element = elements[k / directions];
        Anchor& anchor = anchors_[element * directions + k % directions];
        anchor.best.reset();
        if (anchor.refused.size() < max_refused) {
            anchor.best = sweep_.best(element, static_cast<int>(k % directions), anchor.refused);
        }
        anchor.checked.reset();
        ++anchor.version;
    });
    for (const std::size_t element : elements) {
        for (std::size_t d = 0; d < directions; ++d) {
            const std::size_t number = element * directions + d;
            const Anchor& anchor = anchors_[number];
            if (anchor.best) queue_.push({anchor.best->score, number, anchor.version});
        }
    }
}

bool Synthesis::reaches(std::size_t element, dvec3 bar_point) const {
    const double needed = scaffold_.shape.clearance + legs_.connector_radius();
    const ScaffoldElement& held = sweep_.elements()[element];
    return held.is_end ? space_.clear(held.touch, bar_point, needed)
                       : space_.clear_from_contact(held.touch, bar_point, needed);
}

const std::optional<Leg>& Synthesis::leg_under(dvec3 end) {
    const auto [found, fresh] = legs_of_ends_.try_emplace({end.x, end.y, end.z});
    if (fresh) found->second = legs_.under_bar(end);
    return found->second;
}

/// Returns the bar if it has enough clearance, its ends have legs, and its connectors are free. Drops
/// elements between the ends that its connectors cannot reach. Recomputes gain and score from the remaining
/// elements and the actual legs.
std::optional<CheckedBar> Synthesis::check(const BridgeCandidate& candidate) {
    const ScaffoldShape& shape = scaffold_.shape;
    CheckedBar checked{candidate, {}, {}};
    BridgeCandidate& bar = checked.bar;
    const dvec3 way = bar.b - bar.a;
    const double length = std::sqrt(glm::dot(way, way));
    const dvec3 beyond = way * (shape.bar_width / 2 / length);
    const dvec3 middle(0, 0, -shape.bar_height / 2), bottom(0, 0, -shape.bar_height);
    const double half =
        std::sqrt(shape.bar_width * shape.bar_width + shape.bar_height * shape.bar_height) / 2;
    if (!space_.clear(bar.a - beyond + middle, bar.b + beyond + middle, shape.clearance + half)) return {};
    const std::array<std::size_t, 2> ends{bar.held.front(), bar.held.back()};
    for (const std::size_t end : ends) {
        if (!reaches(end, under(bar, end))) return {};
    }
    std::erase_if(bar.held, [&](std::size_t element) {
        return element != ends[0] && element != ends[1] && !reaches(element, under(bar, element));
    });
    for (const auto& [end, leg] : {std::pair(bar.a, &checked.first), std::pair(bar.b, &checked.last)}) {
        const std::optional<Leg>& found = leg_under(end + bottom);
        if (!found) return {};
        *leg = *found;
    }
    double saved = 0, longest = 0;
    for (const std::size_t element : bar.held) {
        const ScaffoldElement& held = sweep_.elements()[element];
        saved += bar.a.z - held.landing;
        longest = std::max(longest, glm::distance(held.touch, under(bar, element)));
    }
    const BridgeScore worth(shape);
    bar.gain = worth.gain(saved, checked.first.length + checked.last.length + 2 * shape.bar_height, length);
    bar.score = worth.score(bar.gain, bar.held.size(), longest);
    if (bar.gain <= 0) return {};
    return checked;
}

void Synthesis::make_bars() {
    std::vector<std::size_t> all(sweep_.elements().size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    look_again(all);
    while (!queue_.empty()) {
        stop_if_cancelled();
        const Entry entry = queue_.top();
        queue_.pop();
        Anchor& anchor = anchors_[entry.anchor];
        if (entry.version != anchor.version || !anchor.best) continue;
        if (!sweep_.elements()[entry.anchor / directions].open) continue;
        if (!anchor.checked) {
            anchor.checked = check(*anchor.best);
            if (!anchor.checked) {
                anchor.refused.push_back(anchor.best->key);
                if (anchor.refused.size() < max_refused) look_again_at(entry.anchor);
                continue;
            }
            // A bar that is worth less than estimated goes back into the queue.
            if (anchor.checked->bar.score < entry.score) {
                queue_.push({anchor.checked->bar.score, entry.anchor, anchor.version});
                continue;
            }
        }
        accept(*anchor.checked);
    }
}

void Synthesis::accept(const CheckedBar& checked) {
    const CheckedBar made = checked;
    scaffold_.bars.push_back({made.bar.a, made.bar.b});
    if (options_.on_progress) options_.on_progress(scaffold_.bars.size());
    const double radius = legs_.connector_radius();
    std::vector<std::size_t> changed;
    for (const std::size_t element : made.bar.held) {
        sweep_.close(element);
        const ScaffoldElement& held = sweep_.elements()[element];
        scaffold_.connectors.push_back(
            {held.touch, held.is_end ? radius : scaffold_.shape.tip / 2, under(made.bar, element), radius});
        append_near(held.touch, changed);
    }
    const dvec3 bottom(0, 0, -scaffold_.shape.bar_height);
    for (const auto& [end, leg] : {std::pair(made.bar.a, &made.first), std::pair(made.bar.b, &made.last)}) {
        sweep_.add({end + bottom, leg->landing, true, true});
        leg_of_.push_back(*leg);
        append_near(end, changed);
    }
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    look_again(changed);
}

void Synthesis::append_near(dvec3 place, std::vector<std::size_t>& elements) const {
    const std::vector<std::size_t> found = sweep_.near(place);
    elements.insert(elements.end(), found.begin(), found.end());
}

/// Returns the shortest connector from an open element down to a bar or pillar; none if the element's own leg
/// is shorter.
std::optional<Beam> Synthesis::lean_on(std::size_t element) const {
    const ScaffoldShape& shape = scaffold_.shape;
    const ScaffoldElement& open = sweep_.elements()[element];
    const double radius = legs_.connector_radius();
    const double least = open.is_end ? 2 * shape.layer_height : shape.connector;
    double shortest = leg_of_[element] ? leg_of_[element]->length : infinity;
    std::optional<Beam> best;
    const auto offer = [&](dvec3 foot) {
        const double length = glm::distance(foot, open.touch);
        if (length >= shortest || !reaches(element, foot)) return;
        shortest = length;
        best = Beam{open.touch, open.is_end ? radius : shape.tip / 2, foot, radius};
    };
    for (const ScaffoldBar& bar : scaffold_.bars) {
        const double rise = open.touch.z - bar.a.z;
        if (rise < least || rise > shape.longest_connector) continue;
        const dvec3 foot = nearest_on(bar, open.touch);
        const double lateral = glm::distance(dvec2(foot), dvec2(open.touch));
        if (lateral <= std::min(shape.reach, rise * shape.lean)) offer(foot);
    }
    for (const ScaffoldPillar& pillar : scaffold_.pillars) {
        const double lateral = glm::distance(pillar.at, dvec2(open.touch));
        const double z = std::min(open.touch.z - std::max(least, lateral / shape.lean), pillar.top);
        if (!open.is_end && lateral > shape.reach) continue;
        if (open.touch.z - z > shape.longest_connector) continue;
        if (z > pillar.bottom + shape.foot_height) offer({pillar.at, z});
    }
    return best;
}

/// Supports each element that is still open, highest first, by a connector to an existing bar or pillar or by
/// a leg of its own.
void Synthesis::stand() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < sweep_.elements().size(); ++i) {
        if (sweep_.elements()[i].open) open.push_back(i);
    }
    std::stable_sort(open.begin(), open.end(), [&](std::size_t a, std::size_t b) {
        return sweep_.elements()[a].touch.z > sweep_.elements()[b].touch.z;
    });
    for (const std::size_t element : open) {
        const auto connector = scaffold_.shape.bridges ? lean_on(element) : std::nullopt;
        if (connector) {
            scaffold_.connectors.push_back(*connector);
        } else if (const std::optional<Leg>& leg = leg_of_[element]) {
            scaffold_.connectors.insert(scaffold_.connectors.end(), leg->connectors.begin(),
                                        leg->connectors.end());
            if (leg->pillar) scaffold_.pillars.push_back(*leg->pillar);
        } else {
            scaffold_.unheld.push_back(element);
        }
    }
    std::sort(scaffold_.unheld.begin(), scaffold_.unheld.end());
}

}  // namespace

ScaffoldShape in_whole_layers(ScaffoldShape shape) {
    constexpr double share_of_layer = 1e-6;
    for (double* height : {&shape.bar_height, &shape.foot_height}) {
        *height = std::ceil(*height / shape.layer_height - share_of_layer) * shape.layer_height;
    }
    return shape;
}

Scaffold build_scaffold(std::span<const SupportPoint> points, const Field& part, const ScaffoldShape& shape,
                        const SynthesisOptions& options) {
    check_shape(shape);
    check_points(points);
    return Synthesis(points, part, in_whole_layers(shape), options).run();
}

}  // namespace lamella
