// RunBoxes: regions found by a survey, stored as boxes of runs by layer.
#pragma once

#include <span>
#include <vector>

#include "engine/base/geometry.h"
#include "engine/runs/run_components.h"

namespace lamella {

/// Position of a survey's rows and layers. Row r covers y in [origin.y + r pitch, origin.y + (r + 1) pitch)
/// and layer l covers z in [z0 + l h, z0 + (l + 1) h); the survey samples each at its centre.
struct SurveyGrid {
    dvec2 origin{0};          ///< mm, where row 0 begins and run coordinate 0 lies
    double pitch = 0.1;       ///< mm from row to row; a run unit is 1/256 of it
    double z0 = 0;            ///< mm
    double layer_height = 0;  ///< h, mm

    /// Returns the box of a run, mm.
    Box box(const PlacedRun& run) const;
};

/// Set of boxes by layer, used as a solid (box_solid.h) or subtracted from one. Immutable and thread-safe.
/// Memory: sixteen bytes a run.
class RunBoxes {
  public:
    /// The runs come in any order; they may overlap.
    RunBoxes(const SurveyGrid& grid, std::vector<PlacedRun> runs);

    const SurveyGrid& grid() const { return grid_; }
    bool empty() const { return runs_.empty(); }
    /// Returns all runs, by layer, row and begin; disjoint, not touching within a row.
    std::span<const PlacedRun> runs() const { return runs_; }
    /// Returns the runs of the layer that holds height z.
    std::span<const PlacedRun> at(double z) const;
    /// Returns the run whose box holds the point; null when there is none.
    const PlacedRun* find(dvec3 p) const;
    /// Returns the distance from the point to the nearest box, at most `limit`, mm.
    double distance_within(dvec3 p, double limit) const;
    /// Returns the bounding box of all boxes, mm; empty when there are none.
    const Box& bounds() const { return bounds_; }
    /// Returns true if any of the boxes meets this one.
    bool meets(const Box& box) const;

    friend bool operator==(const RunBoxes& a, const RunBoxes& b) { return a.runs_ == b.runs_; }

  private:
    std::span<const PlacedRun> layer(int index) const;
    std::span<const PlacedRun> row(int layer_index, int row) const;
    double distance_in_layer(int index, dvec3 p, double limit) const;

    SurveyGrid grid_;
    std::vector<PlacedRun> runs_;
    int first_layer_ = 0;
    std::vector<std::size_t> starts_;  ///< of each layer from first_layer_ on, plus the end of the last
    std::vector<Rect> rects_;          ///< bounding rectangle of each layer's runs
    Box bounds_;
};

}  // namespace lamella
