// NeighbourLayers: cached sections of a job's layers, for toolpaths that depend on adjacent layers.
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

/// Traces each layer's section once and keeps it until it is forgotten, so that adjacent layers share it: a
/// stream in ascending order costs one section per layer. Thread-safe; results depend on the job alone. The
/// job must outlive the object. Throws Interrupted once the `cancel` (may be null) of a call is set.
class NeighbourLayers {
  public:
    /// `tolerance` of contours, mm.
    NeighbourLayers(const Job& job, double tolerance) : job_(&job), tolerance_(tolerance) {}

    /// Returns the sections of a layer, 0 <= index < Job::layer_count.
    std::shared_ptr<const LayerOutlines> outlines(int index, const CancelToken* cancel = nullptr) const;
    /// Returns the layer below layer `index`, which must not be the first of its stack; `pitch` as for
    /// LayerBelow.
    LayerBelow footing(int index, double pitch, const CancelToken* cancel = nullptr) const;
    /// Returns the intersection of the sections of `below` layers below and `above` layers above layer
    /// `index`. Empty if any of them is beyond the first or last layer of the stack.
    PlacedPolygons core(int index, int below, int above, const CancelToken* cancel = nullptr) const;
    /// Drops the layers below `index`.
    void forget_below(int index);

  private:
    struct Entry {
        std::once_flag traced, simplified;
        LayerOutlines outlines;
        Polygons coarse;  // section of the part, simplified to what a bead can follow
    };
    std::shared_ptr<Entry> entry(int index, const CancelToken* cancel) const;

    const Job* job_;
    double tolerance_;
    mutable std::mutex mutex_;
    mutable std::map<int, std::shared_ptr<Entry>> entries_;
};

}  // namespace lamella
