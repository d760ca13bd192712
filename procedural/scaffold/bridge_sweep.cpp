// Builds the strip of an element and tries, for each height that an element allows, every interval of the
// strip that contains the anchor.
#include "procedural/scaffold/bridge_sweep.h"

#include <algorithm>

#include "engine/base/deterministic_math.h"

namespace lamella {
namespace {}  // namespace

BridgeScore::BridgeScore(const ScaffoldShape& shape) {
    const double pillar = shape.round_pillars ? pi / 4 * shape.pillar * shape.pillar
                                              : (2 * shape.pillar - shape.wall) * shape.wall;
    const double middle = (shape.tip + shape.bar_width) / 2;
    bar_ = share_of_bar * shape.bar_width * shape.bar_height / pillar;
    connector_ = pi / 4 * middle * middle / pillar;
}

BridgeSweep::BridgeSweep(const ScaffoldShape& shape)
    : shape_(shape),
      worth_(shape),
      reach_(std::sqrt(shape.bridge * shape.bridge + shape.reach * shape.reach)) {}

dvec2 BridgeSweep::along(int direction) {
    const SineCosine angle = sine_cosine(pi * direction / directions);
    return {angle.cosine, angle.sine};
}

std::size_t BridgeSweep::add(const ScaffoldElement& element) {
    const std::size_t number = elements_.size();
    elements_.push_back(element);
    grid_[grid_key(grid_cell(element.touch.x), grid_cell(element.touch.y))].push_back(number);
    return number;
}

template <typename Visit>
void BridgeSweep::visit_near(dvec2 place, const Visit& visit) const {
    const std::int64_t x = grid_cell(place.x), y = grid_cell(place.y);
    for (std::int64_t i = x - 1; i <= x + 1; ++i) {
        for (std::int64_t j = y - 1; j <= y + 1; ++j) {
            const auto found = grid_.find(grid_key(i, j));
            if (found == grid_.end()) continue;
            for (const std::size_t number : found->second) {
                if (elements_[number].open) visit(number);
            }
        }
    }
}

std::vector<std::size_t> BridgeSweep::near(dvec3 place) const {
    std::vector<std::size_t> numbers;
    visit_near(dvec2(place), [&](std::size_t number) { numbers.push_back(number); });
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

/// A connector has at least the minimum height of the shape and leans no more than it allows. A connector
/// between the end of one bar and another bar may be shorter, because it need not be broken off.
std::int64_t BridgeSweep::level_of(const ScaffoldElement& element, double lateral) const {
    const double least = element.is_end ? 2 * shape_.layer_height : shape_.connector;
    const double top = element.touch.z - std::max(least, lateral / shape_.lean);
    constexpr double share_of_layer = 1e-6;
    return static_cast<std::int64_t>(std::floor((top - shape_.bed) / shape_.layer_height + share_of_layer));
}

std::vector<BridgeSweep::Crossing> BridgeSweep::strip(std::size_t element, dvec2 u) const {
    const ScaffoldElement& anchor = elements_[element];
    const dvec2 n(-u.y, u.x);
    // A bar lies above the feet of the pillars that carry it.
    const auto least =
        static_cast<std::int64_t>(std::ceil((shape_.foot_height + shape_.bar_height) / shape_.layer_height));
    std::vector<Crossing> strip;
    visit_near(dvec2(anchor.touch), [&](std::size_t number) {
        const dvec2 d = dvec2(elements_[number].touch) - dvec2(anchor.touch);
        const double along = glm::dot(d, u), across = glm::dot(d, n);
        if (std::abs(across) > shape_.reach || std::abs(along) > shape_.bridge) return;
        const std::int64_t level = level_of(elements_[number], std::abs(across));
        if (level > least) strip.push_back({along, across, level, number});
    });
    std::sort(strip.begin(), strip.end(), [](const Crossing& a, const Crossing& b) {
        return a.along != b.along ? a.along < b.along : a.element < b.element;
    });
    return strip;
}

std::optional<BridgeCandidate> BridgeSweep::best(
    std::size_t element, int direction, const std::vector<std::array<std::int64_t, 3>>& refused) const {
    const dvec2 u = along(direction);
    const std::vector<Crossing> all = strip(element, u);
    std::vector<std::int64_t> levels;
    levels.reserve(all.size());
    for (const Crossing& crossing : all) levels.push_back(crossing.level);
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());

    std::optional<BridgeCandidate> best;
    std::vector<Crossing> crossed;
    std::vector<double> saved, longest;
    for (const std::int64_t level : levels) {
        const double z = height(level);
        crossed.clear();
        for (const Crossing& c : all) {
            if (c.level >= level && elements_[c.element].touch.z - z <= shape_.longest_connector) {
                crossed.push_back(c);
            }
        }
        const auto self = std::find_if(crossed.begin(), crossed.end(),
                                       [&](const Crossing& c) { return c.element == element; });
        if (self == crossed.end() || crossed.size() < 2) continue;
        const auto middle = static_cast<std::size_t>(self - crossed.begin());
        // Prefix sums, and the longest connector between each crossing and the anchor.
        saved.assign(crossed.size() + 1, 0);
        longest.assign(crossed.size(), 0);
        const auto connector = [&](std::size_t i) {
            return connector_length(elements_[crossed[i].element], crossed[i].across, z);
        };
        for (std::size_t i = 0; i < crossed.size(); ++i) {
            saved[i + 1] = saved[i] + (z - elements_[crossed[i].element].landing);
        }
        longest[middle] = connector(middle);
        for (std::size_t i = middle; i-- > 0;) longest[i] = std::max(longest[i + 1], connector(i));
        for (std::size_t i = middle + 1; i < crossed.size(); ++i) {
            longest[i] = std::max(longest[i - 1], connector(i));
        }
        for (std::size_t i = middle + 1; i-- > 0;) {
            for (std::size_t j = std::max(middle, i + 1); j < crossed.size(); ++j) {
                const double width = crossed[j].along - crossed[i].along;
                if (width > shape_.bridge) break;
                if (width < shape_.pillar) continue;
                const double legs =
                    2 * z - elements_[crossed[i].element].landing - elements_[crossed[j].element].landing;
                const double gain = worth_.gain(saved[j + 1] - saved[i], legs, width);
                const double score = worth_.score(gain, j + 1 - i, std::max(longest[i], longest[j]));
                if (gain <= 0 || (best && score <= best->score)) continue;
                const std::array<std::int64_t, 3> key{static_cast<std::int64_t>(crossed[i].element),
                                                      static_cast<std::int64_t>(crossed[j].element), level};
                if (std::find(refused.begin(), refused.end(), key) != refused.end()) continue;
                if (!best) best.emplace();
                const dvec2 at(elements_[element].touch);
                best->a = dvec3(at + u * crossed[i].along, z);
                best->b = dvec3(at + u * crossed[j].along, z);
                best->gain = gain;
                best->score = score;
                best->key = key;
                best->held.clear();
                for (std::size_t k = i; k <= j; ++k) best->held.push_back(crossed[k].element);
            }
        }
    }
    return best;
}

}  // namespace lamella
