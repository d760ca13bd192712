// LayerCourses: layers that lie much closer than what is looked for is high, one of several of which is
// looked at.
#pragma once

#include <algorithm>

#include "engine/fault_list.h"

namespace lamella {

/// Courses of equally many layers; the middle one of each stands for it.
class LayerCourses {
  public:
    /// Each layer is a course.
    static LayerCourses all(int layer_count) { return {1, layer_count}; }
    /// As few courses as there may be `least` of in a height, mm.
    static LayerCourses in(double height, double least, double layer_height, int layer_count) {
        return {std::max(1, static_cast<int>(height / (least * layer_height) * (1 + 1e-9))), layer_count};
    }

    bool is_sampled(int layer) const { return layer == sampled_layer(layer / layers_); }
    CheckGrid of(CheckGrid grid) const {
        grid.layer_height *= layers_;
        return grid;
    }
    /// Turns the courses of a fault into layers.
    void spread(Fault& fault) const {
        fault.layer = sampled_layer(fault.layer);
        fault.first_layer *= layers_;
        fault.end_layer = std::min(fault.end_layer * layers_, layer_count_);
        for (PlacedRun& run : fault.runs) run.layer = fault.layer;
    }

  private:
    LayerCourses(int layers, int layer_count) : layers_(layers), layer_count_(layer_count) {}
    int sampled_layer(int course) const {
        return std::min(course * layers_ + (layers_ - 1) / 2, layer_count_ - 1);
    }

    int layers_;  // of a course
    int layer_count_;
};

}  // namespace lamella
