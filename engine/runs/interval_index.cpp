// Uniform bins over the intervals; each bin lists its items by rank.
#include "engine/runs/interval_index.h"

#include <bit>
#include <numeric>
#include <utility>

namespace lamella {

IntervalIndex::IntervalIndex(const std::vector<Interval>& intervals, const std::vector<double>& keys) {
    double total = 0;
    std::vector<std::pair<double, std::uint32_t>> order;  // keys and items
    order.reserve(intervals.size());
    for (std::uint32_t i = 0; i < intervals.size(); ++i) {
        if (intervals[i].empty()) continue;
        order.emplace_back(keys[i], i);
        total += intervals[i].width();
        extent_ = {std::min(extent_.lo, intervals[i].lo), std::max(extent_.hi, intervals[i].hi)};
    }
    if (order.empty()) return;
    std::sort(order.begin(), order.end());
    item_.reserve(order.size());
    for (const auto& [key, item] : order) item_.push_back(item);
    // Bins are about as wide as the mean item, so that each item lies in about two of them.
    constexpr double max_bins = 4096;
    const double mean = total / static_cast<double>(item_.size());
    const double wanted = mean > 0 ? std::min(extent_.width() / mean, max_bins) : 1;
    bins_ = wanted >= 1 ? static_cast<std::size_t>(wanted) : 1;
    bins_per_mm_ = extent_.width() > 0 ? static_cast<double>(bins_) / extent_.width() : 0;

    intervals_.reserve(item_.size());
    starts_.assign(bins_ + 1, 0);
    for (const std::uint32_t i : item_) {
        intervals_.push_back(intervals[i]);
        for (std::size_t b = bin_of(intervals[i].lo); b <= bin_of(intervals[i].hi); ++b) ++starts_[b + 1];
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    ranks_.resize(starts_.back());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (std::uint32_t rank = 0; rank < intervals_.size(); ++rank) {
        const Interval& extent = intervals_[rank];
        for (std::size_t b = bin_of(extent.lo); b <= bin_of(extent.hi); ++b) ranks_[next[b]++] = rank;
    }
}

std::size_t IntervalIndex::bin_of(double v) const {
    // Far from a tiny extent, the number is beyond every integer.
    const double b = (v - extent_.lo) * bins_per_mm_;
    if (!(b > 0)) return 0;
    return b < static_cast<double>(bins_) ? static_cast<std::size_t>(b) : bins_ - 1;
}

void IntervalIndex::query(const Interval& interval, std::vector<std::uint32_t>& items) const {
    items.clear();
    if (bins_ == 0 || interval.hi < extent_.lo || extent_.hi < interval.lo) return;
    // A bit set over the ranks sorts the items and removes duplicates from several bins. Whether an item
    // intersects is hard to predict, so no branch depends on it.
    constexpr std::uint32_t word_bits = 64;
    std::vector<std::uint64_t> met((intervals_.size() + word_bits - 1) / word_bits, 0);
    const std::size_t first = bin_of(interval.lo), last = bin_of(interval.hi);
    for (std::uint32_t k = starts_[first]; k < starts_[last + 1]; ++k) {
        const std::uint32_t rank = ranks_[k];
        const Interval& extent = intervals_[rank];
        const bool meets =
            static_cast<int>(extent.lo <= interval.hi) & static_cast<int>(interval.lo <= extent.hi);
        met[rank / word_bits] |= std::uint64_t{meets} << rank % word_bits;
    }
    for (std::uint32_t i = 0; i < met.size(); ++i) {
        for (std::uint64_t word = met[i]; word != 0; word &= word - 1)
            items.push_back(item_[i * word_bits + static_cast<std::uint32_t>(std::countr_zero(word))]);
    }
}

}  // namespace lamella
