// Necks: thin places that alone join large parts of a solid.
#pragma once

#include <deque>

#include "engine/fault_list.h"
#include "engine/layer_opening.h"

namespace lamella {

/// Finds what joins large parts and is thinner than a ball. The solid is opened by the ball; what stays falls
/// into parts, and a piece of what the opening takes away is a neck where it touches two large ones that
/// nothing else as thick joins. Memory: the layers that the ball reaches, and a record for each part.
class NeckCheck {
  public:
    /// `thickness` of a neck that carries, mm; `large_part`, the volume from which a part counts, mm^3.
    NeckCheck(const CheckGrid& grid, double thickness, double large_part, std::size_t most);

    void push(const SpanRows& layer);
    void finish();
    const FaultList& necks() const { return necks_; }

  private:
    /// A layer fallen into what the opening leaves and what it takes away.
    struct Split {
        LabelledLayer parts;  ///< components are numbers of parts_
        SpanRows rest;
    };
    NeckCheck(const CheckGrid& grid, const SampledBall& ball, double large_part, std::size_t most);
    void carry_on();
    void split(const SpanRows& opened);
    void join_rest(std::size_t of);

    CheckGrid grid_;
    double large_part_;
    OpenedLayers opened_;
    std::deque<SpanRows> solid_;  // layers whose opening is not known yet
    std::deque<Split> recent_;    // three at most: a rest touches parts below, beside and above it
    int layers_ = 0;              // that were split
    RunComponents parts_;
    PassingComponents rests_;
    std::vector<EndedComponent> ended_;
    std::vector<PassingComponent> candidates_;  // rests that touch several parts
    FaultList necks_;
};

}  // namespace lamella
