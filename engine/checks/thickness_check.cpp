// ThicknessCheck: thin features within a layer (thin_rows) or across layers (ThinFeatureSearch).
#include "engine/checks/thickness_check.h"

#include <algorithm>

#include "engine/morphology/sampled_ball.h"

namespace lamella {
namespace {

constexpr double check_slack_share = 1.5;  // slack as a share of the ball's radius; see Thinness

/// Returns the sampling of layers. They need not be closer than rows.
CheckSampling sampling_for(const CheckGrid& grid, double thickness_up) {
    const double apart = std::min(grid.band.across_pitch, thickness_up / pitches_in_a_thickness);
    const double least = grid.layers.least_height();
    return {1, std::max(1, static_cast<int>(apart / least * (1 + 1e-9))),
            thickness_up > least ? std::max(apart, least) : 0};
}

}  // namespace

ThicknessCheck::ThicknessCheck(const CheckContext& context, FeatureKind kind)
    : ThicknessCheck(context, kind, kind == FeatureKind::wall ? context.limits.thickness : context.limits.gap,
                     kind == FeatureKind::wall ? context.limits.thickness_up : context.limits.gap_up) {}

ThicknessCheck::ThicknessCheck(const CheckContext& context, FeatureKind kind, double thickness,
                               double thickness_up)
    : kind_(kind),
      sampling_(sampling_for(context.grid, thickness_up)),
      layers_(context.grid.layers),
      found_(context.grid, sampling_, thickness, context.max_faults) {
    const CheckGrid& grid = context.grid;
    const SampledBall ball =
        sampled_ball(grid.band, sampling_.subsample(grid).layers.least_height(), thickness, thickness_up);
    // One more pitch of slack: sampled by rows, the border of an opening may seem up to a pitch farther in.
    measure_ = {ball.radius, check_slack_share * ball.radius + run_unit};
    row_pitch_ = ball.lattice.row_pitch;
    if (ball.lattice.layers_within(ball.radius + measure_.slack) > 0)
        neighbours_.emplace(ball.lattice, measure_, kind);
}

PreparedRows ThicknessCheck::prepare(const LayerSample& layer) const {
    PreparedRows found;
    if (!neighbours_) thin_rows(layer.rows.part, *layer.cells, kind_, measure_, row_pitch_, found.rows);
    return found;
}

bool ThicknessCheck::accepts(const PreparedRows& prepared, std::size_t lines) const {
    return prepared.rows.lines() == (neighbours_ ? 0 : lines);
}

void ThicknessCheck::add(LayerSample& layer, PreparedRows prepared) {
    if (!neighbours_) return found_.add(prepared.rows, next_++);
    for (int k = sampling_.samples(layers_, layer.index); k > 0; --k) {
        neighbours_->push(layer.rows.part);
        take();
    }
}

void ThicknessCheck::finish() {
    if (neighbours_) {
        neighbours_->finish();
        take();
    }
    found_.finish();
}

void ThicknessCheck::take() {
    for (RunRows found; neighbours_->pop(found);) found_.add(found, next_++);
}

}  // namespace lamella
