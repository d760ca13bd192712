// Layer: slices of a job, cut on demand.
#include "engine/layers/layer.h"

namespace lamella {

Job in_equal_layers(const Job& job) {
    Job equal = job;
    if (!job.layers.equal()) equal.layers = equal_layers(job.layers.total(), job.layers.least_height());
    return equal;
}

Layer::Layer(const Job& job, int index, const CancelToken* cancel)
    : job_(&job),
      solid_(job.part.get()),
      supports_solid_(job.supports.get()),
      index_(index),
      cancel_(cancel),
      z_(job.plane(index)),
      thickness_(job.layers.height(index)) {
    if (!job.one_by_one()) return;
    const JobObject& object = job.objects.at(static_cast<std::size_t>(job.layers.stack_of(index)));
    solid_ = object.part.get();
    supports_solid_ = object.supports.get();
}

const SliceField& Layer::part_at(double share) const { return context_.slice(*solid_, height_of(share)); }

const SliceField* Layer::supports_at(double share) const {
    return supports_solid_ != nullptr ? &context_.slice(*supports_solid_, height_of(share)) : nullptr;
}

void Layer::cache_lines(const RowBand& wanted) const {
    part_lines_.emplace_back(wanted);
    if (supports_solid_ != nullptr) support_lines_.emplace_back(wanted);
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
