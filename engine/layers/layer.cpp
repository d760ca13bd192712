// Layer: slices of a job, cut on demand.
#include "engine/layers/layer.h"

#include "engine/base/error.h"

namespace lamella {

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

Layer::Layer(const Job& job, int index, const CancelToken* cancel)
    : job_(&job), index_(index), cancel_(cancel), z_(job.plane(index)), thickness_(job.layer_height) {}

const SliceField& Layer::part_at(double share) const { return context_.slice(*job_->part, height_of(share)); }

const SliceField* Layer::supports_at(double share) const {
    return job_->supports ? &context_.slice(*job_->supports, height_of(share)) : nullptr;
}

void Layer::cache_lines(const RowBand& wanted) const {
    part_lines_.emplace_back(wanted);
    if (job_->supports) support_lines_.emplace_back(wanted);
}

std::span<LineCache> Layer::lines_to_cache(const SliceField& slice) const {
    if (part_lines_.empty()) return {};
    if (&slice == &part()) return part_lines_;
    if (&slice == supports()) return support_lines_;
    return {};
}

const RunRows* Layer::kept_lines(const SliceField& slice, const RowBand& wanted) const {
    for (const LineCache& lines : lines_to_cache(slice)) {
        if (lines.wanted() == wanted && lines.rows() != nullptr) return lines.rows();
    }
    return nullptr;
}

}  // namespace lamella
