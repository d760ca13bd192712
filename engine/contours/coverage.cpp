// Coverage from run ends (rows), pixel centres (threshold), and contour chords (exact).
#include "engine/contours/coverage.h"

#include <bit>

#include "engine/contours/lattice.h"
#include "engine/field/slice_context.h"

namespace lamella {
namespace {

/// The grey runs of one pixel row, from left to right.
class RowWriter {
  public:
    RowWriter(std::vector<GreyRun>& out, int width) : out_(out), first_(out.size()), left_(width) {}

    void push(int length, std::uint16_t value) {
        if (length <= 0) return;
        left_ -= length;
        if (out_.size() > first_ && out_.back().value == value) {
            out_.back().length += static_cast<std::uint32_t>(length);
        } else {
            out_.push_back({static_cast<std::uint32_t>(length), value});
        }
    }
    void finish(std::uint16_t value) { push(left_, value); }

  private:
    std::vector<GreyRun>& out_;
    std::size_t first_;
    int left_;
};

/// Sparse changes of coverage along a pixel row. A run that begins at part m / 256 of pixel p adds 256 - m
/// there and m to the next pixel. Each pixel therefore stores, in one word, how many more runs begin than end
/// in it (upper half) and the signed sum of their m (lower half). A bit per pixel marks the words that are
/// set.
class CoverageRow {
  public:
    explicit CoverageRow(int width)
        : width_(static_cast<std::uint32_t>(width)),
          turns_(width_ + 1),
          touched_(width_ / 64 + 2),
          changes_(width_ + slack),
          runs_(width_ + 2) {}

    void add(const Run& run, std::int32_t origin) {
        turn<1>(static_cast<std::uint32_t>(run.begin - origin));
        turn<-1>(static_cast<std::uint32_t>(run.end - origin));
    }

    /// Appends the row as grey runs, and clears it. `value_of` maps coverage (0 to 256 times the lines) to
    /// grey.
    void flush(const std::vector<std::uint16_t>& value_of, std::vector<GreyRun>& out) {
        const std::uint32_t* const end = list_changes();
        const GreyRun* const last = write_runs(end, value_of.data());
        turns_[width_] = 0;
        // If the first pixel is not black, the first run has length zero.
        const GreyRun* const first = runs_.data() + (runs_.front().length == 0 ? 1 : 0);
        out.insert(out.end(), first, last);
    }

  private:
    static constexpr std::int64_t one_turn = std::int64_t{1} << 32;
    static constexpr std::uint32_t at_once = 4, slack = 2 * at_once;

    template <int sign>
    void turn(std::uint32_t u) {
        const std::uint32_t pixel = u / run_unit, part = u % run_unit;
        turns_[pixel] += sign * (one_turn + part);
        touched_[pixel / 64] |= std::uint64_t{1} << pixel % 64;
    }

    // Changes along a row are hard to predict. Both passes over a row therefore avoid branches that depend on
    // them: they write more than needed, and advance by the part that counts.

    /// Lists the pixels whose coverage may differ from their left neighbour's, and clears their bits.
    [[gnu::noinline]] const std::uint32_t* list_changes() {
        std::uint32_t* next = changes_.data();
        for (std::size_t block = 0; block < touched_.size(); block += 64) {
            const std::size_t size = std::min<std::size_t>(64, touched_.size() - block);
            std::uint64_t words = 0;
            for (std::size_t w = 0; w < size; ++w)
                words |= static_cast<std::uint64_t>(touched_[block + w] != 0) << w;
            for (; words != 0; words &= words - 1) {
                const std::size_t w = block + static_cast<std::size_t>(std::countr_zero(words));
                const std::uint64_t touched = touched_[w];
                touched_[w] = 0;
                const auto first = static_cast<std::uint32_t>(w * 64);
                std::uint64_t bits = touched | touched << 1;  // a change affects the next pixel, too
                do {
                    std::uint32_t count = 0;
                    for (std::uint32_t i = 0; i < at_once; ++i) {
                        // Once no bit is left, a top bit that count leaves out keeps the shift in range.
                        constexpr std::uint64_t any = std::uint64_t{1} << 63;
                        next[i] = first + static_cast<std::uint32_t>(std::countr_zero(bits | any));
                        count += bits != 0;
                        bits &= bits - 1;
                    }
                    next += count;
                } while (bits != 0);
                *next = first + 64;
                next += touched >> 63 & ~touched_[w + 1] & 1;
            }
        }
        while (next != changes_.data() && next[-1] >= width_) --next;
        return next;
    }

    /// Converts the changes up to `end` into runs of grey values.
    [[gnu::noinline]] const GreyRun* write_runs(const std::uint32_t* end, const std::uint16_t* value_of) {
        GreyRun* next = runs_.data();
        std::int64_t* const turns = turns_.data();
        std::int64_t cover = 0, spill = 0;  // spill: what the last pixel adds to the next one
        std::uint32_t from = 0;
        std::uint16_t value = 0;
        for (const std::uint32_t* change = changes_.data(); change != end; ++change) {
            const std::uint32_t pixel = *change;
            const std::int64_t turned = turns[pixel];
            turns[pixel] = 0;
            const std::int64_t moment = static_cast<std::int32_t>(turned);
            cover += ((turned - moment) >> 24) - moment + spill;  // 256 for each run end
            spill = moment;
            *next = {pixel - from, value};
            const std::uint16_t here = value_of[cover];
            const bool changes = here != value;
            next += changes;
            from = changes ? pixel : from;
            value = here;
        }
        *next++ = {width_ - from, value};
        return next;
    }

    std::uint32_t width_;
    std::vector<std::int64_t> turns_;
    std::vector<std::uint64_t> touched_;
    std::vector<std::uint32_t> changes_;
    std::vector<GreyRun> runs_;
};

/// Returns the grey value of each coverage, 0 to 256 times the lines: rounded to the nearest, halves upward.
std::vector<std::uint16_t> grey_table(int sub, int white) {
    const int full = run_unit * sub, whole = white / full, part = white % full;
    std::vector<std::uint16_t> table(static_cast<std::size_t>(full) + 1);
    // c * white + full / 2 divided by full, from one c to the next.
    int value = 0, rest = full / 2;
    for (std::uint16_t& grey : table) {
        grey = static_cast<std::uint16_t>(value);
        value += whole;
        rest += part;
        if (rest >= full) {
            rest -= full;
            ++value;
        }
    }
    return table;
}

/// Twice the area of a full cell, in square run units.
constexpr std::int64_t full_cell = std::int64_t{2} * run_unit * run_unit;

/// Returns twice the area of the solid part of a cell, in square run units, bounded by its border arcs and
/// chords.
std::int64_t solid_area(const Lattice::Cell& cell, std::span<const Crossing> crossings) {
    const std::int64_t x0 = std::int64_t{cell.i} * run_unit, y0 = std::int64_t{cell.j} * run_unit;
    const std::int64_t corner_x[4] = {run_unit, run_unit, 0, 0}, corner_y[4] = {0, run_unit, run_unit, 0};
    struct Point {
        std::int64_t x, y;
    };
    const auto point = [&](std::size_t k) {
        const Crossing& c = crossings[cell.border[k]];
        return Point{c.x - x0, c.y - y0};
    };
    std::int64_t twice = 0;
    const auto edge = [&](Point p, Point q) { twice += p.x * q.y - p.y * q.x; };
    const std::size_t n = cell.border.size();
    for (std::size_t k = 0; k < n; ++k) {
        if (cell.leaves_solid(k)) {
            edge(point(k), point(cell.chord_end(k)));
            continue;
        }
        // A solid arc along the cell's border, around the corners between this crossing and the next.
        Point at = point(k);
        const std::size_t next = (k + 1) % n;
        const int turns = (cell.side[next] - cell.side[k] + 4) % 4;
        const int corners = turns == 0 && next <= k ? 4 : turns;
        for (int c = 0; c < corners; ++c) {
            const int corner = (cell.side[k] + c) % 4;
            const Point q{corner_x[corner], corner_y[corner]};
            edge(at, q);
            at = q;
        }
        edge(at, point(next));
    }
    return twice;
}

}  // namespace

void coverage(const RowBand& band, const RunRows& spans, std::vector<GreyRun>& out, int white) {
    const std::vector<std::uint16_t> value_of = grey_table(band.sub, white);
    CoverageRow row(band.hi - band.lo);
    const std::int32_t origin = band.lo * run_unit;
    std::size_t line = 0;
    for (int r = 0; r < band.count; ++r) {
        for (int k = 0; k < band.sub; ++k, ++line) {
            for (const Run& run : spans.line(line)) row.add(run, origin);
        }
        row.flush(value_of, out);
    }
}

void threshold(const RowBand& band, const RunRows& spans, std::vector<GreyRun>& out, int white) {
    // Pixel j has its centre at 256 j + 128.
    const auto first_at_or_after = [&](std::int32_t u) { return ((u + run_unit / 2 - 1) >> 8) - band.lo; };
    for (std::size_t l = 0; l < spans.lines(); ++l) {
        RowWriter row(out, band.hi - band.lo);
        int from = 0;
        for (const Run& run : spans.line(l)) {
            const int begin = first_at_or_after(run.begin), end = first_at_or_after(run.end);
            row.push(begin - from, 0);
            row.push(end - begin, static_cast<std::uint16_t>(white));
            from = end;
        }
        row.finish(0);
    }
}

void coverage_exact(const SliceField& slice, const RowBand& band, Scratch& scratch, std::vector<GreyRun>& out,
                    int white) {
    // A pixel is 2 x 2 lattice cells, so that a chord's deviation from a curve stays small against the pixel.
    // A ring of pixels around the band keeps the grid's empty border outside of it. A mirrored band is a
    // lattice of negative pitch.
    constexpr int split = 2;
    const bool rows = band.axis == Axis::x;
    const int width = band.hi - band.lo + 2, height = band.count + 2;
    const dvec2 pitch =
        rows ? dvec2(band.along_pitch, band.across_pitch) : dvec2(band.across_pitch, band.along_pitch);
    const Grid grid{on_band(band, (band.lo - 1.0) * run_unit, band.first - 1.0), pitch / double(split),
                    split * (rows ? width : height), split * (rows ? height : width)};
    const Lattice lattice(slice, grid, scratch);

    const auto columns = static_cast<std::size_t>(grid.columns / split);
    std::vector<std::int64_t> area(columns * static_cast<std::size_t>(grid.rows / split));
    for (int j = 0; j < grid.rows; ++j) {
        std::int64_t* const row = area.data() + static_cast<std::size_t>(j / split) * columns;
        int from = 0;
        const auto fill = [&](int to) {
            if (to <= from || !lattice.solid(from, j)) return;
            for (int i = from; i < to; ++i) row[i / split] += full_cell;
        };
        lattice.visit_cells(j, [&](const Lattice::Cell& cell) {
            fill(cell.i);
            row[cell.i / split] += solid_area(cell, lattice.crossings());
            from = cell.i + 1;
        });
        fill(grid.columns);
    }
    constexpr std::int64_t full = full_cell * split * split;
    for (int r = 1; r + 1 < height; ++r) {
        RowWriter row(out, band.hi - band.lo);
        for (int p = 1; p + 1 < width; ++p) {
            const auto i = static_cast<std::size_t>(rows ? p : r), j = static_cast<std::size_t>(rows ? r : p);
            row.push(1, static_cast<std::uint16_t>((area[j * columns + i] * white + full / 2) / full));
        }
    }
}

}  // namespace lamella
