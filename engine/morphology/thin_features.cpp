// Thin features: the points outside the dilated erosion (the opening with slack). Bit masks cull first.
#include "engine/morphology/thin_features.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/morphology/coarse_cells.h"
#include "engine/runs/row_sets.h"

namespace lamella {

namespace {

/// Returns the distance within which the solid decides whether a point is too thin.
double thinness_reach(const Thinness& thinness) { return 2 * thinness.radius + thinness.slack; }

RunRows void_of(const RunRows& rows) { return complement(rows, -unbounded, unbounded); }

void without_margin(const RunRows& wide, std::size_t margin, RunRows& out) {
    out.clear();
    out.reserve(wide.lines(), wide.runs().size());
    out.append_lines(wide, margin, wide.lines() - 2 * margin);
}

/// Returns the candidate cells: cells of the medium that may contain too thin points. `touched` are the cells
/// that meet the medium, `beside` those that meet its complement. A cell is no candidate if it lies surely
/// within `reach` of a cell of ball centres, that is, one that no disc of `radius` about `beside` meets.
RowBitmask candidate_cells(RowBitmask touched, const RowBitmask& beside, double radius, double reach,
                           double row_pitch) {
    touched.subtract_dilated(beside.beyond(outer_disc(radius, row_pitch)), inner_disc(reach, row_pitch));
    return touched;
}

/// Returns how many rows wide a cell may be to find few enough candidates: a fourth of the radius.
std::int32_t cell_scale(const Thinness& thinness) {
    constexpr std::int32_t cells_in_radius = 4;
    return std::max(static_cast<std::int32_t>(thinness.radius / (cells_in_radius * run_unit)), 1);
}

/// Returns the part of the solid or of the void that lies in `where`, whose rows include a margin.
RunRows kind_within(const RunRows& where, const RunRows& rows, std::size_t margin, FeatureKind kind) {
    RunRows within;
    for (std::size_t l = 0; l < where.lines(); ++l) {
        const bool in_margin = l < margin || l >= margin + rows.lines();
        const std::span<const Run> solid = in_margin ? std::span<const Run>() : rows.line(l - margin);
        if (kind == FeatureKind::wall) {
            intersect_line(where.line(l), solid, within);
        } else {
            subtract_line(where.line(l), solid, within);
        }
    }
    return within;
}

/// Returns one run per line: from the first to the last point in the bounding square of a ball about any
/// point of `rows`.
RunRows extents_about(const RunRows& rows, double radius, double row_pitch) {
    const auto beside = static_cast<std::size_t>(radius / row_pitch);
    const std::int32_t along = static_cast<std::int32_t>(radius) + 1;
    RunRows all;
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        std::int32_t begin = unbounded, end = -unbounded;
        for (std::size_t k = l - std::min(l, beside); k < std::min(l + beside + 1, rows.lines()); ++k) {
            const std::span<const Run> runs = rows.line(k);
            if (runs.empty()) continue;
            begin = std::min(begin, runs.front().begin - along);
            end = std::max(end, runs.back().end + along);
        }
        all.push(begin, end);
        all.end_line();
    }
    return all;
}

/// `at`: where points may be too thin. `near`: where ball centres matter, within radius + slack of `at`. The
/// rows include a margin.
struct Candidates {
    RunRows at, near;
    std::size_t margin;
};

Candidates suspicion_of(const LayerCells& cells, std::size_t row_count, FeatureKind kind,
                        const Thinness& thinness, double row_pitch) {
    RowBitmask void_outer = cells.inner;
    void_outer.invert();
    const double reach = thinness.radius + thinness.slack;
    const RowBitmask suspected =
        kind == FeatureKind::wall
            ? candidate_cells(cells.outer, void_outer, thinness.radius, reach, row_pitch)
            : candidate_cells(void_outer, cells.outer, thinness.radius, reach, row_pitch);
    const std::size_t margin = cells.outer.lattice().margin_lines, lines = row_count + 2 * margin;
    Candidates found{suspected.runs(0, lines), {}, margin};
    if (!found.at.runs().empty()) found.near = suspected.grown(outer_disc(reach, row_pitch)).runs(0, lines);
    return found;
}

/// Finds candidates with cells of several rows.
Candidates coarse_suspicion_of(const RunRows& rows, FeatureKind kind, const Thinness& thinness,
                               double row_pitch) {
    // Rows of two cells may be up to one row of cells nearer or farther than the cells; 1 covers rounding
    // errors.
    const double rounding_margin = row_pitch + 1;
    const std::int32_t scale = cell_scale(thinness);
    const CoarseCells cells(rows, scale, thinness_reach(thinness), row_pitch);
    const double radius = thinness.radius / scale, reach = (thinness.radius + thinness.slack) / scale;
    const bool of_solid = kind == FeatureKind::wall;
    const RowBitmask suspected =
        candidate_cells(of_solid ? cells.solid() : cells.voids(), of_solid ? cells.voids() : cells.solid(),
                        radius + rounding_margin, reach - rounding_margin, row_pitch);
    Candidates found{cells.rows_of(suspected), {}, cells.margin()};
    if (!found.at.runs().empty())
        found.near = cells.rows_of(suspected.grown(outer_disc(reach + rounding_margin, row_pitch)));
    return found;
}

/// Exact test of the candidates: finds the too thin points of the medium among them.
void thin_among(const Candidates& suspicion, const RunRows& rows, FeatureKind kind, const Thinness& thinness,
                double row_pitch, RunRows& out) {
    if (suspicion.at.runs().empty()) {
        out = empty_rows(rows.lines());
        return;
    }
    const double reach = thinness.radius + thinness.slack;
    const RunRows about = extents_about(suspicion.near, thinness.radius, row_pitch);
    const FeatureKind other = kind == FeatureKind::wall ? FeatureKind::gap : FeatureKind::wall;
    const auto within = [&](const RunRows& where, FeatureKind in) {
        return kind_within(where, rows, suspicion.margin, in);
    };
    RunRows core, thin;
    subtract_dilated(within(suspicion.near, kind), within(about, other), thinness.radius, row_pitch, core);
    subtract_dilated(within(suspicion.at, kind), core, reach, row_pitch, thin);
    without_margin(thin, suspicion.margin, out);
}

void thin_rows_by_coarse_cells(const RunRows& rows, FeatureKind kind, const Thinness& thinness,
                               double row_pitch, RunRows& out) {
    thin_among(coarse_suspicion_of(rows, kind, thinness, row_pitch), rows, kind, thinness, row_pitch, out);
}

}  // namespace

RunRows widened(const RunRows& rows, std::size_t margin) {
    RunRows wide;
    wide.reserve(rows.lines() + 2 * margin, rows.runs().size());
    for (std::size_t l = 0; l < margin; ++l) wide.end_line();
    wide.append_lines(rows);
    for (std::size_t l = 0; l < margin; ++l) wide.end_line();
    return wide;
}

std::size_t margin_of(const Thinness& thinness, double row_pitch) {
    return static_cast<std::size_t>((thinness.radius + thinness.slack) / row_pitch) + 1;
}

double reach_of_cells(const Thinness& thinness) {
    return cell_scale(thinness) > 1 ? 0 : thinness_reach(thinness);
}

void thin_rows(const RunRows& rows, FeatureKind kind, const Thinness& thinness, double row_pitch,
               RunRows& out) {
    if (cell_scale(thinness) > 1) return thin_rows_by_coarse_cells(rows, kind, thinness, row_pitch, out);
    const LayerCells cells(rows, {extent_of(rows), rows.lines(), thinness_reach(thinness), row_pitch});
    thin_rows(rows, cells, kind, thinness, row_pitch, out);
}

void thin_rows(const RunRows& rows, const LayerCells& cells, FeatureKind kind, const Thinness& thinness,
               double row_pitch, RunRows& out) {
    if (cell_scale(thinness) > 1) return thin_rows_by_coarse_cells(rows, kind, thinness, row_pitch, out);
    thin_among(suspicion_of(cells, rows.lines(), kind, thinness, row_pitch), rows, kind, thinness, row_pitch,
               out);
}

ThinFeatureStream::ThinFeatureStream(const LayerLattice& lattice, const Thinness& thinness, FeatureKind kind)
    : kind_(kind),
      lines_(lattice.lines),
      margin_(margin_of(thinness, lattice.row_pitch)),
      beyond_(lattice.layers_within(thinness.radius) +
              lattice.layers_within(thinness.radius + thinness.slack)),
      to_drop_(beyond_),
      core_(lattice, thinness.radius),
      thin_(lattice, thinness.radius + thinness.slack) {
    push_beyond();
}

/// Pushes empty layers: the void extends beyond the given layers, and balls fit there.
void ThinFeatureStream::push_beyond() {
    for (std::size_t i = 0; i < beyond_; ++i) push_wide(empty_rows(lines_ + 2 * margin_));
}

void ThinFeatureStream::push(const RunRows& layer) {
    if (layer.lines() != lines_) throw FaultError("a layer has other lines than the lattice");
    ++to_come_;
    push_wide(widened(layer, margin_));
}

void ThinFeatureStream::push_wide(RunRows layer) {
    RunRows voids = void_of(layer);
    if (kind_ == FeatureKind::gap) std::swap(layer, voids);
    of_.push_back(layer);
    core_.push(std::move(layer), std::move(voids));
    carry_on();
}

void ThinFeatureStream::finish() {
    push_beyond();
    core_.finish();
    carry_on();
    thin_.finish();
}

void ThinFeatureStream::carry_on() {
    for (RunRows core; core_.pop(core);) {
        thin_.push(std::move(of_.front()), std::move(core));
        of_.pop_front();
    }
}

bool ThinFeatureStream::pop(RunRows& out) {
    RunRows wide;
    for (; to_drop_ > 0; --to_drop_) {
        if (!thin_.pop(wide)) return false;
    }
    if (to_come_ == 0 || !thin_.pop(wide)) return false;
    --to_come_;
    without_margin(wide, margin_, out);
    return true;
}

}  // namespace lamella
