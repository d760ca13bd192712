// LayerSchedule: assigns layers to ranks, turn by turn, as planned by rank 0.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/base/archive.h"
#include "engine/layers/backend.h"

namespace lamella {

/// Layers that a rank other than 0 renders in one turn.
inline constexpr int layers_in_a_block = 8;

/// A range of layers: first some of rank 0, which also has to write all layers, then one block for each other
/// rank.
struct Turn {
    int first = 0;
    int own = layers_in_a_block;  ///< number of layers of rank 0

    int end(int ranks) const { return block_of(ranks).first; }
    /// Returns the layers of a rank other than 0.
    LayerRange block_of(int rank) const {
        const int begin = first + own + layers_in_a_block * (rank - 1);
        return {begin, begin + layers_in_a_block};
    }
    int owner_of(int layer) const {
        const int behind_own = layer - first - own;
        return behind_own < 0 ? 0 : 1 + behind_own / layers_in_a_block;
    }
    void serialize(Archive& parcel) { parcel(first, own); }
};

/// The average time that an operation takes for a layer. Only for deciding who does it, never for its result.
/// Thread-safe.
class LayerTime {
  public:
    /// Runs and measures the operation for one layer.
    template <typename Work>
    auto measure(const Work& work) {
        const Counting counting{*this};
        return work();
    }
    void add(double seconds);
    /// Returns seconds; empty before the first layer.
    std::optional<double> average() const;

  private:
    using Clock = std::chrono::steady_clock;
    struct Counting {
        LayerTime& time;
        Clock::time_point begin = Clock::now();
        ~Counting() { time.add(std::chrono::duration<double>(Clock::now() - begin).count()); }
    };
    mutable std::mutex access_;
    double seconds_ = 0;
    int layers_ = 0;
};

/// The times that rank 0 spends on layers.
struct WorkTimes {
    LayerTime rendering, writing;

    /// Returns the number of layers that rank 0 should render itself in a turn so that it finishes them, and
    /// the writing of the whole turn, when each other rank finishes its block, assuming equal speed. May be
    /// negative. Empty before rank 0 has rendered and written a layer.
    std::optional<double> fair_share(int ranks) const;
};

/// The turns of a run. Two are planned ahead of the current layer of rank 0, so that no rank waits for a
/// plan. Thread-safe. Takes eight bytes for each turn.
class LayerSchedule {
  public:
    /// `tell` is called with each turn in order, once it is planned. `times` must outlive this.
    LayerSchedule(int ranks, LayerRange layers, const WorkTimes& times, std::function<void(Turn)> tell);

    /// Returns the rank that renders a layer; called by rank 0 when it reaches the layer, which advances the
    /// plan.
    int owner_of(int layer);

  private:
    void plan_until(int layer);
    int next() const { return turns_.empty() ? layers_.first : turns_.back().end(ranks_); }
    /// Returns the first turn that begins after a layer.
    std::vector<Turn>::const_iterator behind(int layer) const;
    int share();

    int ranks_;
    LayerRange layers_;
    const WorkTimes& times_;
    std::function<void(Turn)> tell_;
    std::mutex planning_;
    std::vector<Turn> turns_;
    double owed_ = 0;  // fraction of a layer carried over to the next turn
};

}  // namespace lamella
