// Marks elements plane by plane, from the runs of their rows.
#include "procedural/elasticity/field_sample.h"

#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/field/slice_context.h"

namespace lamella {
namespace {

void mark_plane(const Field& field, dvec3 origin, dvec3 edges, int z, ElementMask& sample) {
    RowBand band;
    band.along_origin = origin.x;
    band.across_origin = origin.y;
    band.along_pitch = edges.x;
    band.across_pitch = edges.y;
    band.count = sample.size.y;
    band.hi = sample.size.x;
    SliceContext context;
    Scratch scratch;
    RunRows rows;
    context.slice(field, origin.z + (z + 0.5) * edges.z).runs(band, scratch, rows);
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

void check_box(const Box& box) {
    const dvec3 size = box.size();
    if (box.empty() || !std::isfinite(size.x + size.y + size.z))
        throw InputError("a sample needs a box with a volume");
}

ElementMask sample_elements(const Field& field, dvec3 origin, dvec3 edges, glm::ivec3 size,
                            const CancelToken* cancel) {
    ElementMask sample{size, {}};
    sample.present.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                              static_cast<std::size_t>(size.z),
                          0);
    parallel_for(size.z, [&](int z) {
        stop_if_cancelled(cancel);
        mark_plane(field, origin, edges, z, sample);
    });
    return sample;
}

}  // namespace

ElementMask sample_field(const Field& field, const Box& box, glm::ivec3 size, const CancelToken* cancel) {
    check_box(box);
    if (glm::min(size, glm::ivec3(1)) != glm::ivec3(1))
        throw InputError("a sample has no side with less than one element");
    return sample_elements(field, box.lo, box.size() / dvec3(size), size, cancel);
}

ElementMask sample_field(const Field& field, const Box& box, int along_x, const CancelToken* cancel) {
    check_box(box);
    if (along_x < 1) throw InputError("a sample needs elements along x");
    const double edge = box.size().x / along_x;
    constexpr double most = 1024;
    glm::ivec3 size(0);
    for (int k = 0; k < 3; ++k) {
        const double count = std::round(box.size()[k] / edge);
        if (!(count >= 1 && count <= most))
            throw InputError("a sample has no side with less than one element or more than 1024");
        size[k] = static_cast<int>(count);
    }
    return sample_elements(field, box.lo, dvec3(edge), size, cancel);
}

}  // namespace lamella
