// BridgeSweep: searches for bars that support several elements at once, and scores them (Dumas, Hergel and
// Lefebvre 2014, algorithms 2 and 3).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "procedural/scaffold/scaffold.h"

namespace lamella {

/// Something that needs support from below: a point of the part, or the underside of a bar's end.
struct ScaffoldElement {
    dvec3 touch{0};
    double landing = 0;   ///< height at which a leg under it would stand, mm
    bool is_end = false;  ///< end of a bar
    bool open = true;     ///< not supported yet
};

/// A possible bar and the elements that it would support.
struct BridgeCandidate {
    dvec3 a{0}, b{0};               ///< ends of its upper side
    std::vector<std::size_t> held;  ///< supported elements, from end to end
    /// material saved, as a length of pillar, mm: the parts of the legs below the bar, less the bar's own two
    /// legs and the bar
    double gain = 0;
    double score = 0;  ///< gain less the longest connector for each held element, mm
    /// identifies the candidate among those of one anchor: first element, last element, layer
    std::array<std::int64_t, 3> key{};
};

/// The score of a bar. The published gain is the total length of the elements' legs below the bar, less the
/// bar's own two legs and its length; the score subtracts the longest connector once for each element. Here
/// bars and connectors are weighted by their cross-section over a pillar's, so that what is saved is
/// material.
class BridgeScore {
  public:
    /// Weight of bars. A bar is charged for the whole of its legs, which bars below often take over; on real
    /// models the total material is least if bars count for less than they are.
    static constexpr double share_of_bar = 0.75;

    explicit BridgeScore(const ScaffoldShape& shape);
    double gain(double saved, double legs, double bar) const { return saved - legs - bar_ * bar; }
    double score(double gain, std::size_t held, double longest_connector) const {
        return gain - connector_ * static_cast<double>(held) * longest_connector;
    }

  private:
    double bar_, connector_;
};

/// Finds the best bar through an element, for each direction of a half circle. The elements in a strip along
/// the direction, as wide as connectors reach, are those that the paper's sweep line would cross.
class BridgeSweep {
  public:
    static constexpr int directions = 8;

    explicit BridgeSweep(const ScaffoldShape& shape);

    std::size_t add(const ScaffoldElement& element);
    void close(std::size_t element) { elements_[element].open = false; }
    const std::vector<ScaffoldElement>& elements() const { return elements_; }

    /// Returns the bar of best score through the element, among those with a positive gain whose key is not
    /// in `refused`.
    std::optional<BridgeCandidate> best(std::size_t element, int direction,
                                        const std::vector<std::array<std::int64_t, 3>>& refused) const;
    /// Returns the length of the connector from an element down to the height `z` at a lateral distance, mm.
    static double connector_length(const ScaffoldElement& element, double lateral, double z) {
        const double rise = element.touch.z - z;
        return std::sqrt(lateral * lateral + rise * rise);
    }
    /// Returns the open elements, ascending, whose best bars may change when something at this place changes.
    std::vector<std::size_t> near(dvec3 place) const;
    static dvec2 along(int direction);

  private:
    /// An element in a strip.
    struct Crossing {
        double along, across;  ///< from the anchor, the element that the strip is centred on, mm
        std::int64_t level;    ///< highest level of a bar under it, in layers above the bed
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
    double reach_;  ///< distance within which elements can share a bar, mm
    std::vector<ScaffoldElement> elements_;
    std::unordered_map<std::int64_t, std::vector<std::size_t>> grid_;
};

}  // namespace lamella
