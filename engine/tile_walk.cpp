// The tile walk: quadtree over a band, samples only where the range does not decide.
#include "engine/tile_walk.h"

#include <vector>

#include "engine/slice_context.h"

namespace lamella {
namespace {

constexpr int tile_rows = 16;      // lines of a leaf tile
constexpr int tile_pixels = 16;    // pixels along a leaf tile
constexpr int quarter_splits = 2;  // 1 pitch -> 1/4 pitch
constexpr int bisections = 10;     // 1/4 pitch (64 units) -> 1/16 unit

/// Walks the leaf tiles of one strip of lines and collects the runs of each line from left to right.
class StripWalk {
  public:
    StripWalk(const SliceField& slice, Metric metric, const RowBand& band)
        : slice_(slice), metric_(metric), band_(band) {}

    /// Lines [first, last) of the band, all pixels.
    void walk(int first, int last, SpanRows& out) {
        first_ = first;
        last_ = last;
        lines_.assign(static_cast<std::size_t>(last - first), {});
        int width = 1;
        while (width * tile_pixels < band_.hi - band_.lo) width *= 2;
        visit(band_.lo, width * tile_pixels);
        for (const auto& line : lines_) {
            for (const Run& run : line) out.push(run.begin, run.end);
            out.end_line();
        }
    }

  private:
    dvec2 point(double u, int line) const {
        const double along = band_.along(u), across = band_.line(line);
        return band_.axis == Axis::x ? dvec2(along, across) : dvec2(across, along);
    }

    Rect rect(int lo, int hi) const {
        const dvec2 a = point(static_cast<double>(lo) * run_unit, first_);
        const dvec2 b = point(static_cast<double>(hi) * run_unit, last_ - 1);
        return {glm::min(a, b), glm::max(a, b)};
    }

    /// Visits pixels [lo, lo + size) of the strip in order.
    void visit(int lo, int size) {
        const int hi = std::min(lo + size, band_.hi);
        if (lo >= hi) return;
        const Interval values = slice_.range(rect(lo, hi));
        if (values.lo > 0) return;
        if (values.hi < 0) return fill(lo, hi);
        if (size == tile_pixels) return sample_tile(lo, hi);
        visit(lo, size / 2);
        visit(lo + size / 2, size / 2);
    }

    void fill(int lo, int hi) {
        for (auto& line : lines_) add(line, lo * run_unit, hi * run_unit);
    }

    static void add(std::vector<Run>& line, std::int32_t begin, std::int32_t end) {
        if (begin >= end) return;
        if (!line.empty() && line.back().end >= begin) {
            line.back().end = end;
        } else {
            line.push_back({begin, end});
        }
    }

    double value(double u, int line) const {
        float v = 0;
        slice_.sample({point(u, line), dvec2(1), 1, 1}, {&v, 1});
        return v;
    }

    void sample_tile(int lo, int hi) {
        const int n = hi - lo + 1;
        samples_.resize(static_cast<std::size_t>(n));
        for (int l = first_; l < last_; ++l) {
            const dvec2 from = point(static_cast<double>(lo) * run_unit, l);
            const dvec2 step(band_.along_pitch);
            const Tile tile = band_.axis == Axis::x ? Tile{from, step, n, 1} : Tile{from, step, 1, n};
            slice_.sample(tile, samples_);
            begin_ = samples_[0] < 0 ? lo * run_unit : none;
            line_ = l;
            for (int i = 0; i + 1 < n; ++i) {
                cross(static_cast<double>(lo + i) * run_unit, samples_[static_cast<std::size_t>(i)],
                      static_cast<double>(lo + i + 1) * run_unit, samples_[static_cast<std::size_t>(i) + 1],
                      quarter_splits);
            }
            if (begin_ != none) close(hi * run_unit);
        }
    }

    void close(std::int32_t end) {
        add(lines_[static_cast<std::size_t>(line_ - first_)], begin_, end);
        begin_ = none;
    }

    /// Finds the crossings between two samples and opens or closes the run there.
    void cross(double u0, double v0, double u1, double v1, int splits) {
        const bool in0 = v0 < 0, in1 = v1 < 0;
        if (in0 == in1) {
            const double gap = (u1 - u0) * std::abs(band_.along_pitch) / run_unit;
            const bool proven = metric_ != Metric::sign && std::abs(v0) + std::abs(v1) >= gap;
            if (proven || splits == 0) return;
        } else if (splits == 0) {
            return turn(crossing(u0, u1, in0), in1);
        }
        const double middle = (u0 + u1) * 0.5, v = value(middle, line_);
        cross(u0, v0, middle, v, splits - 1);
        cross(middle, v, u1, v1, splits - 1);
    }

    std::int32_t crossing(double u0, double u1, bool in0) const {
        for (int i = 0; i < bisections; ++i) {
            const double middle = (u0 + u1) * 0.5;
            if ((value(middle, line_) < 0) == in0) {
                u0 = middle;
            } else {
                u1 = middle;
            }
        }
        return round_run((u0 + u1) * 0.5);
    }

    void turn(std::int32_t u, bool solid) {
        if (solid) {
            begin_ = u;
        } else {
            close(u);
        }
    }

    static constexpr std::int32_t none = std::numeric_limits<std::int32_t>::min();

    const SliceField& slice_;
    Metric metric_;
    const RowBand& band_;
    int first_ = 0, last_ = 0;
    std::vector<std::vector<Run>> lines_;
    std::vector<float> samples_;
    std::int32_t begin_ = none;
    int line_ = 0;
};

}  // namespace

void sampled_spans(const SliceField& slice, Metric metric, const RowBand& band, SpanRows& out) {
    out.clear();
    StripWalk walk(slice, metric, band);
    for (int first = 0; first < band.lines(); first += tile_rows) {
        walk.walk(first, std::min(first + tile_rows, band.lines()), out);
    }
}

void SampledSlice::spans(const RowBand& band, Scratch& /*scratch*/, SpanRows& out) const {
    sampled_spans(*this, field_.metric(), band, out);
}

Interval SampledSlice::range(const Rect& r) const { return field_.range({{r.lo, z_}, {r.hi, z_}}); }

void SampledSlice::sample(const Tile& tile, std::span<float> out) const {
    std::size_t k = 0;
    for (int j = 0; j < tile.ny; ++j) {
        for (int i = 0; i < tile.nx; ++i) {
            const dvec3 p(tile.origin.x + i * tile.step.x, tile.origin.y + j * tile.step.y, z_);
            out[k++] = static_cast<float>(field_.value(p));
        }
    }
}

Rect SampledSlice::bounds() const {
    const Box box = field_.bounds();
    return box.lo.z <= z_ && z_ <= box.hi.z ? box.rect() : Rect{};
}

}  // namespace lamella
