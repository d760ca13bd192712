// TileSampler: runs of the tiles of a band, from samples of a solid without a closed form.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/field/crossing_bracket.h"
#include "engine/field/field.h"

namespace lamella {

/// Sample points on lines of a band. A lattice has a point for every pair of positions; otherwise along[i]
/// and across[i] form a point.
struct WalkPoints {
    Axis axis = Axis::x;
    std::span<const double> along;   ///< mm
    std::span<const double> across;  ///< mm
    bool lattice = true;

    std::size_t count() const { return lattice ? along.size() * across.size() : along.size(); }
    /// Returns the point of the plane at these positions.
    dvec2 at(double a, double c) const { return axis == Axis::x ? dvec2(a, c) : dvec2(c, a); }
    /// Calls visit(point of the plane) for every point, a lattice line by line.
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

/// A solid in a plane that can be sampled.
class SampledSolid {
  public:
    virtual ~SampledSolid() = default;
    /// Computes the values at the points, a lattice line by line: out[line * along.size() + i].
    virtual void values(const WalkPoints& points, std::span<double> out) = 0;
    /// Returns true if values depend on the tile and only their signs do not.
    virtual bool signs_only() const { return false; }
};

/// Pixels [lo, lo + width) of lines [first, first + height) of a band, as far as the band has them.
struct BandTile {
    int lo, width, first, height;
    bool full = false;            ///< known to be solid everywhere
    double deviation = infinity;  ///< see Field::deviation; that of a solid with the metric sign
};

/// Samples the tiles of a band, narrows down the crossings on their lines, and collects the runs of each
/// line. Tiles of one line have to come from left to right.
class TileSampler {
  public:
    TileSampler(SampledSolid& solid, Metric metric, const RowBand& band);

    /// Returns the rectangle of the plane that holds the tile's samples, mm.
    Rect rect(const BandTile& tile) const;
    void fill(const BandTile& tile);
    /// Samples several tiles in lockstep: each round of narrowing evaluates points of all of them in one
    /// batch.
    void sample(std::span<const BandTile> tiles);
    /// Samples both ends of a tile's lines, each of which has at most one crossing.
    void sample_ends(const BandTile& tile);
    /// Returns the resolution along a line, mm: 1/16 of a run unit.
    double cell() const { return cell_; }
    /// Appends the runs of all lines.
    void append_to(RunRows& out) const;

  private:
    /// The part of a line in a tile.
    struct Stretch {
        int line;
        std::int32_t begin, end;
        bool begins_inside;
        double deviation = 0;
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
    std::vector<double> positions_;  ///< position of each line, mm across
    std::vector<double> along_, across_, samples_, middles_;
    std::vector<Stretch> stretches_;
    std::vector<Pair> pairs_, halves_;
    std::vector<Bracket> brackets_;
    std::vector<int> borders_;
    std::size_t tried_ = 0;  ///< borders sampled per bracket
    std::vector<std::uint8_t> inside_;
};

}  // namespace lamella
