// Marks elements plane by plane, from the runs of their rows.
#include "procedural/elasticity/field_sample.h"

#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/field/slice_context.h"

namespace lamella {
namespace {

void mark_plane(const Field& field, const Box& box, double edge, int z, ElementMask& sample) {
    RowBand band;
    band.along_origin = box.lo.x;
    band.across_origin = box.lo.y;
    band.along_pitch = band.across_pitch = edge;
    band.count = sample.size.y;
    band.hi = sample.size.x;
    SliceContext context;
    Scratch scratch;
    RunRows rows;
    context.slice(field, box.lo.z + (z + 0.5) * edge).runs(band, scratch, rows);
    for (int y = 0; y < sample.size.y; ++y) {
        for (const Run& run : rows.line(static_cast<std::size_t>(y))) {
            // Start at the first element centre that is not before the run's begin.
            for (int x = std::max(0, (run.begin + run_unit / 2 - 1) / run_unit); x < sample.size.x; ++x) {
                if (x * run_unit + run_unit / 2 >= run.end) break;
                sample.present[sample.place(x, y, z)] = 1;
            }
        }
    }
}

}  // namespace

ElementMask sample_field(const Field& field, const Box& box, int along_x, const CancelToken* cancel) {
    const dvec3 size = box.size();
    if (box.empty() || !std::isfinite(size.x + size.y + size.z) || along_x < 1)
        throw InputError("a sample needs a box with a volume and elements in it");
    const double edge = size.x / along_x;
    constexpr double most = 1024;
    ElementMask sample;
    for (int k = 0; k < 3; ++k) {
        const double count = std::round(size[k] / edge);
        if (!(count >= 1 && count <= most))
            throw InputError("a sample has no side with less than one element or more than 1024");
        sample.size[k] = static_cast<int>(count);
    }
    sample.present.assign(static_cast<std::size_t>(sample.size.x) * static_cast<std::size_t>(sample.size.y) *
                              static_cast<std::size_t>(sample.size.z),
                          0);
    parallel_for(sample.size.z, [&](int z) {
        stop_if_cancelled(cancel);
        mark_plane(field, box, edge, z, sample);
    });
    return sample;
}

}  // namespace lamella
