// Jobs around scenes of solids, for surveys and their tests.
#pragma once

#include "engine/layers/layer.h"

namespace lamella::scenes {

/// A job that cuts the part into layers over the given bounds.
inline Job job_of(FieldPtr part, const Box& bounds, double layer_height) {
    Job job;
    job.part = std::move(part);
    job.bounds = bounds;
    job.layers = equal_layers(bounds.size().z, layer_height);
    return job;
}

}  // namespace lamella::scenes
