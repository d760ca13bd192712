// Openings and closings with slack, less what was there; within a layer without making them.
#include "engine/layer_thinness.h"

namespace lamella {

namespace {

constexpr std::int32_t far_out = 1 << 29;  // run units; solids lie within, the void reaches up to it

/// Rows with `margin` empty ones on either side.
SpanRows widened(const SpanRows& rows, std::size_t margin) {
    SpanRows wide;
    for (std::size_t l = 0; l < margin; ++l) wide.end_line();
    for (std::size_t l = 0; l < rows.lines(); ++l) wide.append_line(rows.line(l));
    for (std::size_t l = 0; l < margin; ++l) wide.end_line();
    return wide;
}

SpanRows void_of(const SpanRows& rows) {
    SpanRows voids;
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        std::int32_t from = -far_out;
        for (const Run& run : rows.line(l)) {
            voids.push(from, run.begin);
            from = run.end;
        }
        voids.push(from, far_out);
        voids.end_line();
    }
    return voids;
}

void without_margin(const SpanRows& wide, std::size_t margin, SpanRows& out) {
    out.clear();
    for (std::size_t l = margin; l + margin < wide.lines(); ++l) out.append_line(wide.line(l));
}

/// What of a lies further than `reach` from all that lies further than `radius` from b.
SpanRows far_from_what_is_far(const SpanRows& a, const SpanRows& b, double radius, double reach,
                              double row_pitch) {
    SpanRows core, out;
    subtract_grown(a, b, radius, row_pitch, core);
    subtract_grown(a, core, reach, row_pitch, out);
    return out;
}

/// Rows beyond the given ones that decide about them.
std::size_t margin_of(const Thinness& thinness, double row_pitch) {
    return static_cast<std::size_t>((thinness.radius + thinness.slack) / row_pitch) + 1;
}

}  // namespace

void thin_rows(const SpanRows& rows, const Thinness& thinness, double row_pitch, SpanRows& out) {
    const std::size_t margin = margin_of(thinness, row_pitch);
    const SpanRows wide = widened(rows, margin);
    without_margin(far_from_what_is_far(wide, void_of(wide), thinness.radius,
                                        thinness.radius + thinness.slack, row_pitch),
                   margin, out);
}

void narrow_rows(const SpanRows& rows, const Thinness& thinness, double row_pitch, SpanRows& out) {
    const std::size_t margin = margin_of(thinness, row_pitch);
    const SpanRows wide = widened(rows, margin);
    without_margin(far_from_what_is_far(void_of(wide), wide, thinness.radius,
                                        thinness.radius + thinness.slack, row_pitch),
                   margin, out);
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
