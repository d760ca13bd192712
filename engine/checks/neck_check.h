// NeckCheck: finds necks, thin places that alone join large parts of a solid.
#pragma once

#include <deque>

#include "engine/checks/check_sampling.h"
#include "engine/checks/check_table.h"
#include "engine/morphology/thin_features.h"
#include "engine/runs/streaming_parts.h"

namespace lamella {

/// Finds joints between large parts that are thinner than a ball. The solid is opened by the ball. The
/// opening falls into connected parts; the points that it removes form thin pieces, called rests. A rest is a
/// neck if it touches two large parts that nothing thick enough joins elsewhere. Rows and layers that are
/// much finer than a neck's thickness are subsampled. Memory: the layers within reach of the ball, and the
/// rests that may still be necks.
class NeckCheck : public LayerCheck {
  public:
    explicit NeckCheck(const CheckContext& context)
        : NeckCheck(context, sampling_for(context.grid, context.limits.neck)) {}

    void add(LayerSample& layer, PreparedRows prepared) override;
    void finish() override;
    const FaultList& faults(Check /*check*/) const override { return necks_; }

  private:
    /// A layer, split into its opening and the rest.
    struct Split {
        LabelledLayer parts;  ///< components of the opening, as numbers of parts_
        RunRows rest;
    };
    NeckCheck(const CheckContext& context, const CheckSampling& sampling);
    /// Returns the coarsest sampling that resolves a thickness, mm.
    static CheckSampling sampling_for(const CheckGrid& grid, double thickness);
    void carry_on();
    void split(RunRows thin);
    void join_rest(std::size_t of);
    void settle(std::vector<std::uint32_t>& marks, const std::vector<std::uint32_t>& growing);
    void forget_what_is_settled();
    Fault neck(const StreamingComponent& rest) const;

    CheckGrid whole_, grid_;  // grid_ is sampled
    CheckSampling sampling_;
    double large_part_;
    ThinFeatureStream thin_;
    std::deque<RunRows> solid_;  // layers that are not split yet
    std::deque<Split> recent_;   // at most three: a rest touches parts below, beside and above it
    int layers_ = 0;             // number of layers that were split
    StreamingParts parts_;
    std::size_t max_parts_ = 1024;  // number of parts at which those are forgotten that no rest can refer to
    StreamingComponents rests_;
    std::vector<EndedComponent> ended_;
    std::vector<StreamingComponent> candidates_;  // ended rests that touch several parts
    FaultList necks_;
};

}  // namespace lamella
