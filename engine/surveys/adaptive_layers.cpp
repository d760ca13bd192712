// Shortest path over the heights at which a layer may begin.
#include "engine/surveys/adaptive_layers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/base/error.h"
#include "engine/base/number_format.h"

namespace lamella {
namespace {

constexpr double micrometre = 1e-3;
constexpr double grains_in_a_layer = 20;
constexpr std::size_t most_grains = 20'000'000;

/// The grains of a search; heights are counted from where the layers begin.
class LayerSearch {
  public:
    LayerSearch(const SlopeProfile& profile, const AdaptiveLimits& limits, double bottom, double top)
        : profile_(profile), limits_(limits), bottom_(bottom) {
        grain_ = std::max(1.0, std::floor(limits.least / grains_in_a_layer / micrometre)) * micrometre;
        least_ = std::max<std::size_t>(1, grains(limits.least));
        most_ = std::max(least_, grains(limits.most));
        const double height = std::max(top - bottom, grain_);
        if (height / grain_ > static_cast<double>(most_grains)) {
            throw InputError("layers.least / --least-layer: " + format_number(limits.least, 6) +
                             " mm is too fine for layers that adapt over " + format_number(height, 6) +
                             " mm; accepted: " +
                             format_number(height / static_cast<double>(most_grains) * grains_in_a_layer, 6) +
                             " mm or more");
        }
        end_ = static_cast<std::size_t>(std::ceil(height / grain_ - 1e-6));
        for (const AdaptiveLimits::Band& band : limits.bands) set_band(band);
    }

    LayerPlan solve() {
        // Layers may go beyond the top where no others end at it.
        best_.assign(end_ + most_ + 1, {infinity, 0});
        best_[0].cost = 0;
        for (std::size_t i = 0; i < end_; ++i) {
            if (best_[i].cost < infinity) go_on_from(i);
        }
        std::size_t last = end_;
        for (std::size_t i = end_; i < best_.size(); ++i) {
            if (cost_of_end(i) < cost_of_end(last)) last = i;
        }
        std::vector<EqualLayers> layers;
        for (std::size_t i = last; i > 0; i -= best_[i].height)
            layers.push_back({1, static_cast<double>(best_[i].height) * grain_});
        std::ranges::reverse(layers);
        return LayerPlan(layers);
    }

  private:
    /// The cheapest way to a height: what it costs, and the height of its last layer, grains.
    struct Way {
        double cost;
        std::size_t height;
    };

    std::size_t grains(double height) const {
        return static_cast<std::size_t>(std::floor(height / grain_ + 1e-6));
    }

    double cost_of_end(std::size_t i) const {
        return best_[i].cost + penalty_ * static_cast<double>(i - end_) / static_cast<double>(least_);
    }

    /// Limits the layers that reach into a band.
    void set_band(const AdaptiveLimits::Band& band) {
        caps_.resize(end_, static_cast<std::uint32_t>(most_));
        const auto nearest = [&](double z) {
            return static_cast<std::size_t>(
                std::clamp(std::round((z - bottom_) / grain_), 0.0, static_cast<double>(end_)));
        };
        const std::size_t most = std::clamp<std::size_t>(grains(band.most), 1, most_);
        for (std::size_t i = nearest(band.z.lo); i < nearest(band.z.hi); ++i)
            caps_[i] = static_cast<std::uint32_t>(most);
    }

    /// The greatest height of a layer that holds this grain.
    std::size_t cap(std::size_t i) const { return i < caps_.size() ? caps_[i] : most_; }

    /// Tries all layers that begin at a height.
    void go_on_from(std::size_t i) {
        const double from = bottom_ + static_cast<double>(i) * grain_;
        const auto level = std::ranges::upper_bound(profile_.levels, from + grain_ / 2);
        std::size_t most = cap(i);
        const std::size_t least = std::min(least_, most);
        double flattest = profile_.flattest_in(from, from + static_cast<double>(least - 1) * grain_);
        for (std::size_t h = least; h <= most; ++h) {
            // The least height may reach into a band as well: the way to its border may be shorter.
            most = std::min(most, std::max(least, cap(i + h - 1)));
            if (h > most) break;
            const double to = from + static_cast<double>(h) * grain_;
            flattest = std::max(flattest, profile_.flattest_in(to - grain_, to));
            const bool holds_level = level != profile_.levels.end() && *level < to - grain_ / 2;
            const double cost = best_[i].cost + cost_of(h, holds_level ? 1 : flattest);
            if (cost < best_[i + h].cost) best_[i + h] = {cost, h};
        }
    }

    double cost_of(std::size_t height, double flattest) const {
        const double h = static_cast<double>(height) * grain_, share = h / limits_.most;
        constexpr double evenness = 1e-3;
        const double cusp = h * flattest / limits_.cusp;
        // Squared, so that thin layers beyond the limit cost less than thick ones.
        return 1 + evenness * share * share + (cusp > 1 + 1e-9 ? penalty_ * cusp * cusp : 0);
    }

    static constexpr double penalty_ = 1e6;  // layers: no number of them outweighs the limit

    const SlopeProfile& profile_;
    AdaptiveLimits limits_;
    std::vector<std::uint32_t> caps_;  // greatest height of a layer by the grains that it holds; empty: most_
    double bottom_, grain_ = micrometre;
    std::size_t least_ = 1, most_ = 1, end_ = 1;  // grains
    std::vector<Way> best_;
};

}  // namespace

LayerPlan adapt_layers(const SlopeProfile& profile, const AdaptiveLimits& limits, double bottom, double top) {
    return LayerSearch(profile, limits, bottom, top).solve();
}

double greatest_cusp(const SlopeProfile& profile, const LayerPlan& layers, double bottom) {
    double most = 0;
    for (int i = 0; i < layers.count(); ++i) {
        const double low = bottom + layers.bottom(i), high = bottom + layers.top(i);
        const double aside = layers.least_height() / (2 * grains_in_a_layer);
        const auto level = std::ranges::upper_bound(profile.levels, low + aside);
        const bool holds_level = level != profile.levels.end() && *level < high - aside;
        most = std::max(most, layers.height(i) * (holds_level ? 1 : profile.flattest_in(low, high)));
    }
    return most;
}

}  // namespace lamella
