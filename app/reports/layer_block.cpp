// Pixel coverage, interpolated within a layer and, at its borders, between layers.
#include "app/reports/layer_block.h"

#include <algorithm>
#include <cmath>

#include "engine/solids/closed_slice.h"

namespace lamella {

LayerBlock::LayerBlock(const Box& box, std::vector<RunCoverage> layers)
    : box_(box),
      layers_(std::move(layers)),
      height_(box.size().z / static_cast<double>(layers_.size())),
      pixel_(layers_.front().pixel()) {}

/// Interpolates bilinearly between pixel centres; void outside.
double LayerBlock::share_in(int layer, dvec2 at) const {
    if (layer < 0 || layer >= static_cast<int>(layers_.size())) return 0;
    const RunCoverage& shares = layers_[static_cast<std::size_t>(layer)];
    const dvec2 q = (at - dvec2(box_.lo)) / pixel_ - 0.5;
    const dvec2 cell = glm::floor(q), t = q - cell;
    const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y);
    const auto pixel = [&](int i, int j) {
        return i < 0 || j < 0 || i >= shares.width() || j >= shares.height() ? 0 : shares.at(i, j);
    };
    const double low = pixel(x, y) * (1 - t.x) + pixel(x + 1, y) * t.x;
    const double high = pixel(x, y + 1) * (1 - t.x) + pixel(x + 1, y + 1) * t.x;
    return low * (1 - t.y) + high * t.y;
}

double LayerBlock::share(dvec3 p) const {
    if (!grown(box_, pixel_).contains(p)) return 0;
    const double up = (p.z - box_.lo.z) / height_;
    const double nearest = std::round(up);  // border between two layers
    const double width = std::min(0.5, pixel_ / height_);
    const double above = std::clamp((up - nearest) / width + 0.5, 0.0, 1.0);
    const int layer = static_cast<int>(nearest);
    const dvec2 at(p);
    return (above < 1 ? share_in(layer - 1, at) * (1 - above) : 0) +
           (above > 0 ? share_in(layer, at) * above : 0);
}

double LayerBlock::value(dvec3 p) const {
    return (0.5 - share(p)) * pixel_ / 2;  // halved, so that it changes by at most 1 per mm
}

/// The share is linear between pixel centres.
void LayerBlock::cut(Axis axis, double across, double z, std::vector<Interval>& intervals) const {
    const double lo = (axis == Axis::x ? box_.lo.x : box_.lo.y) - pixel_ / 2;
    const double hi = (axis == Axis::x ? box_.hi.x : box_.hi.y) + pixel_;
    const auto over_half = [&](double along) { return share(dvec3(on_plane(axis, along, across), z)) - 0.5; };
    double before = over_half(lo), begin = lo;
    for (int i = 1; lo + (i - 1) * pixel_ < hi; ++i) {
        const double along = lo + i * pixel_, now = over_half(along);
        if ((now > 0) != (before > 0)) {
            const double border = along - pixel_ * now / (now - before);
            if (now <= 0) intervals.push_back({begin, border});
            begin = border;
        }
        before = now;
    }
}

const SliceField& LayerBlock::slice(SliceContext& context, double z) const {
    return context.make<ClosedSlice<LayerBlock>>(*this, z);
}

}  // namespace lamella
