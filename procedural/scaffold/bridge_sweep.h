// The sweep for bridges: where a bar would hold several places at once, and what it would be worth (Dumas,
// Hergel and Lefebvre 2014, algorithms 2 and 3).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "procedural/scaffold/scaffold.h"

namespace lamella {

/// Something that must be held from below: a point of the part, or the lower side of a bar's end.
struct ScaffoldElement {
    dvec3 touch{0};
    double landing = 0;   ///< height at which a leg under it would stand, mm
    bool is_end = false;  ///< of a bar
    bool open = true;     ///< nothing holds it yet
};

/// A bar and what it would hold.
struct BridgeCandidate {
    dvec3 a{0}, b{0};               ///< ends of its upper side
    std::vector<std::size_t> held;  ///< elements from end to end
    double gain = 0;   ///< length that it saves, mm: sum of the legs' parts below it, less its own
                       ///< two legs and itself
    double score = 0;  ///< gain less the longest connector for each held element, mm
    std::array<std::int64_t, 3> key{};  ///< tells apart the candidates of one anchor: first, last, height
};

/// What lengths are worth. The published gain of a bar is the length of the legs' parts below it that it
/// saves, less its own two legs and its length; the score takes off the longest connector for each element.
/// Here bars and connectors count by their sections against a pillar's, so that what is saved is material.
class BridgeScore {
  public:
    /// A bar is charged for the whole of its legs, which bars below often take over: on real models it takes
    /// least material in all to count the bars themselves for less than they are.
    static constexpr double share_of_bar = 0.75;

    explicit BridgeScore(const ScaffoldShape& shape);
    double gain(double saved, double legs, double bar) const { return saved - legs - bar_ * bar; }
    double score(double gain, std::size_t held, double longest_connector) const {
        return gain - connector_ * static_cast<double>(held) * longest_connector;
    }

  private:
    double bar_, connector_;
};

/// Finds the best bar through an element for each direction of a half circle. A strip as wide as connectors
/// reach runs along the direction, and the elements in it are what a sweep line there would cross.
class BridgeSweep {
  public:
    static constexpr int directions = 8;

    explicit BridgeSweep(const ScaffoldShape& shape);

    std::size_t add(const ScaffoldElement& element);
    void close(std::size_t element) { elements_[element].open = false; }
    const std::vector<ScaffoldElement>& elements() const { return elements_; }

    /// The bar of best score among those that save length, run under the element, and are not refused.
    std::optional<BridgeCandidate> best(std::size_t element, int direction,
                                        const std::vector<std::array<std::int64_t, 3>>& refused) const;
    /// Length of the connector from an element to the height `z` at a lateral distance, mm.
    static double connector_length(const ScaffoldElement& element, double lateral, double z) {
        const double rise = element.touch.z - z;
        return std::sqrt(lateral * lateral + rise * rise);
    }
    /// Open elements whose bars may change when something at this place does, ascending.
    std::vector<std::size_t> near(dvec3 place) const;
    static dvec2 along(int direction);

  private:
    /// An element in a strip.
    struct Crossing {
        double along, across;  ///< from the strip's own element, mm
        std::int64_t level;    ///< layers over the bed at which a bar may lie at most
        std::size_t element;
    };
    std::vector<Crossing> strip(std::size_t element, dvec2 u) const;
    std::int64_t level_of(const ScaffoldElement& element, double lateral) const;
    double height(std::int64_t level) const {
        return shape_.bed + static_cast<double>(level) * shape_.layer_height;
    }
    static std::int64_t grid_key(std::int64_t x, std::int64_t y) { return x * (std::int64_t{1} << 32) + y; }
    std::int64_t grid_cell(double v) const { return static_cast<std::int64_t>(std::floor(v / reach_)); }
    template <typename Visit>
    void visit_near(dvec2 place, const Visit& visit) const;

    ScaffoldShape shape_;
    BridgeScore worth_;
    double reach_;  ///< mm within which elements can share a bar
    std::vector<ScaffoldElement> elements_;
    std::unordered_map<std::int64_t, std::vector<std::size_t>> grid_;
};

}  // namespace lamella
