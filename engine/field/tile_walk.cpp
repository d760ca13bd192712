// Halves the tiles of a band until their range decides or they are small; samples the small ones.
#include "engine/field/tile_walk.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "engine/field/slice_context.h"

namespace lamella {
namespace {

constexpr int leaf_lines = 16;
constexpr int leaf_pixels = 8;
constexpr int one_way_pixels = 16;  // larger tiles are not asked for their slope
// As many as keep their samples in a processor's second-level cache, at 528 samples a tile when all quarter
// pitches are sampled at once.
constexpr std::size_t tiles_at_once = 128;          // with two samples a line to begin with
constexpr std::size_t tiles_at_once_by_signs = 32;  // with a sample every quarter pitch

/// Returns the tile that covers the whole band; empty when the band has no pixels or lines.
BandTile whole(const RowBand& band) {
    if (band.lo >= band.hi || band.lines() <= 0) return {band.lo, 0, 0, 0};
    BandTile tile{band.lo, leaf_pixels, 0, leaf_lines};
    while (tile.width < band.hi - band.lo) tile.width *= 2;
    while (tile.height < band.lines()) tile.height *= 2;
    return tile;
}

bool meets(const BandTile& tile, const RowBand& band) {
    return tile.lo < band.hi && tile.first < band.lines();
}

bool is_leaf(const BandTile& tile) { return tile.width == leaf_pixels && tile.height == leaf_lines; }

/// Calls visit(part) for the parts into which a tile is divided, from left to right along each line.
template <typename Visit>
void divide(const BandTile& tile, const Visit& visit) {
    const int across = tile.width / leaf_pixels, down = tile.height / leaf_lines;
    // Long tiles are halved until they have the shape of a leaf: ranges are tightest over squares.
    const bool wide = across >= down, high = down >= across;
    const int width = wide ? tile.width / 2 : tile.width, height = high ? tile.height / 2 : tile.height;
    for (int first = tile.first; first < tile.first + tile.height; first += height) {
        for (int lo = tile.lo; lo < tile.lo + tile.width; lo += width) visit({lo, width, first, height});
    }
}

/// Depth-first walk over the tiles of a band, from left to right along each line.
class NarrowingWalk {
  public:
    NarrowingWalk(TileSampledSolid& solid, Metric metric, const RowBand& band)
        : solid_(solid), metric_(metric), band_(band), sampler_(solid, metric, band) {}

    void walk(RunRows& out) {
        visit(whole(band_));
        sampler_.append_to(out);
    }

  private:
    void visit(const BandTile& tile) {
        if (tile.height == 0 || !meets(tile, band_)) return;
        const Interval values = solid_.enter(sampler_.rect(tile));
        if (values.hi < 0) {
            sampler_.fill(tile);
        } else if (!(values.lo > 0)) {
            descend(tile);
        }
        solid_.leave();
    }

    void descend(const BandTile& tile) {
        if (metric_ == Metric::sign && std::max(tile.width, tile.height) <= one_way_pixels) {
            // Half a cell, because positions are rounded.
            if (solid_.slope(band_.axis).one_way(0.5 * sampler_.cell())) return sampler_.sample_ends(tile);
        }
        if (is_leaf(tile)) return sampler_.sample({&tile, 1});
        divide(tile, [&](const BandTile& part) { visit(part); });
    }

    TileSampledSolid& solid_;
    Metric metric_;
    const RowBand& band_;
    TileSampler sampler_;
};

/// Breadth-first walk over the tiles of a band.
class EvenWalk {
  public:
    EvenWalk(BatchSampledSolid& solid, Metric metric, const RowBand& band)
        : solid_(solid),
          band_(band),
          at_once_(metric == Metric::sign ? tiles_at_once_by_signs : tiles_at_once),
          sampler_(solid, metric, band) {}

    void walk(RunRows& out) {
        if (const BandTile tile = whole(band_); tile.height > 0) level_.push_back(tile);
        while (!level_.empty()) descend();
        std::sort(found_.begin(), found_.end(), [](const BandTile& a, const BandTile& b) {
            return std::tie(a.lo, a.first) < std::tie(b.lo, b.first);
        });
        for (std::size_t i = 0; i < found_.size(); i += at_once_) {
            sampler_.sample(std::span(found_).subspan(i, std::min(at_once_, found_.size() - i)));
        }
        sampler_.append_to(out);
    }

  private:
    /// Bounds the tiles of one level and divides them into those of the next.
    void descend() {
        rects_.clear();
        for (const BandTile& tile : level_) rects_.push_back(sampler_.rect(tile));
        ranges_.resize(rects_.size());
        solid_.ranges(rects_, ranges_);
        next_.clear();
        for (std::size_t i = 0; i < level_.size(); ++i) {
            BandTile tile = level_[i];
            tile.full = ranges_[i].hi < 0;
            if (!tile.full && ranges_[i].lo > 0) continue;
            if (!tile.full && is_leaf(tile)) tile.deviation = solid_.deviation(rects_[i]);
            if (tile.full || is_leaf(tile)) {
                found_.push_back(tile);
            } else {
                divide(tile, [&](const BandTile& part) {
                    if (meets(part, band_)) next_.push_back(part);
                });
            }
        }
        level_.swap(next_);
    }

    BatchSampledSolid& solid_;
    const RowBand& band_;
    std::size_t at_once_;  ///< tiles that are sampled together
    TileSampler sampler_;
    std::vector<BandTile> level_, next_;
    std::vector<BandTile> found_;  ///< full tiles, and leaves to be sampled
    std::vector<Rect> rects_;
    std::vector<Interval> ranges_;
};

/// Adapter for a slice that is sampled point by point.
class WalkedSlice : public TileSampledSolid {
  public:
    explicit WalkedSlice(const SliceField& slice) : slice_(slice) {}
    Interval enter(const Rect& tile) override { return slice_.range(tile); }
    void leave() override {}
    void values(const WalkPoints& points, std::span<double> out) override {
        std::size_t k = 0;
        points.each([&](dvec2 p) { out[k++] = value(p); });
    }

  private:
    double value(dvec2 p) const {
        float v = 0;
        slice_.sample({p, dvec2(1), 1, 1}, {&v, 1});
        return v;
    }

    const SliceField& slice_;
};

/// Adapter for a field in one plane that is sampled in batches.
class FieldInPlane : public BatchSampledSolid {
  public:
    FieldInPlane(const Field& field, double z) : field_(field), z_(z) {}

    void ranges(std::span<const Rect> tiles, std::span<Interval> out) override {
        boxes_.clear();
        for (const Rect& tile : tiles) boxes_.push_back({{tile.lo, z_}, {tile.hi, z_}});
        field_.ranges(boxes_, out);
    }
    double deviation(const Rect& tile) override { return field_.deviation({{tile.lo, z_}, {tile.hi, z_}}); }
    void values(const WalkPoints& points, std::span<double> out) override {
        points_.clear();
        points.each([&](dvec2 p) { points_.emplace_back(p, z_); });
        field_.values(points_, out);
    }

  private:
    const Field& field_;
    double z_;
    std::vector<dvec3> points_;
    std::vector<Box> boxes_;
};

}  // namespace

void sampled_spans(TileSampledSolid& solid, Metric metric, const RowBand& band, RunRows& out) {
    out.clear();
    NarrowingWalk(solid, metric, band).walk(out);
}

void sampled_spans(BatchSampledSolid& solid, Metric metric, const RowBand& band, RunRows& out) {
    out.clear();
    EvenWalk(solid, metric, band).walk(out);
}

void sampled_spans(const SliceField& slice, Metric metric, const RowBand& band, RunRows& out) {
    WalkedSlice solid(slice);
    sampled_spans(solid, metric, band, out);
}

void SampledSlice::runs(const RowBand& band, Scratch& /*scratch*/, RunRows& out) const {
    FieldInPlane walked(field_, z_);
    sampled_spans(walked, field_.metric(), band, out);
}

Interval SampledSlice::range(const Rect& r) const { return field_.range({{r.lo, z_}, {r.hi, z_}}); }

void SampledSlice::sample(const Tile& tile, std::span<float> out) const {
    const auto point = [&](int i, int j) { return dvec3(tile.origin + dvec2(i, j) * tile.step, z_); };
    if (!field_.takes_many()) {
        std::size_t k = 0;
        for (int j = 0; j < tile.ny; ++j) {
            for (int i = 0; i < tile.nx; ++i) out[k++] = static_cast<float>(field_.value(point(i, j)));
        }
        return;
    }
    std::vector<dvec3> points;
    points.reserve(out.size());
    for (int j = 0; j < tile.ny; ++j) {
        for (int i = 0; i < tile.nx; ++i) points.push_back(point(i, j));
    }
    std::vector<double> values(points.size());
    field_.values(points, values);
    std::ranges::transform(values, out.begin(), [](double v) { return static_cast<float>(v); });
}

Rect SampledSlice::bounds() const {
    const Box box = field_.bounds();
    return box.lo.z <= z_ && z_ <= box.hi.z ? box.rect() : Rect{};
}

}  // namespace lamella
