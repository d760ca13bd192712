// Field, a 3D implicit solid, and SliceField, the same solid in one plane: the seam that every shape
// implements.
#pragma once

#include <memory>
#include <span>

#include "engine/base/geometry.h"
#include "engine/runs/runs.h"

namespace lamella {

class Scratch;
class SliceContext;
class Field;
class Grading;
using FieldPtr = std::shared_ptr<const Field>;

/// What a field's value says about the distance to its surface.
enum class Metric : std::uint8_t {
    exact,  ///< the signed Euclidean distance, mm
    bound,  ///< the value changes by at most 1 per mm, so its magnitude never exceeds the distance
    sign    ///< only the sign holds
};

/// A regular lattice of sample points in a layer's plane: point (i, j) lies at origin + (i * step.x, j *
/// step.y).
struct Tile {
    dvec2 origin{0};
    dvec2 step{1};
    int nx = 0;
    int ny = 0;
};

/// A solid in one plane. Immutable once made; any thread may ask it.
class SliceField {
  public:
    virtual ~SliceField() = default;
    /// The solid runs of every line of the band, clipped to it, appended to a cleared `out`.
    virtual void runs(const RowBand& band, Scratch& scratch, RunRows& out) const = 0;
    /// Encloses every value over the rectangle.
    virtual Interval range(const Rect& r) const = 0;
    /// The field's value at every point of the tile, row by row: out[j * nx + i].
    virtual void sample(const Tile& tile, std::span<float> out) const = 0;
    /// Encloses the solid part of the plane, mm; empty when there is none.
    virtual Rect bounds() const = 0;
};

/// A 3D implicit solid: negative inside, positive outside. Immutable and thread-safe.
class Field : public std::enable_shared_from_this<Field> {
  public:
    virtual ~Field() = default;
    /// The field at one point, mm. NaN counts as outside.
    virtual double value(dvec3 p) const = 0;
    /// The value where its magnitude is below `limit` (> 0); elsewhere any number of the same sign and at
    /// least that magnitude. For fields that find out sooner that a surface is far than how far.
    virtual double value_within(dvec3 p, double /*limit*/) const { return value(p); }
    /// Whether no point of the surface is nearer to p than `distance` (> 0); false where that is not known.
    /// For fields that find something near sooner than the nearest.
    virtual bool clear_of_surface(dvec3 p, double distance) const;
    /// Encloses every value over the box. The default derives it from the centre's value and the metric.
    virtual Interval range(const Box& box) const;
    virtual Metric metric() const { return Metric::bound; }
    /// The values at many points, those of `value`, and the ranges over many boxes, those of `range`.
    virtual void values(std::span<const dvec3> points, std::span<double> out) const;
    virtual void ranges(std::span<const Box> boxes, std::span<Interval> out) const;
    /// Whether `values` and `ranges` take much less time than as many calls one by one. The default slice
    /// uses them then.
    virtual bool takes_many() const { return false; }
    /// The solid grown (d > 0) or shrunk (d < 0) by d mm in true 3D distance; null where there is no closed
    /// form.
    virtual FieldPtr offset(double d) const;
    /// A field that, inside this solid, is solid exactly within `thickness` mm of the surface (outside it may
    /// be anything); null where there is no closed form. The default takes the solid less its inward offset.
    virtual FieldPtr shell(double thickness) const;
    /// The same with a thickness that varies (mm, >= 0, its range finite); null where there is no closed
    /// form, as by default.
    virtual FieldPtr graded_shell(const Grading& thickness) const;
    /// The other side of it: a field that, outside this solid, is solid exactly within a thickness that
    /// varies over the surface (inside it may be anything).
    virtual FieldPtr graded_outer_shell(const Grading& thickness) const;
    /// The solid in the plane at height z, owned by the context. The default samples `value`.
    /// Callers use SliceContext::slice, which works each pair (field, z) out once.
    virtual const SliceField& slice(SliceContext& context, double z) const;
    /// Encloses the solid, mm; sides may be infinite.
    virtual Box bounds() const = 0;
};

}  // namespace lamella
