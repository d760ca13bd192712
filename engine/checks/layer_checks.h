// Checks that look at layers one by one: sheets in pieces, empty layers, and the machine's reach.
#pragma once

#include "engine/checks/check_table.h"

namespace lamella {

/// Sheet check: a layer that is cut out of a sheet must be one piece.
class SheetCheck : public LayerCheck {
  public:
    explicit SheetCheck(const CheckContext& context) : grid_(context.grid), faults_(context.max_faults) {}
    void add(LayerSample& layer, PreparedRows prepared) override;
    const FaultList& faults(Check /*check*/) const override { return faults_; }

  private:
    CheckGrid grid_;
    FaultList faults_;
};

/// Empty-layer check: consecutive empty layers are one fault.
class EmptyCheck : public LayerCheck {
  public:
    explicit EmptyCheck(const CheckContext& context) : grid_(context.grid), faults_(context.max_faults) {}
    void add(LayerSample& layer, PreparedRows prepared) override;
    void finish() override;
    const FaultList& faults(Check /*check*/) const override { return faults_; }

  private:
    void end_gap(int end);

    CheckGrid grid_;
    int begin_ = -1;  // first of the current empty layers; -1: none
    FaultList faults_;
};

/// Build volume check: the size of the print against that of the machine. One fault per axis.
class ReachCheck : public LayerCheck {
  public:
    explicit ReachCheck(const CheckContext& context)
        : grid_(context.grid), build_volume_(context.limits.build_volume), faults_(context.max_faults) {}
    void add(LayerSample& layer, PreparedRows prepared) override;
    void finish() override;
    const FaultList& faults(Check /*check*/) const override { return faults_; }

  private:
    void judge(glm::length_t axis, double size, const PlacedRun& end);

    CheckGrid grid_;
    dvec3 build_volume_;
    ComponentExtent extent_;
    PlacedRun along_{}, across_{}, top_{};  // the runs farthest out
    FaultList faults_;
};

}  // namespace lamella
