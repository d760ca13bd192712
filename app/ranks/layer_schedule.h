// Which rank renders which layers: turn by turn, as the first rank plans them.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/base/archive.h"
#include "engine/layers/backend.h"

namespace lamella {

/// What a rank other than 0 renders in one turn.
inline constexpr int layers_in_a_block = 8;

/// Successive layers: some of rank 0, which has to write all of them besides, then a block of each other
/// rank.
struct Turn {
    int first = 0;
    int own = layers_in_a_block;  ///< layers of rank 0

    int end(int ranks) const { return block_of(ranks).first; }
    /// The layers of a rank other than 0.
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

/// How long something takes with a layer, on the average so far. For deciding who does it, never for what
/// comes of it. Thread-safe.
class LayerTime {
  public:
    /// Does it with one layer.
    template <typename Work>
    auto measure(const Work& work) {
        const Counting counting{*this};
        return work();
    }
    void add(double seconds);
    /// Seconds; empty before the first layer.
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

/// What rank 0 spends its time on.
struct WorkTimes {
    LayerTime rendering, writing;

    /// So many layers of its own that rank 0 is done with them, and with writing all of a turn, when each
    /// other rank is with a block, if all are as quick as it is. May be negative. Empty before it has done
    /// any.
    std::optional<double> fair_share(int ranks) const;
};

/// The turns of a run. Two are planned ahead of the layer that rank 0 is at, so that nobody waits for a plan.
/// Thread-safe. Takes eight bytes for each turn.
class LayerSchedule {
  public:
    /// tell: called with each turn in order, once it is planned. The times must outlive this.
    LayerSchedule(int ranks, LayerRange layers, const WorkTimes& times, std::function<void(Turn)> tell);

    /// The rank that renders a layer; asked for by rank 0 as it gets there.
    int owner_of(int layer);

  private:
    void plan_until(int layer);
    int next() const { return turns_.empty() ? layers_.first : turns_.back().end(ranks_); }
    /// The first turn that begins behind a layer.
    std::vector<Turn>::const_iterator behind(int layer) const;
    int share();

    int ranks_;
    LayerRange layers_;
    const WorkTimes& times_;
    std::function<void(Turn)> tell_;
    std::mutex planning_;
    std::vector<Turn> turns_;
    double owed_ = 0;  // of a layer
};

}  // namespace lamella
