// Opening: erosion, then dilation. Closing: dilation, then erosion.
#include "engine/morphology/layer_opening.h"

#include <cmath>

#include "engine/base/error.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

LayerLattice widened(LayerLattice lattice, std::size_t margin) {
    lattice.lines += 2 * margin;
    return lattice;
}

}  // namespace

LayerLattice ball_lattice(const RowBand& band, double layer_height, double across, double up) {
    if (!(across > 0 && up > 0)) throw InputError("a ball reaches farther than nothing in all directions");
    const double unit = std::abs(band.along_pitch) / run_unit;
    return {std::abs(band.line_pitch()) / unit, layer_height * (across / up) / unit,
            static_cast<std::size_t>(band.lines())};
}

SampledBall sampled_ball(const RowBand& band, double layer_height, double thickness, double thickness_up) {
    const double across = thickness - std::abs(band.line_pitch()), up = thickness_up - layer_height;
    if (!(across > 0)) throw InputError("rows as far apart as a thickness cannot tell it");
    const double radius = 0.5 * across / std::abs(band.along_pitch) * run_unit;
    if (up > 0) return {ball_lattice(band, layer_height, across, up), radius};
    LayerLattice flat = ball_lattice(band, layer_height, across, across);
    flat.layer_pitch = infinity;
    return {flat, radius};
}

OpeningStream::OpeningStream(const LayerLattice& lattice, double radius, double slack)
    : reach_(radius + slack), shrunk_(lattice, radius), grown_(lattice, radius + slack) {}

void OpeningStream::push(const RunRows& layer) {
    shrunk_.push(layer);
    carry_on();
}

void OpeningStream::finish() {
    shrunk_.finish();
    carry_on();
    grown_.finish();
}

void OpeningStream::carry_on() {
    for (RunRows rows; shrunk_.pop(rows);) grown_.push(WeightedRows(rows, reach_));
}

ClosingStream::ClosingStream(const LayerLattice& lattice, double radius, double slack)
    : radius_(radius),
      lines_(lattice.lines),
      margin_(lattice.lines_within(radius)),
      beyond_(lattice.layers_within(radius)),
      to_drop_(beyond_),
      grown_(widened(lattice, margin_), radius),
      shrunk_(widened(lattice, margin_), radius + slack) {
    push_empty();
}

/// Pushes extra layers: the solid must be kept where it grows beyond the given layers, to be eroded back.
void ClosingStream::push_empty() {
    const RunRows nothing = empty_rows(lines_ + 2 * margin_);
    for (std::size_t i = 0; i < beyond_; ++i) grown_.push(WeightedRows(nothing, radius_));
    carry_on();
}

void ClosingStream::push(const RunRows& layer) {
    if (layer.lines() != lines_) throw FaultError("a layer has other lines than the lattice");
    RunRows wide = empty_rows(margin_);
    wide.append_lines(layer);
    for (std::size_t l = 0; l < margin_; ++l) wide.end_line();
    grown_.push(WeightedRows(wide, radius_));
    ++to_come_;
    carry_on();
}

void ClosingStream::finish() {
    push_empty();
    grown_.finish();
    carry_on();
    shrunk_.finish();
}

void ClosingStream::carry_on() {
    for (RunRows rows; grown_.pop(rows);) shrunk_.push(rows);
}

bool ClosingStream::pop(RunRows& out) {
    RunRows wide;
    for (; to_drop_ > 0; --to_drop_) {
        if (!shrunk_.pop(wide)) return false;
    }
    if (to_come_ == 0 || !shrunk_.pop(wide)) return false;
    --to_come_;
    out.clear();
    out.append_lines(wide, margin_, lines_);
    return true;
}

}  // namespace lamella
