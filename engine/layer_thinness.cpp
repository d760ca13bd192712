// What is far from what is far from the border.
#include "engine/layer_thinness.h"

#include "engine/error.h"
#include "engine/row_sets.h"

namespace lamella {

namespace {

/// Rows with `margin` empty ones on either side.
SpanRows widened(const SpanRows& rows, std::size_t margin) {
    SpanRows wide = empty_rows(margin);
    wide.append_lines(rows);
    for (std::size_t l = 0; l < margin; ++l) wide.end_line();
    return wide;
}

SpanRows void_of(const SpanRows& rows) { return complement(rows, -far_out, far_out); }

void without_margin(const SpanRows& wide, std::size_t margin, SpanRows& out) {
    out.clear();
    out.append_lines(wide, margin, wide.lines() - 2 * margin);
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

ThinLayers::ThinLayers(const LayerLattice& lattice, const Thinness& thinness, Medium medium)
    : medium_(medium),
      lines_(lattice.lines),
      margin_(margin_of(thinness, lattice.row_pitch)),
      beyond_(lattice.layers_within(thinness.radius) +
              lattice.layers_within(thinness.radius + thinness.slack)),
      to_drop_(beyond_),
      core_(lattice, thinness.radius),
      thin_(lattice, thinness.radius + thinness.slack) {
    push_beyond();
}

/// The void goes on, and balls fit there.
void ThinLayers::push_beyond() {
    for (std::size_t i = 0; i < beyond_; ++i) push_wide(empty_rows(lines_ + 2 * margin_));
}

void ThinLayers::push(const SpanRows& layer) {
    if (layer.lines() != lines_) throw FaultError("a layer has other lines than the lattice");
    ++to_come_;
    push_wide(widened(layer, margin_));
}

void ThinLayers::push_wide(SpanRows layer) {
    SpanRows voids = void_of(layer);
    if (medium_ == Medium::gaps) std::swap(layer, voids);
    of_.push_back(layer);
    core_.push(std::move(layer), std::move(voids));
    carry_on();
}

void ThinLayers::finish() {
    push_beyond();
    core_.finish();
    carry_on();
    thin_.finish();
}

void ThinLayers::carry_on() {
    for (SpanRows core; core_.pop(core);) {
        thin_.push(std::move(of_.front()), std::move(core));
        of_.pop_front();
    }
}

bool ThinLayers::pop(SpanRows& out) {
    SpanRows wide;
    for (; to_drop_ > 0; --to_drop_) {
        if (!thin_.pop(wide)) return false;
    }
    if (to_come_ == 0 || !thin_.pop(wide)) return false;
    --to_come_;
    without_margin(wide, margin_, out);
    return true;
}

}  // namespace lamella
