// A queue of the best bar of every element and direction. A bar is checked against the part when its turn
// comes; once it is made, only what lies near it is looked at again.
#include "procedural/scaffold_synthesis.h"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <string>

#include "engine/error.h"
#include "procedural/bridge_sweep.h"
#include "procedural/scaffold_legs.h"

namespace lamella {
namespace {

/// A bar that has room, with the legs of its ends.
struct CheckedBar {
    BridgeCandidate bar;
    Leg first, last;
};

/// An element with a direction: what the best bar is sought for.
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

void check_shape(const ScaffoldShape& shape) {
    const auto require = [](bool holds, const char* message) {
        if (!holds) throw InputError(std::string("scaffold: ") + message);
    };
    const auto positive = [](double v) { return v > 0 && std::isfinite(v); };
    require(std::isfinite(shape.bed), "the bed's height must be a number");
    for (const double length : {shape.layer_height, shape.bridge, shape.reach, shape.connector, shape.tip,
                                shape.pillar, shape.wall, shape.bar_width, shape.bar_height, shape.foot,
                                shape.foot_height, shape.lean, shape.longest_connector}) {
        require(positive(length), "every length of its shape must be above 0 mm");
    }
    require(shape.clearance >= 0 && std::isfinite(shape.clearance), "the clearance must be 0 mm or more");
    require(shape.gap >= 0 && std::isfinite(shape.gap), "the gap must be 0 mm or more");
    require(shape.connector < shape.longest_connector,
            "the longest connector must be longer than the shortest");
}

class Synthesis {
  public:
    Synthesis(std::span<const SupportPoint> points, const Field& part, const ScaffoldShape& shape,
              const SynthesisOptions& options)
        : space_(part, shape.bed),
          legs_(space_, shape),
          sweep_(shape),
          options_(options),
          arena_(options.threads > 0 ? options.threads : oneapi::tbb::info::default_concurrency()) {
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
    static constexpr auto directions = static_cast<std::size_t>(BridgeSweep::directions);

    template <typename Work>
    void in_parallel(std::size_t count, const Work& work) {
        arena_.execute(
            [&] { oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { work(i); }); });
        if (options_.cancel && options_.cancel->cancelled()) {
            throw Interrupted("stopped while supports were planned");
        }
    }
    void find_legs();
    void make_bars();
    void look_again(const std::vector<std::size_t>& elements);
    void look_again_at(std::size_t anchor_number);
    std::optional<CheckedBar> check(const BridgeCandidate& candidate) const;
    bool reaches(std::size_t element, dvec3 bar_point) const;
    dvec3 under(const BridgeCandidate& bar, std::size_t element) const;
    void accept(const CheckedBar& checked);
    void append_near(dvec3 place, std::vector<std::size_t>& elements) const;
    void stand();

    FreeSpace space_;
    LegFinder legs_;
    BridgeSweep sweep_;
    SynthesisOptions options_;
    oneapi::tbb::task_arena arena_;
    Scaffold scaffold_;
    std::vector<std::optional<Leg>> leg_of_;  ///< by element
    std::vector<Anchor> anchors_;             ///< by element, then direction
    std::priority_queue<Entry> queue_;
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

/// Finds the best bar of an anchor anew.
void Synthesis::look_again_at(std::size_t number) {
    Anchor& anchor = anchors_[number];
    anchor.best = sweep_.best(number / directions, static_cast<int>(number % directions), anchor.refused);
    anchor.checked.reset();
    ++anchor.version;
    if (anchor.best) queue_.push({anchor.best->score, number, anchor.version});
}

/// The same for all directions of some elements.
void Synthesis::look_again(const std::vector<std::size_t>& elements) {
    anchors_.resize(sweep_.elements().size() * directions);
    in_parallel(elements.size() * directions, [&](std::size_t k) {
        const std::size_t element = elements[k / directions];
        Anchor& anchor = anchors_[element * directions + k % directions];
        anchor.best = sweep_.best(element, static_cast<int>(k % directions), anchor.refused);
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

/// Where on the bar's upper side the connector to an element stands.
dvec3 Synthesis::under(const BridgeCandidate& bar, std::size_t element) const {
    const dvec3 way = bar.b - bar.a;
    const double length = std::sqrt(glm::dot(way, way));
    const double along = glm::dot(sweep_.elements()[element].touch - bar.a, way / length);
    return bar.a + way * (std::min(std::max(along, 0.0), length) / length);
}

bool Synthesis::reaches(std::size_t element, dvec3 bar_point) const {
    const double needed = scaffold_.shape.clearance + legs_.connector_radius();
    const ScaffoldElement& held = sweep_.elements()[element];
    return held.is_end ? space_.clear(held.touch, bar_point, needed)
                       : space_.clear_from_contact(held.touch, bar_point, needed);
}

/// Whether the bar has room, its ends stand, and what it holds can be reached. Elements between the ends that
/// cannot are left to others; gain and score become those of what is held by the legs there really are.
std::optional<CheckedBar> Synthesis::check(const BridgeCandidate& candidate) const {
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
        std::optional<Leg> found = legs_.under_bar(end + bottom);
        if (!found) return {};
        *leg = std::move(*found);
    }
    double saved = 0, longest = 0;
    for (const std::size_t element : bar.held) {
        const ScaffoldElement& held = sweep_.elements()[element];
        saved += bar.a.z - held.landing;
        longest = std::max(longest, glm::distance(held.touch, under(bar, element)));
    }
    bar.gain = saved - checked.first.length - checked.last.length - length;
    bar.score = bar.gain - static_cast<double>(bar.held.size()) * longest;
    if (bar.gain <= 0) return {};
    return checked;
}

void Synthesis::make_bars() {
    std::vector<std::size_t> all(sweep_.elements().size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    look_again(all);
    while (!queue_.empty()) {
        const Entry entry = queue_.top();
        queue_.pop();
        Anchor& anchor = anchors_[entry.anchor];
        if (entry.version != anchor.version || !anchor.best) continue;
        if (!sweep_.elements()[entry.anchor / directions].open) continue;
        if (!anchor.checked) {
            anchor.checked = check(*anchor.best);
            if (!anchor.checked) {
                anchor.refused.push_back(anchor.best->key);
                look_again_at(entry.anchor);
                continue;
            }
            // A bar worth less than it seemed has to wait for its turn.
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

/// Everything still open stands on its leg, or where one of the bars lies in the leg's way, on that.
void Synthesis::stand() {
    for (std::size_t element = 0; element < sweep_.elements().size(); ++element) {
        if (!sweep_.elements()[element].open) continue;
        const std::optional<Leg>& leg = leg_of_[element];
        if (!leg) {
            scaffold_.unheld.push_back(element);
            continue;
        }
        scaffold_.connectors.insert(scaffold_.connectors.end(), leg->connectors.begin(),
                                    leg->connectors.end());
        if (leg->pillar) scaffold_.pillars.push_back(*leg->pillar);
    }
}

}  // namespace

Scaffold build_scaffold(std::span<const SupportPoint> points, const Field& part, const ScaffoldShape& shape,
                        const SynthesisOptions& options) {
    check_shape(shape);
    return Synthesis(points, part, shape, options).run();
}

}  // namespace lamella
