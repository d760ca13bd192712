// Openings and closings with slack, less what was there.
#include "engine/layer_thinness.h"

namespace lamella {

void thin_rows(const SpanRows& rows, const Thinness& thinness, double row_pitch, SpanRows& out) {
    SpanRows shrunk, opened;
    shrink_rows(rows, thinness.radius, row_pitch, shrunk);
    grow_rows(BallRows(shrunk, thinness.radius + thinness.slack), row_pitch, opened);
    out.clear();
    subtract(rows, opened, out);
}

void narrow_rows(const SpanRows& rows, const Thinness& thinness, double row_pitch, SpanRows& out) {
    // What grows beyond the rows has to be there when it shrinks back.
    const auto margin = static_cast<std::size_t>(thinness.radius / row_pitch);
    SpanRows wide, grown, closed, inner;
    for (std::size_t l = 0; l < margin; ++l) wide.end_line();
    for (std::size_t l = 0; l < rows.lines(); ++l) wide.append_line(rows.line(l));
    for (std::size_t l = 0; l < margin; ++l) wide.end_line();
    grow_rows(BallRows(wide, thinness.radius), row_pitch, grown);
    shrink_rows(grown, thinness.radius + thinness.slack, row_pitch, closed);
    for (std::size_t l = margin; l < margin + rows.lines(); ++l) inner.append_line(closed.line(l));
    out.clear();
    subtract(inner, rows, out);
}

void ThinLayers::push(const SpanRows& layer) {
    solid_.push_back(layer);
    opened_.push(layer);
}

bool ThinLayers::pop(SpanRows& out) {
    SpanRows opened;
    if (!opened_.pop(opened)) return false;
    out.clear();
    subtract(solid_.front(), opened, out);
    solid_.pop_front();
    return true;
}

void NarrowLayers::push(const SpanRows& layer) {
    solid_.push_back(layer);
    closed_.push(layer);
}

bool NarrowLayers::pop(SpanRows& out) {
    SpanRows closed;
    if (!closed_.pop(closed)) return false;
    out.clear();
    subtract(closed, solid_.front(), out);
    solid_.pop_front();
    return true;
}

}  // namespace lamella
