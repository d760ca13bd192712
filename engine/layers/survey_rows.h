// Rows of whole layers for surveys, and the stack of them that a survey keeps as it goes.
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

/// Rows along x over a rectangle, `pitch` mm from one to the next: the first begins at its lower side, run
/// coordinate 0 at its left one.
RowBand rows_over(const Rect& rect, double pitch);

/// All rows of a band, from its first one on; the slice is asked piece by piece, so that what it works with
/// stays in the cache.
RunRows all_rows(const SliceField& slice, const RowBand& whole, Scratch& scratch);

/// Throws InputError, which names the survey, where rows `pitch` mm apart do not suit a job
/// (survey_pitch_range) or lie further apart than an outline moves by from one group of layers to the next,
/// `step` mm.
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

/// The rows of layers, from the lowest on. Memory: eight bytes a run and four a row, and while boxes are made
/// of them another 48 a run; all of it is counted from the beginning.
class LayerStack {
  public:
    /// Throws InputError as soon as more than `max_bytes` would be needed; `pitch`, mm, is for its message.
    LayerStack(std::size_t max_bytes, double pitch) : max_bytes_(max_bytes), pitch_(pitch) {}

    std::size_t size() const { return layers_.size(); }
    const RunRows& operator[](std::size_t i) const { return layers_[i]; }
    void push(const RunRows& rows);
    void replace(std::size_t i, const RunRows& rows);
    /// The sum of the lengths of all runs, run units.
    std::int64_t total_length() const;
    /// Boxes as long as the runs; layer i is layer i of the grid, line l its row l.
    RunBoxes boxes(const SurveyGrid& grid) const;

  private:
    static std::size_t bytes(const RunRows& rows);

    std::size_t max_bytes_, bytes_ = 0;
    double pitch_;
    std::vector<RunRows> layers_;
};

}  // namespace lamella
