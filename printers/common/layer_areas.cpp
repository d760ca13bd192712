// Connected components of a mask's runs, and the sum of greys of each.
#include "printers/common/layer_areas.h"

#include <algorithm>

#include "engine/runs/run_components.h"

namespace lamella {

void LayerAreas::end_lit() {
    if (lit_grey_ == 0) return;
    lit_.push(lit_begin_, column_);
    greys_.push_back(lit_grey_);
    lit_grey_ = 0;
}

void LayerAreas::add(std::span<const GreyRun> runs) {
    for (const GreyRun& run : runs) {
        if (run.length == 0) continue;
        if (run.value == 0) end_lit();
        if (run.value != 0 && lit_grey_ == 0) lit_begin_ = column_;
        lit_grey_ += std::uint64_t{run.length} * run.value;
        column_ += static_cast<int>(run.length);
        if (column_ < width_) continue;
        end_lit();
        lit_.end_line();
        column_ = 0;
    }
}

LayerFigures LayerAreas::figures() const {
    LayerFigures figures;
    const LabelledLayer labelled = label_layer(lit_, 0, {});
    if (labelled.components.empty()) return figures;
    std::vector<std::uint64_t> sums(labelled.components.size());
    for (std::size_t i = 0; i < greys_.size(); ++i) sums[labelled.owners[i]] += greys_[i];
    constexpr double full = 255;
    std::uint64_t total = 0;
    for (const std::uint64_t sum : sums) total += sum;
    figures.total = static_cast<double>(total) / full;
    figures.largest = static_cast<double>(*std::ranges::max_element(sums)) / full;
    figures.smallest = static_cast<double>(*std::ranges::min_element(sums)) / full;
    figures.islands = static_cast<int>(sums.size());
    ComponentExtent all;
    for (const ComponentExtent& extent : labelled.components) all.include(extent);
    figures.min_x = all.along.begin;
    figures.max_x = all.along.end;
    figures.min_y = all.first_row;
    figures.max_y = all.last_row + 1;
    return figures;
}

}  // namespace lamella
