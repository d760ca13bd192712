// A layer, the unit that is streamed, and the job that the layers belong to.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/cancel_token.h"
#include "engine/base/picture.h"
#include "engine/contours/contours.h"
#include "engine/field/field.h"
#include "engine/field/slice_context.h"
#include "engine/runs/line_cache.h"

namespace lamella {

/// What is printed: a solid and how it is cut into layers. Layer i spans [z0 + i h, z0 + (i + 1) h] and is
/// cut at its mid-height.
struct Job {
    std::string name = "part";   ///< short name for file names and headers
    FieldPtr part;               ///< the solid, in its own coordinates, mm
    FieldPtr supports;           ///< what holds the part up and is taken off later; null for none
    Box bounds;                  ///< finite bounds of part and supports; the bed lies at its lower side, mm
    double layer_height = 0.05;  ///< h, mm
    int layer_count = 0;
    /// The part with its supports, seen from the front in a square of so many pixels, for files that carry
    /// such a picture; may be empty.
    std::function<Picture(int size)> picture{};
    std::vector<std::string> notes{};  ///< lines for people, for files that carry some
    std::string identity;  ///< hash of recipe and inputs: two jobs with equal identity make the same bytes

    double z0() const { return bounds.lo.z; }
    /// Height of the cutting plane of layer i, in part coordinates, mm.
    double plane(int i) const { return z0() + (i + 0.5) * layer_height; }
};

/// Number of layers of height h (mm) that a part of this height (mm) needs.
int count_layers(double part_height, double h);

/// One layer in flight. Pure: it depends on the job and the index alone. Used by one thread at a time.
class Layer {
  public:
    /// Long work on the layer ends with Interrupted when `cancel`, which may be null, asks for it.
    Layer(const Job& job, int index, const CancelToken* cancel = nullptr);

    int index() const { return index_; }
    double z() const { return z_; }                  ///< cutting plane in part coordinates, mm
    double thickness() const { return thickness_; }  ///< mm
    const CancelToken* cancel() const { return cancel_; }
    /// Height of the layer's top over the build plate, mm.
    double top() const { return (index_ + 1) * thickness_; }
    /// Cut when it is first asked for.
    const SliceField& part() const { return part_at(middle); }
    /// Null where the job has no supports.
    const SliceField* supports() const { return supports_at(middle); }
    /// Both cut elsewhere within the layer, at a share of its thickness: 0 its lower side, 1 its upper one.
    const SliceField& part_at(double share) const;
    const SliceField* supports_at(double share) const;

    /// Lets these lines of the part and its supports be kept when a back-end goes through all that their
    /// numbers count, so that another one need not ask for them again.
    void cache_lines(const RowBand& wanted) const;
    /// What keeps lines of a slice, for whoever goes through it; empty where none are wanted.
    std::span<LineCache> lines_to_cache(const SliceField& slice) const;
    /// The lines of a slice that were kept; null where they were not.
    const RunRows* kept_lines(const SliceField& slice, const RowBand& wanted) const;

    void runs(const RowBand& band, RunRows& out) const { part().runs(band, scratch_, out); }
    std::vector<Contour> contours(double tolerance) const {
        return trace_contours(part(), tolerance, scratch_);
    }
    /// Empty where there are no supports.
    std::vector<Contour> support_contours(double tolerance) const {
        return supports() ? trace_contours(*supports(), tolerance, scratch_) : std::vector<Contour>();
    }

  private:
    static constexpr double middle = 0.5;
    double height_of(double share) const { return z_ + (share - middle) * thickness_; }

    const Job* job_;
    int index_;
    const CancelToken* cancel_;
    double z_;
    double thickness_;
    mutable SliceContext context_;
    mutable std::vector<LineCache> part_lines_, support_lines_;
    mutable Scratch scratch_;
};

}  // namespace lamella
