// NeighbourLayers: the sections of a job's layers, for what a layer's toolpaths must know of those round it.
#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "engine/layers/layer.h"
#include "printers/toolpath/layer_below.h"

namespace lamella {

struct LayerOutlines {
    std::vector<Contour> part;
    std::vector<Contour> supports;
};

/// Traces the sections of layers once and keeps them until they are forgotten, so that neighbours share them:
/// in a stream that goes upwards this costs one section a layer. Thread-safe; what it tells depends on the
/// job alone. The job must outlive it.
class NeighbourLayers {
  public:
    /// `tolerance` of contours, mm.
    NeighbourLayers(const Job& job, double tolerance) : job_(&job), tolerance_(tolerance) {}

    /// The sections of a layer, 0 <= index < Job::layer_count.
    std::shared_ptr<const LayerOutlines> outlines(int index) const;
    /// The layer below this one, which must not be the first.
    LayerBelow footing(int index, double pitch) const;
    /// What is solid in each of so many layers below and above this one; there are none below the first and
    /// above the last.
    PlacedPolygons core(int index, int below, int above) const;
    /// Drops the layers below this one.
    void forget_below(int index);

  private:
    struct Entry {
        std::once_flag traced, simplified;
        LayerOutlines outlines;
        Polygons coarse;  // the part's, as coarse as no bead can follow anyway
    };
    std::shared_ptr<Entry> entry(int index) const;

    const Job* job_;
    double tolerance_;
    mutable std::mutex mutex_;
    mutable std::map<int, std::shared_ptr<Entry>> entries_;
};

}  // namespace lamella
