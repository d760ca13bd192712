// Field, a 3D implicit solid, and SliceField, the same solid in one plane. Every shape implements both.
#pragma once

#include <memory>
#include <span>

#include "engine/base/geometry.h"
#include "engine/runs/runs.h"

namespace lamella {

class Scratch;
class SliceContext;
class Field;
using FieldPtr = std::shared_ptr<const Field>;

/// Relation of a field's value to the distance from its surface.
enum class Metric : std::uint8_t {
    exact,  ///< the signed Euclidean distance, mm
    bound,  ///< the value changes by at most 1 per mm, so its magnitude never exceeds the distance
    sign    ///< only the sign is meaningful
};

/// A regular grid of sample points in a layer's plane: point (i, j) lies at origin + (i * step.x, j *
/// step.y).
struct Tile {
    dvec2 origin{0};
    dvec2 step{1};
    int nx = 0;
    int ny = 0;
};

/// A solid in one plane. Immutable once made; any thread may query it.
class SliceField {
  public:
    virtual ~SliceField() = default;
    /// Replaces `out` by the solid runs of every line of the band, clipped to the band.
    virtual void runs(const RowBand& band, Scratch& scratch, RunRows& out) const = 0;
    /// Returns an interval that encloses every value over the rectangle.
    virtual Interval range(const Rect& r) const = 0;
    /// Samples the field at every point of the tile, row by row: out[j * nx + i].
    virtual void sample(const Tile& tile, std::span<float> out) const = 0;
    /// Returns a rectangle that encloses the solid part of the plane, mm; empty when there is none.
    virtual Rect bounds() const = 0;
};

/// A 3D implicit solid: negative inside, positive outside. Immutable and thread-safe.
///
///     const FieldPtr ball = make_sphere({0, 0, 0}, 5);  // solids/primitives.h
///     const double outside = ball->value({6, 0, 0});    // 1 mm
///     const FieldPtr larger = ball->offset(0.5);        // a ball of radius 5.5 mm
///     SliceContext context;                             // slice_context.h
///     const SliceField& slice = context.slice(*ball, 0.025);
///     Scratch scratch;
///     RunRows rows;  // 200 lines of 200 pixels of 0.05 mm
///     const RowBand band{.along_pitch = 0.05, .across_pitch = 0.05, .first = -100, .count = 200,
///                        .lo = -100, .hi = 100};
///     slice.runs(band, scratch, rows);
class Field : public std::enable_shared_from_this<Field> {
  public:
    virtual ~Field() = default;
    /// Returns the value at a point, mm. NaN counts as outside.
    virtual double value(dvec3 p) const = 0;
    /// Returns the value where its magnitude is below `limit` (> 0); elsewhere any number with the same sign
    /// and a magnitude of at least `limit`. Fields override this when a far surface can be ruled out early.
    virtual double value_within(dvec3 p, double /*limit*/) const { return value(p); }
    /// Returns true only if no point of the surface is nearer to p than `distance` (> 0). Conservative: may
    /// return false when this is unknown. Fields override this when any near point is found sooner than the
    /// nearest.
    virtual bool clear_of_surface(dvec3 p, double distance) const;
    /// Returns an interval that encloses every value over the box. The default derives it from the value at
    /// the centre and the metric.
    virtual Interval range(const Box& box) const;
    virtual Metric metric() const { return Metric::bound; }
    /// Returns a bound of how far the values in a box lie from those of some function that changes by at most
    /// 1 per mm. Infinity by default where only the sign is meaningful, else 0. Fields override this when
    /// their values are a distance less a number that hardly varies over a small box.
    virtual double deviation(const Box& box) const;
    /// Compute the results of `value` at many points, and of `range` over many boxes.
    virtual void values(std::span<const dvec3> points, std::span<double> out) const;
    virtual void ranges(std::span<const Box> boxes, std::span<Interval> out) const;
    /// Returns true if `values` is much faster than one call per point. The default slice samples tiles by it
    /// then; its runs always ask for many at once.
    virtual bool takes_many() const { return false; }
    /// Returns the solid dilated (d > 0) or eroded (d < 0) by |d| mm in true 3D distance; null when there is
    /// no closed form.
    virtual FieldPtr offset(double d) const;
    /// Returns the solid in the plane at height z, owned by the context. The default samples `value`. Call
    /// SliceContext::slice instead, which computes each pair (field, z) only once.
    virtual const SliceField& slice(SliceContext& context, double z) const;
    /// Returns a box that encloses the solid, mm; sides may be infinite.
    virtual Box bounds() const = 0;
};

}  // namespace lamella
