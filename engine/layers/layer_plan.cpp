// LayerPlan: binary search among runs of equal layers.
#include "engine/layers/layer_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/number_format.h"

namespace lamella {

LayerPlan::LayerPlan(const std::vector<EqualLayers>& runs) {
    for (const EqualLayers& run : runs) {
        if (run.count <= 0) continue;
        if (runs_.empty() || runs_.back().height != run.height)
            runs_.push_back({count_, total(), run.height});
        least_ = count_ == 0 ? run.height : std::min(least_, run.height);
        greatest_ = std::max(greatest_, run.height);
        count_ += run.count;
    }
}

LayerPlan LayerPlan::stacked(const std::vector<LayerPlan>& plans) {
    LayerPlan all;
    for (const LayerPlan& plan : plans) {
        if (all.count_ > 0) all.stack_ends_.push_back(all.count_);
        all.least_ = all.count_ == 0 ? plan.least_ : std::min(all.least_, plan.least_);
        all.greatest_ = std::max(all.greatest_, plan.greatest_);
        for (Run run : plan.runs_) {
            run.first += all.count_;
            all.runs_.push_back(run);
        }
        all.count_ += plan.count_;
    }
    return all;
}

double LayerPlan::total() const {
    double highest = count_ == 0 ? 0 : top(count_ - 1);
    for (const int end : stack_ends_) highest = std::max(highest, top(end - 1));
    return highest;
}

int LayerPlan::stack_of(int layer) const {
    return static_cast<int>(std::ranges::upper_bound(stack_ends_, layer) - stack_ends_.begin());
}

int LayerPlan::first_of_stack(int stack) const {
    if (stack <= 0) return 0;
    return stack >= stacks() ? count_ : stack_ends_[static_cast<std::size_t>(stack - 1)];
}

const LayerPlan::Run& LayerPlan::run_of(int layer) const {
    if (runs_.size() == 1) return runs_.front();
    const auto after = std::ranges::upper_bound(runs_, layer, {}, &Run::first);
    return after == runs_.begin() ? runs_.front() : *std::prev(after);
}

double LayerPlan::height(int first, int last) const {
    if (equal()) return runs_.empty() ? 0 : (last - first) * runs_.front().height;
    return bottom(last) - bottom(first);
}

int LayerPlan::layer_at(double height) const {
    if (count_ == 0) return 0;
    const auto stack_end = std::ranges::lower_bound(runs_, first_of_stack(1), {}, &Run::first);
    auto after = std::ranges::upper_bound(runs_.begin(), stack_end, height, {}, &Run::bottom);
    if (after == runs_.begin()) ++after;
    const Run& run = *std::prev(after);
    const int end = after == runs_.end() ? count_ : after->first;
    const double within = std::floor((height - run.bottom) / run.height);
    return run.first + static_cast<int>(std::clamp(within, 0.0, static_cast<double>(end - run.first - 1)));
}

std::vector<EqualLayers> LayerPlan::runs() const {
    std::vector<EqualLayers> runs;
    runs.reserve(runs_.size());
    for (std::size_t i = 0; i < runs_.size(); ++i) {
        const int end = i + 1 < runs_.size() ? runs_[i + 1].first : count_;
        runs.push_back({end - runs_[i].first, runs_[i].height});
    }
    return runs;
}

LayerPlan LayerPlan::divided(double by) const {
    std::vector<EqualLayers> runs = this->runs();
    for (EqualLayers& run : runs) run.height /= by;
    return LayerPlan(runs);
}

LayerPlan LayerPlan::lowest(int count) const {
    std::vector<EqualLayers> runs = this->runs();
    for (EqualLayers& run : runs) {
        run.count = std::min(run.count, count);
        count -= run.count;
    }
    return LayerPlan(runs);
}

LayerPlan LayerPlan::raised(const LayerPlan& below) const {
    std::vector<EqualLayers> runs = below.runs();
    std::ranges::copy(this->runs(), std::back_inserter(runs));
    return LayerPlan(runs);
}

bool LayerPlan::begins_like(const LayerPlan& other) const {
    const std::vector<EqualLayers> these = runs(), those = other.runs();
    for (std::size_t i = 0; i < those.size(); ++i) {
        if (i >= these.size() || these[i].height != those[i].height) return false;
        const bool is_last = i + 1 == those.size();
        if (is_last ? these[i].count < those[i].count : these[i].count != those[i].count) return false;
    }
    return true;
}

std::string LayerPlan::heights_text() const {
    constexpr int digits = 6;
    const std::string least = format_number(least_, digits);
    return equal() ? least + " mm" : fmt::format("{} to {} mm", least, format_number(greatest_, digits));
}

int count_layers(double part_height, double h, double lowest_plane) {
    if (!(part_height > 0) || !std::isfinite(part_height))
        throw InputError("the part has no height to cut into layers");
    if (!(h > 0) || !std::isfinite(h)) throw InputError("the layer height must be positive");
    constexpr double rounding = 1e-6;  // layers
    const double count = std::ceil(part_height / h - lowest_plane - rounding);
    constexpr double max_layers = 10'000'000;
    if (count > max_layers)
        throw InputError("the layer height is too small for the part: more than 10 million layers");
    return std::max(1, static_cast<int>(count));
}

LayerPlan equal_layers(double part_height, double h, double lowest_plane) {
    return {count_layers(part_height, h, lowest_plane), h};
}

}  // namespace lamella
