// CoarseCells: several rows are marked in one line of cells.
#include "engine/morphology/coarse_cells.h"

#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

CellLattice coarse_lattice(const RunRows& rows, std::int32_t scale, double reach, double row_pitch) {
    const Run extent = extent_of(rows);
    const auto lines = static_cast<std::size_t>(scale);
    return {{extent.begin / scale - 1, extent.end / scale + 1},
            (rows.lines() + lines - 1) / lines,
            reach / scale,
            row_pitch};
}

}  // namespace

CoarseCells::CoarseCells(const RunRows& rows, std::int32_t scale, double reach, double row_pitch)
    : scale_(scale),
      row_count_(rows.lines()),
      solid_(coarse_lattice(rows, scale, reach, row_pitch)),
      void_(solid_.lattice()) {
    const CellLattice& lattice = solid_.lattice();
    const auto row_cells = static_cast<std::int32_t>(lattice.words) * CellLattice::word_cells;
    const std::int32_t first = lattice.first * scale, end = first + row_cells * scale * CellLattice::cell;
    for (std::size_t line = 0; line < lattice.lines; ++line) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(scale); ++i) {
            const std::size_t l = line * static_cast<std::size_t>(scale) + i;
            std::int32_t at = first;
            if (l >= margin() && l < margin() + row_count_) {
                for (const Run& run : rows.line(l - margin())) {
                    add(at, run.begin, line, void_);
                    add(run.begin, run.end, line, solid_);
                    at = run.end;
                }
            }
            add(at, end, line, void_);
        }
    }
}

void CoarseCells::add(std::int32_t begin, std::int32_t end, std::size_t line, RowBitmask& to) {
    if (begin >= end) return;
    const std::int32_t length = scale_ * CellLattice::cell, first = to.lattice().first * scale_;
    to.mark((begin - first) / length, (end - first + length - 1) / length, line);
}

RunRows CoarseCells::rows_of(const RowBitmask& cells) const {
    const auto lines = static_cast<std::size_t>(scale_);
    const std::size_t count = row_count_ + 2 * margin();
    const RunRows coarse = cells.runs(0, (count + lines - 1) / lines);
    RunRows rows;
    rows.reserve(count, coarse.runs().size() * lines);
    for (std::size_t l = 0; l < count; ++l) {
        for (const Run& run : coarse.line(l / lines)) rows.push(run.begin * scale_, run.end * scale_);
        rows.end_line();
    }
    return rows;
}

}  // namespace lamella
