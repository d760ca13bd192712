// Necks: thin places that alone join large parts of a solid.
#pragma once

#include <deque>

#include "engine/checks/check_sampling.h"
#include "engine/morphology/thin_features.h"
#include "engine/runs/streaming_parts.h"

namespace lamella {

/// Finds what joins large parts and is thinner than a ball. The solid is opened by the ball; what stays falls
/// into parts, and a piece of what that takes away is a neck where it touches two large ones that
/// nothing else as thick joins. Where rows or layers lie much closer than a neck is thick, one of several is
/// looked at. Memory: the layers that the ball reaches, and what may be a neck still.
class NeckCheck {
  public:
    /// `thickness` of a neck that carries, mm; `large_part`, the volume from which a part counts, mm^3.
    NeckCheck(const CheckGrid& grid, double thickness, double large_part, std::size_t most);

    void push(const RunRows& layer);
    void finish();
    const FaultList& necks() const { return necks_; }

  private:
    /// A layer fallen into what the opening leaves and what it takes away.
    struct Split {
        LabelledLayer parts;  ///< components are numbers of parts_
        RunRows rest;
    };
    NeckCheck(const CheckGrid& sampled, const CheckSampling& sampling, double thickness, double large_part,
              std::size_t most);
    void carry_on();
    void split(RunRows thin);
    void join_rest(std::size_t of);
    void settle(std::vector<std::uint32_t>& marks, const std::vector<std::uint32_t>& growing);
    void forget_what_is_settled();
    Fault neck(const StreamingComponent& rest) const;

    CheckGrid grid_;  // of what is looked at
    CheckSampling sampling_;
    int pushed_ = 0;  // layers
    double large_part_;
    ThinFeatureStream thin_;
    std::deque<RunRows> solid_;  // layers of which it is not known yet what is thin
    std::deque<Split> recent_;   // three at most: a rest touches parts below, beside and above it
    int layers_ = 0;             // that were split
    StreamingParts parts_;
    std::size_t max_parts_ = 1024;  // at which those are forgotten that no rest can join any more
    StreamingComponents rests_;
    std::vector<EndedComponent> ended_;
    std::vector<StreamingComponent> candidates_;  // rests that touch several parts
    FaultList necks_;
};

}  // namespace lamella
