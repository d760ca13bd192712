// Compares neighbouring samples, halves pairs that may enclose a surface, narrows crossings to cells.
#include "engine/field/tile_sampler.h"

#include <cstring>

namespace lamella {
namespace {

constexpr int quarter = run_unit / 4;
constexpr int coarsest = 8 * run_unit;  // between samples at first
constexpr int cells_per_unit = 16;      // resolution of a crossing: 1/16 of a run unit
constexpr int guesses = 3;              // rounds of interpolation before bisection
constexpr int guesses_of_one = 6;       // the same when a line has one crossing at most

}  // namespace

TileSampler::TileSampler(SampledSolid& solid, Metric metric, const RowBand& band)
    : solid_(solid),
      metric_(metric),
      band_(band),
      cell_(std::abs(band.along_pitch) / (run_unit * cells_per_unit)),
      lines_(static_cast<std::size_t>(band.lines())) {
    for (int l = 0; l < band.lines(); ++l) positions_.push_back(band.line(l));
}

Rect TileSampler::rect(const BandTile& tile) const {
    const auto point = [&](std::int32_t u, int line) {
        const double along = band_.along(u), across = position(line);
        return band_.axis == Axis::x ? dvec2(along, across) : dvec2(across, along);
    };
    const dvec2 a = point(begin(tile), tile.first), b = point(end(tile), end_line(tile) - 1);
    return {glm::min(a, b), glm::max(a, b)};
}

void TileSampler::fill(const BandTile& tile) {
    for (int l = tile.first; l < end_line(tile); ++l) add(l, begin(tile), end(tile));
}

void TileSampler::append_to(RunRows& out) const {
    for (const auto& line : lines_) out.append_line(line);
}

void TileSampler::add(int line, std::int32_t begin, std::int32_t end) {
    auto& runs = lines_[static_cast<std::size_t>(line)];
    if (begin >= end) return;
    if (!runs.empty() && runs.back().end >= begin) {
        runs.back().end = end;
    } else {
        runs.push_back({begin, end});
    }
}

void TileSampler::sample_ends(const BandTile& tile) {
    along_.clear();
    across_.clear();
    for (int l = tile.first; l < end_line(tile); ++l) {
        along_.insert(along_.end(), {band_.along(begin(tile)), band_.along(end(tile))});
        across_.insert(across_.end(), 2, position(l));
    }
    samples_.resize(along_.size());
    solid_.values({band_.axis, along_, across_, false}, samples_);
    pairs_.clear();
    stretches_.clear();
    const double* v = samples_.data();
    for (int l = tile.first; l < end_line(tile); ++l, v += 2) {
        const Pair pair{static_cast<double>(begin(tile)), static_cast<double>(end(tile)), v[0], v[1],
                        stretches_.size()};
        stretches_.push_back({l, begin(tile), end(tile), v[0] < 0});
        if (pair.crosses()) pairs_.push_back(pair);
    }
    find_crossings(true);
    turn();
}

void TileSampler::sample(std::span<const BandTile> tiles) {
    // Where values prove nothing between samples, all quarter pitches are sampled at once.
    const bool by_signs = metric_ == Metric::sign && std::ranges::any_of(tiles, [](const BandTile& tile) {
                              return !tile.full && tile.deviation == infinity;
                          });
    int step = by_signs ? quarter : coarsest;
    while (std::ranges::any_of(tiles,
                               [&](const BandTile& tile) { return (end(tile) - begin(tile)) % step != 0; }))
        step /= 2;
    ask_samples(tiles, step);
    read_samples(tiles, step);
    for (int gap = step; gap > quarter; gap /= 2) split();
    find_crossings(false);
    turn();
}

/// Computes the values at the samples of all tiles. A single tile is sampled as a lattice, which is cheaper
/// for a formula.
void TileSampler::ask_samples(std::span<const BandTile> tiles, int step) {
    along_.clear();
    across_.clear();
    const bool lattice = tiles.size() == 1 && !tiles.front().full;
    if (lattice) {
        const BandTile& tile = tiles.front();
        for (int u = begin(tile); u <= end(tile); u += step) along_.push_back(band_.along(u));
        for (int l = tile.first; l < end_line(tile); ++l) across_.push_back(position(l));
    } else {
        for (const BandTile& tile : tiles) {
            for (int l = tile.first; l < end_line(tile) && !tile.full; ++l) {
                for (int u = begin(tile); u <= end(tile); u += step) along_.push_back(band_.along(u));
                across_.resize(along_.size(), position(l));
            }
        }
    }
    const WalkPoints points{band_.axis, along_, across_, lattice};
    samples_.resize(points.count());
    if (!samples_.empty()) solid_.values(points, samples_);
}

/// Lists the stretches of all tiles, and the pairs of samples that may have a surface between them.
void TileSampler::read_samples(std::span<const BandTile> tiles, int step) {
    stretches_.clear();
    pairs_.clear();
    const double* v = samples_.data();
    for (const BandTile& tile : tiles) {
        const std::int32_t from = begin(tile), to = end(tile);
        const std::size_t count = static_cast<std::size_t>((to - from) / step) + 1;
        for (int l = tile.first; l < end_line(tile); ++l) {
            const std::size_t stretch = stretches_.size();
            stretches_.push_back(
                {l, from, to, tile.full || v[0] < 0, metric_ == Metric::sign ? tile.deviation : 0});
            if (tile.full) continue;
            const auto pair = [&](std::size_t i) {
                const double u = from + static_cast<int>(i) * step;
                return Pair{u, u + step, v[i], v[i + 1], stretch};
            };
            if (step == quarter) {
                turns_of({v, count}, [&](std::size_t i) { pairs_.push_back(pair(i)); });
            } else {
                for (std::size_t i = 0; i + 1 < count; ++i) consider(pair(i), pairs_);
            }
            v += count;
        }
    }
}

/// Calls `turn(i)` for every i where value i and value i + 1 lie on different sides of the surface.
template <class Turn>
void TileSampler::turns_of(std::span<const double> values, const Turn& turn) {
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

/// Keeps a pair if a surface may lie between its samples.
void TileSampler::consider(const Pair& pair, std::vector<Pair>& out) const {
    const double width = pair.u1 - pair.u0;
    if (!pair.crosses()) {
        const double gap = width * std::abs(band_.along_pitch) / run_unit;
        const double deviation = stretches_[pair.stretch].deviation;
        const bool proven = std::abs(pair.v0) + std::abs(pair.v1) >= gap + 2 * deviation;
        if (proven || width <= quarter) return;
    }
    out.push_back(pair);
}

/// Computes the values halfway between the samples of all pairs.
void TileSampler::sample_middles() {
    along_.clear();
    across_.clear();
    for (const Pair& pair : pairs_) {
        along_.push_back(band_.along((pair.u0 + pair.u1) * 0.5));
        across_.push_back(position(pair));
    }
    middles_.resize(pairs_.size());
    if (!pairs_.empty()) solid_.values({band_.axis, along_, across_, false}, middles_);
}

/// Halves all pairs and keeps the halves that may hold a surface.
void TileSampler::split() {
    sample_middles();
    halves_.clear();
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        const Pair& pair = pairs_[i];
        const double middle = (pair.u0 + pair.u1) * 0.5;
        consider({pair.u0, middle, pair.v0, middles_[i], pair.stretch}, halves_);
        consider({middle, pair.u1, middles_[i], pair.v1, pair.stretch}, halves_);
    }
    pairs_.swap(halves_);
}

/// Narrows each pair, all of which have a crossing, to the cell that holds it. `one_way`: every line has at
/// most one crossing.
void TileSampler::find_crossings(bool one_way) {
    brackets_.clear();
    for (const Pair& pair : pairs_) {
        const int cells = static_cast<int>(pair.u1 - pair.u0) * cells_per_unit;
        brackets_.push_back({0, cells, pair.v0, pair.v1});
    }
    const Search last = solid_.signs_only() && !one_way ? Search::signs : Search::halves;
    const int chords = one_way ? guesses_of_one : last == Search::signs ? 0 : guesses;
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

/// Lists cell borders to sample for every pair whose cell is not found yet; returns false if there are none.
bool TileSampler::ask_borders(Search search) {
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
            across_.push_back(position(pairs_[i]));
        }
    }
    middles_.resize(borders_.size());
    return !borders_.empty();
}

/// Converts the crossings of all stretches into runs.
void TileSampler::turn() {
    std::size_t k = 0;
    for (std::size_t s = 0; s < stretches_.size(); ++s) {
        const Stretch& stretch = stretches_[s];
        bool inside = stretch.begins_inside;
        std::int32_t from = stretch.begin;
        for (; k < pairs_.size() && pairs_[k].stretch == s; ++k) {
            const std::int32_t u = round_run((pairs_[k].u0 + pairs_[k].u1) * 0.5);
            if (inside) add(stretch.line, from, u);
            from = u;
            inside = !inside;
        }
        if (inside) add(stretch.line, from, stretch.end);
    }
}

}  // namespace lamella
