// Layer: the unit that is streamed. Job: the solid that the layers belong to.
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
#include "engine/layers/layer_plan.h"
#include "engine/runs/line_cache.h"

namespace lamella {

/// One of several parts of a job.
struct JobObject {
    std::string name;  ///< of its own on the plate
    FieldPtr part;
    FieldPtr supports;  ///< null for none
    Rect covers{};      ///< what both cover of the bed, in the job's coordinates, mm
};

/// What one tool (extruder) makes of a job's part or supports.
struct ToolZone {
    int tool = 0;   ///< from 0
    FieldPtr zone;  ///< bounded; null: everywhere
};

/// A print job: a solid and how it is cut into layers, each at its mid-height.
struct Job {
    std::string name = "part";  ///< short name for file names and headers
    FieldPtr part;              ///< the solid, in its own coordinates, mm
    FieldPtr supports;          ///< supports, removed after the print; null for none
    Box bounds;                 ///< finite bounds of part and supports, mm; the bed lies at its lower side
    LayerPlan layers;
    /// Draws the part with its supports, seen from the front, in a square of `size` pixels, for files that
    /// carry a preview. May be empty.
    std::function<Picture(int size)> picture{};
    std::vector<JobObject> objects{};  ///< the parts that the job consists of; empty for a single one
    /// The tools of part and supports: later zones win, and the first is everywhere. Empty: the first tool.
    std::vector<ToolZone> part_tools{}, support_tools{};
    FieldPtr purge_tower{};            ///< a box beside the part, in which tools are purged; null for none
    std::vector<std::string> notes{};  ///< lines of text for people, for files that carry comments
    std::string identity;  ///< hash of recipe and inputs; jobs of equal identity produce the same bytes

    double z0() const { return bounds.lo.z; }
    /// Whether the parts are printed one by one: each of `objects` has a stack of layers of its own.
    bool one_by_one() const { return layers.stacks() > 1; }
    /// Height of the cutting plane of layer i, in part coordinates, mm.
    double plane(int i) const { return z0() + layers.middle(i); }
};

/// Returns a job in layers of one height, its least, for surveys whose rows have to lie at equal distances
/// along z; the job itself where its layers are equal.
Job in_equal_layers(const Job& job);

/// A layer in flight. Its contents depend on the job and the index alone. Used by one thread at a time.
class Layer {
  public:
    /// `job` must outlive the layer. Long work on the layer throws Interrupted once `cancel` (may be null) is
    /// set.
    Layer(const Job& job, int index, const CancelToken* cancel = nullptr);

    int index() const { return index_; }
    /// Returns the number of layers below this one that belong to the same stack (LayerPlan).
    int level() const { return index_ - job_->layers.first_of_stack(job_->layers.stack_of(index_)); }
    double z() const { return z_; }                  ///< cutting plane in part coordinates, mm
    double thickness() const { return thickness_; }  ///< mm
    const CancelToken* cancel() const { return cancel_; }
    /// Returns the height of the layer's top above the build plate, mm.
    double top() const { return job_->layers.top(index_); }
    /// Returns the height of its underside above the build plate, mm.
    double bottom() const { return job_->layers.bottom(index_); }
    /// Returns the part's slice. Cut at the first call.
    const SliceField& part() const { return part_at(middle); }
    /// Returns the supports' slice; null if the job has no supports. Cut at the first call.
    const SliceField* supports() const { return supports_at(middle); }
    /// Returns a slice at another height within the layer: `share` 0 is its lower side, 1 its upper one.
    const SliceField& part_at(double share) const;
    const SliceField* supports_at(double share) const;

    /// Asks for the lines of `wanted` to be cached, of part and supports, when a back-end goes through all
    /// lines of the band anyway. Another back-end can then reuse them.
    void cache_lines(const RowBand& wanted) const;
    /// Returns the caches that a back-end going through `slice` should fill; empty if no lines are wanted.
    std::span<LineCache> lines_to_cache(const SliceField& slice) const;
    /// Returns the cached lines of a slice; null if they were not cached.
    const RunRows* kept_lines(const SliceField& slice, const RowBand& wanted) const;

    void runs(const RowBand& band, RunRows& out) const { part().runs(band, scratch_, out); }
    std::vector<Contour> contours(double tolerance) const {
        return trace_contours(part(), tolerance, scratch_);
    }
    /// Returns no contours if there are no supports.
    std::vector<Contour> support_contours(double tolerance) const {
        return supports() ? trace_contours(*supports(), tolerance, scratch_) : std::vector<Contour>();
    }

  private:
    static constexpr double middle = 0.5;
    double height_of(double share) const { return z_ + (share - middle) * thickness_; }

    const Job* job_;
    const Field* solid_;           // of the part
    const Field* supports_solid_;  // null for none
    int index_;
    const CancelToken* cancel_;
    double z_;
    double thickness_;
    mutable SliceContext context_;
    mutable std::vector<LineCache> part_lines_, support_lines_;
    mutable Scratch scratch_;
};

}  // namespace lamella
