// Checks that look at layers one by one: sheets in pieces, empty layers, and the machine's reach.
#pragma once

#include "engine/checks/fault_list.h"

namespace lamella {

/// Sheet check: a layer that is cut out of a sheet must be one piece.
class SheetCheck {
  public:
    SheetCheck(const CheckGrid& grid, std::size_t most) : grid_(grid), faults_(most) {}
    void add(const LabelledLayer& layer, int index);
    const FaultList& faults() const { return faults_; }

  private:
    CheckGrid grid_;
    FaultList faults_;
};

/// Empty-layer check: consecutive empty layers are one fault.
class EmptyCheck {
  public:
    EmptyCheck(const CheckGrid& grid, std::size_t most) : grid_(grid), faults_(most) {}
    void add(const RunRows& rows, int index);
    void finish(int layer_count);
    const FaultList& faults() const { return faults_; }

  private:
    void end_gap(int end);

    CheckGrid grid_;
    int begin_ = -1;  // first of the current empty layers; -1: none
    FaultList faults_;
};

/// Build volume check: the size of the print against that of the machine. One fault per axis.
class ReachCheck {
  public:
    ReachCheck(const CheckGrid& grid, const dvec3& build_volume, std::size_t most)
        : grid_(grid), build_volume_(build_volume), faults_(most) {}
    void add(const RunRows& rows, int index);
    void finish();
    const FaultList& faults() const { return faults_; }

  private:
    void judge(glm::length_t axis, double size, const PlacedRun& end);

    CheckGrid grid_;
    dvec3 build_volume_;
    ComponentExtent extent_;
    PlacedRun along_{}, across_{}, top_{};  // the runs farthest out
    FaultList faults_;
};

}  // namespace lamella
