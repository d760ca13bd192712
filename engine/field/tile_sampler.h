// Runs of tiles of a band, read off samples of a solid that has no closed form.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/field/crossing_bracket.h"
#include "engine/field/field.h"

namespace lamella {

/// Points at which values are asked for, on lines of a band. A lattice has a point for every pair of
/// positions; otherwise along[i] and across[i] belong together.
struct WalkPoints {
    Axis axis = Axis::x;
    std::span<const double> along;   ///< mm
    std::span<const double> across;  ///< mm
    bool lattice = true;

    std::size_t count() const { return lattice ? along.size() * across.size() : along.size(); }
    /// The point of the plane at these positions.
    dvec2 at(double a, double c) const { return axis == Axis::x ? dvec2(a, c) : dvec2(c, a); }
    /// Calls visit(point of the plane) for every point, a lattice's line by line.
    template <typename Visit>
    void each(const Visit& visit) const {
        if (lattice) {
            for (const double c : across) {
                for (const double a : along) visit(at(a, c));
            }
        } else {
            for (std::size_t i = 0; i < along.size(); ++i) visit(at(along[i], across[i]));
        }
    }
};

/// What a solid in a plane tells when it is sampled.
class SampledSolid {
  public:
    virtual ~SampledSolid() = default;
    /// The values at the points; a lattice's line by line: out[line * along.size() + i].
    virtual void values(const WalkPoints& points, std::span<double> out) = 0;
    /// Only the signs of values are the same whatever the tile.
    virtual bool signs_only() const { return false; }
};

/// Pixels [lo, lo + width) of lines [first, first + height) of a band, as far as the band has them.
struct BandTile {
    int lo, width, first, height;
    bool full = false;  ///< known to be solid all over
};

/// Samples tiles of a band, narrows the crossings of their lines, and collects the runs of each line. Tiles
/// of one line have to come from left to right.
class TileSampler {
  public:
    TileSampler(SampledSolid& solid, Metric metric, const RowBand& band);

    /// The part of the plane that holds the tile's samples.
    Rect rect(const BandTile& tile) const;
    void fill(const BandTile& tile);
    /// Samples several tiles in step: each round of narrowing asks for the points of all of them at once.
    void sample(std::span<const BandTile> tiles);
    /// Samples the ends of a tile's lines, each of which has one crossing at most.
    void sample_ends(const BandTile& tile);
    /// The least length that is told apart along a line, mm.
    double cell() const { return cell_; }
    /// The lines' runs.
    void append_to(RunRows& out) const;

  private:
    /// A tile's part of a line.
    struct Stretch {
        int line;
        std::int32_t begin, end;
        bool begins_inside;
    };
    /// Two neighbouring samples of a stretch, at run coordinates u0 < u1.
    struct Pair {
        double u0, u1;
        double v0, v1;
        std::size_t stretch;

        bool crosses() const { return (v0 < 0) != (v1 < 0); }
    };

    double position(int line) const { return positions_[static_cast<std::size_t>(line)]; }
    double position(const Pair& pair) const { return position(stretches_[pair.stretch].line); }
    std::int32_t begin(const BandTile& tile) const { return tile.lo * run_unit; }
    std::int32_t end(const BandTile& tile) const {
        return std::min(tile.lo + tile.width, band_.hi) * run_unit;
    }
    int end_line(const BandTile& tile) const { return std::min(tile.first + tile.height, band_.lines()); }
    void add(int line, std::int32_t begin, std::int32_t end);
    void ask_samples(std::span<const BandTile> tiles, int step);
    void read_samples(std::span<const BandTile> tiles, int step);
    template <class Turn>
    void turns_of(std::span<const double> values, const Turn& turn);
    void consider(const Pair& pair, std::vector<Pair>& out) const;
    void sample_middles();
    void split();
    void find_crossings(bool one_way);
    bool ask_borders(Search search);
    void turn();

    SampledSolid& solid_;
    Metric metric_;
    const RowBand& band_;
    double cell_;  ///< mm
    std::vector<std::vector<Run>> lines_;
    std::vector<double> positions_;  ///< of the lines, mm across
    std::vector<double> along_, across_, samples_, middles_;
    std::vector<Stretch> stretches_;
    std::vector<Pair> pairs_, halves_;
    std::vector<Bracket> brackets_;
    std::vector<int> borders_;
    std::size_t tried_ = 0;  ///< borders of each bracket
    std::vector<std::uint8_t> inside_;
};

}  // namespace lamella
