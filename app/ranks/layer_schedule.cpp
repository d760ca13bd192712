// Shares follow from the average times of rendering and writing.
#include "app/ranks/layer_schedule.h"

#include <algorithm>
#include <iterator>

namespace lamella {

void LayerTime::add(double seconds) {
    const std::lock_guard lock(access_);
    seconds_ += seconds;
    ++layers_;
}

std::optional<double> LayerTime::average() const {
    const std::lock_guard lock(access_);
    if (layers_ == 0) return std::nullopt;
    return seconds_ / layers_;
}

std::optional<double> WorkTimes::fair_share(int ranks) const {
    const std::optional<double> render = rendering.average(), write = writing.average();
    if (!render || !write || !(*render + *write > 0)) return std::nullopt;
    return layers_in_a_block * (*render - (ranks - 1) * *write) / (*render + *write);
}

LayerSchedule::LayerSchedule(int ranks, LayerRange layers, const WorkTimes& times,
                             std::function<void(Turn)> tell)
    : ranks_(ranks), layers_(layers), times_(times), tell_(std::move(tell)) {}

int LayerSchedule::owner_of(int layer) {
    const std::lock_guard lock(planning_);
    plan_until(layer);
    return std::prev(behind(layer))->owner_of(layer);
}

void LayerSchedule::plan_until(int layer) {
    constexpr std::ptrdiff_t turns_ahead = 2;
    while (next() < layers_.last && turns_.end() - behind(layer) < turns_ahead) {
        turns_.push_back({next(), share()});
        tell_(turns_.back());
    }
}

std::vector<Turn>::const_iterator LayerSchedule::behind(int layer) const {
    return std::ranges::upper_bound(turns_, layer, {}, &Turn::first);
}

/// Fractions of layers are carried over to later turns. A turn has at least one layer.
int LayerSchedule::share() {
    const double wanted = std::max(times_.fair_share(ranks_).value_or(layers_in_a_block), 0.0) + owed_;
    const int own = static_cast<int>(wanted);
    owed_ = wanted - own;
    return std::max(own, ranks_ == 1 ? 1 : 0);
}

}  // namespace lamella
