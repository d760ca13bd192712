// Survey rows: rows of whole layers, and the stack of layers that a survey keeps.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/field/slice_context.h"
#include "engine/layers/layer_stream.h"
#include "engine/runs/run_boxes.h"

namespace lamella {

/// Returns the row pitches that suit a survey of a job, mm: at most 2^20 rows and columns, and 16 layers in a
/// pitch. Throws InputError when the job's bounds are empty or infinite.
Interval survey_pitch_range(const Job& job);

/// Returns rows along x over a rectangle, `pitch` mm apart. Row 0 begins at the rectangle's lower side, run
/// coordinate 0 at its left side.
RowBand rows_over(const Rect& rect, double pitch);

/// Returns all rows of a band. Evaluates the slice in smaller bands whose working set fits the cache.
RunRows all_rows(const SliceField& slice, const RowBand& whole, Scratch& scratch);

/// Throws InputError, naming the survey, when a row pitch of `pitch` mm does not suit the job
/// (survey_pitch_range), or exceeds `step`, the distance by which an outline may move from one group of
/// layers to the next, mm.
void check_survey_pitch(const char* survey, const Job& job, double pitch, double step);

/// The rows that a survey computes of one layer.
struct RowsProduct : LayerProduct {
    RunRows rows;
};

/// Combines every `count` successive layers into one, from the lowest on; the last group may be smaller.
class LayerGroups {
  public:
    using Combine = RunRows (&)(const RunRows&, const RunRows&);
    /// `combine`: united for their union, common for their intersection.
    LayerGroups(int count, Combine combine) : count_(count), combine_(combine) {}

    /// Adds the next layer. Returns true once the group is complete; take it then.
    bool add(RunRows rows) {
        group_ = size_ == 0 ? std::move(rows) : combine_(group_, rows);
        return ++size_ == count_;
    }
    /// Whether the group begun holds no layer yet.
    bool empty() const { return size_ == 0; }
    /// Returns the group and begins another one.
    RunRows take() {
        size_ = 0;
        return std::move(group_);
    }

  private:
    int count_, size_ = 0;
    Combine combine_;
    RunRows group_;
};

/// The rows of a stack of layers, lowest first. Memory: 8 bytes a run and 4 a row, and another 48 a run while
/// boxes are made of them. All of it counts towards the limit from the beginning.
class LayerStack {
  public:
    /// push() and replace() throw InputError when the stack would need more than `max_bytes`; `pitch` (mm) is
    /// for the message.
    LayerStack(std::size_t max_bytes, double pitch) : max_bytes_(max_bytes), pitch_(pitch) {}

    std::size_t size() const { return layers_.size(); }
    const RunRows& operator[](std::size_t i) const { return layers_[i]; }
    void push(const RunRows& rows);
    void replace(std::size_t i, const RunRows& rows);
    /// Returns the sum of the lengths of all runs, run units.
    std::int64_t total_length() const;
    /// Converts the runs to boxes: layer i becomes layer i of the grid, line l its row l.
    RunBoxes boxes(const SurveyGrid& grid) const;

  private:
    static std::size_t bytes(const RunRows& rows);

    std::size_t max_bytes_, bytes_ = 0;
    double pitch_;
    std::vector<RunRows> layers_;
};

}  // namespace lamella
