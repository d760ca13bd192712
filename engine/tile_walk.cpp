// The tile walk: tiles of a band halved until the range decides or they are small, then samples.
#include "engine/tile_walk.h"

#include <cstring>
#include <vector>

#include "engine/crossing_bracket.h"
#include "engine/slice_context.h"

namespace lamella {
namespace {

constexpr int leaf_lines = 8;
constexpr int leaf_pixels = 8;
constexpr int quarter = run_unit / 4;
constexpr int cells_per_unit = 16;  // a crossing is found to 1/16 of a run unit
constexpr int guesses = 3;          // rounds of interpolation before plain halving
constexpr int guesses_of_one = 6;   // where there is one crossing only
constexpr int one_way_pixels = 16;  // tiles up to this size are asked whether values rise or fall all along

/// Two neighbouring samples of a line, at run coordinates u0 < u1.
struct Pair {
    double u0, u1;
    double v0, v1;
    int line;

    bool crosses() const { return (v0 < 0) != (v1 < 0); }
};

/// Walks the tiles of a band and collects the runs of each line from left to right.
class TileWalk {
  public:
    TileWalk(WalkedSolid& solid, Metric metric, const RowBand& band)
        : solid_(solid),
          metric_(metric),
          band_(band),
          cell_(std::abs(band.along_pitch) / (run_unit * cells_per_unit)),
          lines_(static_cast<std::size_t>(band.lines())) {
        for (int l = 0; l < band.lines(); ++l) positions_.push_back(band.line(l));
    }

    void walk(SpanRows& out) {
        if (band_.lo < band_.hi && band_.lines() > 0) {
            int width = leaf_pixels, height = leaf_lines;
            while (width < band_.hi - band_.lo) width *= 2;
            while (height < band_.lines()) height *= 2;
            visit({band_.lo, width, 0, height});
        }
        for (const auto& line : lines_) out.append_line(line);
    }

  private:
    /// Pixels [lo, lo + width) of lines [first, first + height), as far as the band has them.
    struct Place {
        int lo, width, first, height;
    };

    double position(int line) const { return positions_[static_cast<std::size_t>(line)]; }
    int end_pixel(const Place& p) const { return std::min(p.lo + p.width, band_.hi); }
    int end_line(const Place& p) const { return std::min(p.first + p.height, band_.lines()); }

    Rect rect(const Place& p) const {
        const auto point = [&](int pixel, int line) {
            const double along = band_.along(static_cast<double>(pixel) * run_unit);
            const double across = position(line);
            return band_.axis == Axis::x ? dvec2(along, across) : dvec2(across, along);
        };
        const dvec2 a = point(p.lo, p.first), b = point(end_pixel(p), end_line(p) - 1);
        return {glm::min(a, b), glm::max(a, b)};
    }

    /// Visits a tile; those of one line come from left to right.
    void visit(const Place& p) {
        if (p.lo >= band_.hi || p.first >= band_.lines()) return;
        const Interval values = solid_.enter(rect(p));
        if (values.hi < 0) {
            fill(p);
        } else if (!(values.lo > 0)) {
            descend(p);
        }
        solid_.leave();
    }

    void descend(const Place& p) {
        const int across = p.width / leaf_pixels, down = p.height / leaf_lines;
        if (metric_ == Metric::sign && std::max(p.width, p.height) <= one_way_pixels) {
            // Half a cell, for positions are rounded.
            one_way_ = solid_.slope(band_.axis).one_way(0.5 * cell_);
            if (one_way_) return sample_ends(p);
        }
        if (across == 1 && down == 1) return sample(p);
        // Long tiles are halved until they have the shape of a leaf: ranges over squares are narrowest.
        const bool wide = across >= down, high = down >= across;
        const int width = wide ? p.width / 2 : p.width, height = high ? p.height / 2 : p.height;
        for (int first = p.first; first < p.first + p.height; first += height) {
            for (int lo = p.lo; lo < p.lo + p.width; lo += width) visit({lo, width, first, height});
        }
    }

    void fill(const Place& p) {
        for (int l = p.first; l < end_line(p); ++l) add(l, p.lo * run_unit, end_pixel(p) * run_unit);
    }

    void add(int line, std::int32_t begin, std::int32_t end) {
        auto& runs = lines_[static_cast<std::size_t>(line)];
        if (begin >= end) return;
        if (!runs.empty() && runs.back().end >= begin) {
            runs.back().end = end;
        } else {
            runs.push_back({begin, end});
        }
    }

    /// Samples the ends of a tile's lines, each of which has one crossing at most.
    void sample_ends(const Place& p) {
        const int begin = p.lo * run_unit, end = end_pixel(p) * run_unit;
        along_.clear();
        across_.clear();
        for (int l = p.first; l < end_line(p); ++l) {
            along_.insert(along_.end(), {band_.along(begin), band_.along(end)});
            across_.insert(across_.end(), 2, position(l));
        }
        samples_.resize(along_.size());
        solid_.values({band_.axis, along_, across_, false}, samples_);
        pairs_.clear();
        for (int l = p.first; l < end_line(p); ++l) {
            const double* const v = samples_.data() + 2 * static_cast<std::size_t>(l - p.first);
            const Pair pair{static_cast<double>(begin), static_cast<double>(end), v[0], v[1], l};
            if (pair.crosses()) pairs_.push_back(pair);
        }
        find_crossings();
        turn(p, begin, end);
    }

    void sample(const Place& p) {
        // Where values prove nothing, all quarters are wanted at once.
        const int step = metric_ == Metric::sign ? quarter : run_unit;
        const int begin = p.lo * run_unit, end = end_pixel(p) * run_unit;
        along_.clear();
        across_.clear();
        for (int u = begin; u <= end; u += step) along_.push_back(band_.along(u));
        for (int l = p.first; l < end_line(p); ++l) across_.push_back(position(l));
        samples_.resize(along_.size() * across_.size());
        solid_.values({band_.axis, along_, across_, true}, samples_);
        pairs_.clear();
        for (std::size_t l = 0; l < across_.size(); ++l) {
            const double* const v = samples_.data() + l * along_.size();
            const int line = p.first + static_cast<int>(l);
            const auto pair = [&](std::size_t i) {
                const double u = begin + static_cast<int>(i) * step;
                return Pair{u, u + step, v[i], v[i + 1], line};
            };
            if (step == quarter) {
                turns_of({v, along_.size()}, [&](std::size_t i) { pairs_.push_back(pair(i)); });
            } else {
                for (std::size_t i = 0; i + 1 < along_.size(); ++i) consider(pair(i), pairs_);
            }
        }
        for (int gap = step; gap > quarter; gap /= 2) split();
        find_crossings();
        turn(p, begin, end);
    }

    /// Calls `turn(i)` for every i whose value lies on another side than the next one.
    template <class Turn>
    void turns_of(std::span<const double> values, const Turn& turn) {
        constexpr std::size_t word = sizeof(std::uint64_t);
        inside_.assign(values.size() + word, 0);
        std::uint8_t* const flags = inside_.data();
        const double* const v = values.data();
        const std::size_t count = values.size();
        for (std::size_t i = 0; i < count; ++i) flags[i] = v[i] < 0 ? 1 : 0;
        for (std::size_t i = 0; i + 1 < values.size(); i += word) {
            std::uint64_t here = 0, next = 0;
            std::memcpy(&here, inside_.data() + i, word);
            std::memcpy(&next, inside_.data() + i + 1, word);
            if (here == next) continue;
            for (std::size_t k = i; k < std::min(i + word, values.size() - 1); ++k) {
                if (inside_[k] != inside_[k + 1]) turn(k);
            }
        }
    }

    /// Keeps a pair that may have a surface between its samples.
    void consider(const Pair& pair, std::vector<Pair>& out) const {
        const double width = pair.u1 - pair.u0;
        if (!pair.crosses()) {
            const double gap = width * std::abs(band_.along_pitch) / run_unit;
            const bool proven = metric_ != Metric::sign && std::abs(pair.v0) + std::abs(pair.v1) >= gap;
            if (proven || width <= quarter) return;
        }
        out.push_back(pair);
    }

    /// The values halfway between the samples of all pairs.
    void sample_middles() {
        along_.clear();
        across_.clear();
        for (const Pair& pair : pairs_) {
            along_.push_back(band_.along((pair.u0 + pair.u1) * 0.5));
            across_.push_back(position(pair.line));
        }
        middles_.resize(pairs_.size());
        if (!pairs_.empty()) solid_.values({band_.axis, along_, across_, false}, middles_);
    }

    /// Halves all pairs.
    void split() {
        sample_middles();
        halves_.clear();
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            const Pair& pair = pairs_[i];
            const double middle = (pair.u0 + pair.u1) * 0.5;
            consider({pair.u0, middle, pair.v0, middles_[i], pair.line}, halves_);
            consider({middle, pair.u1, middles_[i], pair.v1, pair.line}, halves_);
        }
        pairs_.swap(halves_);
    }

    /// Narrows all pairs, each of which has a crossing, to the cell where it lies.
    void find_crossings() {
        brackets_.clear();
        for (const Pair& pair : pairs_) {
            const int cells = static_cast<int>(pair.u1 - pair.u0) * cells_per_unit;
            brackets_.push_back({0, cells, pair.v0, pair.v1});
        }
        const Search last = solid_.signs_only() && !one_way_ ? Search::signs : Search::halves;
        const int chords = one_way_ ? guesses_of_one : last == Search::signs ? 0 : guesses;
        for (int round = 0; ask_borders(round < chords ? Search::chord : last); ++round) {
            solid_.values({band_.axis, along_, across_, false}, middles_);
            std::size_t k = 0;
            for (std::size_t i = 0; i < pairs_.size(); ++i) {
                if (brackets_[i].hi - brackets_[i].lo == 1) continue;
                for (std::size_t n = 0; n < tried_; ++n, ++k)
                    brackets_[i].take(borders_[k], middles_[k], pairs_[i].v0 < 0);
            }
        }
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            Pair& pair = pairs_[i];
            pair.u1 = pair.u0 + static_cast<double>(brackets_[i].hi) / cells_per_unit;
            pair.u0 = pair.u0 + static_cast<double>(brackets_[i].lo) / cells_per_unit;
        }
    }

    /// Lists cell borders of every pair whose cell is not found yet; tells whether there are any.
    bool ask_borders(Search search) {
        along_.clear();
        across_.clear();
        borders_.clear();
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            const Bracket& bracket = brackets_[i];
            if (bracket.hi - bracket.lo == 1) continue;
            const Bracket::Borders borders = bracket.next(search);
            tried_ = borders.count;
            for (std::size_t n = 0; n < tried_; ++n) {
                const double u = pairs_[i].u0 + static_cast<double>(borders.at[n]) / cells_per_unit;
                borders_.push_back(borders.at[n]);
                along_.push_back(band_.along(u));
                across_.push_back(position(pairs_[i].line));
            }
        }
        middles_.resize(borders_.size());
        return !borders_.empty();
    }

    /// Turns the crossings of a tile into runs.
    void turn(const Place& p, std::int32_t begin, std::int32_t end) {
        const std::size_t per_line = samples_.size() / static_cast<std::size_t>(end_line(p) - p.first);
        std::size_t k = 0;
        for (int l = p.first; l < end_line(p); ++l) {
            bool inside = samples_[static_cast<std::size_t>(l - p.first) * per_line] < 0;
            std::int32_t from = begin;
            for (; k < pairs_.size() && pairs_[k].line == l; ++k) {
                const std::int32_t u = round_run((pairs_[k].u0 + pairs_[k].u1) * 0.5);
                if (inside) add(l, from, u);
                from = u;
                inside = !inside;
            }
            if (inside) add(l, from, end);
        }
    }

    WalkedSolid& solid_;
    Metric metric_;
    const RowBand& band_;
    double cell_;           ///< mm
    bool one_way_ = false;  ///< every line of the tile has one crossing at most
    std::vector<std::vector<Run>> lines_;
    std::vector<double> positions_;  ///< of the lines, mm across
    std::vector<double> along_, across_, samples_, middles_;
    std::vector<Pair> pairs_, halves_;
    std::vector<Bracket> brackets_;
    std::vector<int> borders_;
    std::size_t tried_ = 0;  ///< borders of each bracket
    std::vector<std::uint8_t> inside_;
};

/// A slice asked point by point.
class WalkedSlice : public WalkedSolid {
  public:
    explicit WalkedSlice(const SliceField& slice) : slice_(slice) {}
    Interval enter(const Rect& tile) override { return slice_.range(tile); }
    void leave() override {}
    void values(const WalkPoints& points, std::span<double> out) override {
        std::size_t k = 0;
        for (std::size_t l = 0; l < (points.lattice ? points.across.size() : 1); ++l) {
            for (std::size_t i = 0; i < points.along.size(); ++i) {
                const double across = points.across[points.lattice ? l : i];
                out[k++] = value(points.at(points.along[i], across));
            }
        }
    }

  private:
    double value(dvec2 p) const {
        float v = 0;
        slice_.sample({p, dvec2(1), 1, 1}, {&v, 1});
        return v;
    }

    const SliceField& slice_;
};

}  // namespace

void sampled_spans(WalkedSolid& solid, Metric metric, const RowBand& band, SpanRows& out) {
    out.clear();
    TileWalk(solid, metric, band).walk(out);
}

void sampled_spans(const SliceField& slice, Metric metric, const RowBand& band, SpanRows& out) {
    WalkedSlice solid(slice);
    sampled_spans(solid, metric, band, out);
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
