// Survey rows: bands of a layer, and the memory accounting of a stack of layers.
#include "engine/layers/survey_rows.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/number_format.h"

namespace lamella {
namespace {

constexpr int max_layers_in_a_pitch = 16;
constexpr double max_pitches = 1 << 20;  // along a side of the job

}  // namespace

Interval survey_pitch_range(const Job& job) {
    const dvec3 size = job.bounds.size();
    if (!std::isfinite(size.x + size.y + size.z) || job.bounds.empty())
        throw InputError("survey: the part's bounds are empty or infinite");
    return {std::max(size.x, size.y) / max_pitches, max_layers_in_a_pitch * job.layers.least_height()};
}

RowBand rows_over(const Rect& rect, double pitch) {
    const dvec2 size = rect.size();
    RowBand band;
    band.along_origin = rect.lo.x;
    band.across_origin = rect.lo.y;
    band.along_pitch = band.across_pitch = pitch;
    band.count = static_cast<int>(size.y / pitch) + 1;
    band.hi = static_cast<int>(size.x / pitch) + 1;
    return band;
}

RunRows all_rows(const SliceField& slice, const RowBand& whole, Scratch& scratch) {
    // As many rows at a time as have about band_lines lines.
    constexpr int band_lines = 64;
    const int band_rows = std::max(1, band_lines * whole.step / whole.sub);
    RunRows all;
    const auto some = scratch.rows();
    RowBand band = whole;
    const int end = whole.first + whole.count;
    for (; band.first < end; band.first += band_rows) {
        band.count = std::min(band_rows, end - band.first);
        slice.runs(band, scratch, *some);
        all.append_lines(*some);
    }
    return all;
}

void check_survey_pitch(const char* survey, const Job& job, double pitch, double step) {
    const Interval suited = survey_pitch_range(job);
    const double most = std::min(step, suited.hi);
    if (suited.lo <= pitch && pitch <= most * (1 + 1e-9)) return;
    throw InputError(std::string(survey) +
                     ": the pitch does not suit the part; accepted: " + format_number(suited.lo, 6) + " to " +
                     format_number(most, 6) + " mm: no more than a step, nor than 16 layers");
}

std::size_t LayerStack::bytes(const RunRows& rows) { return 56 * rows.runs().size() + 4 * rows.lines(); }

void LayerStack::push(const RunRows& rows) {
    layers_.emplace_back();
    replace(layers_.size() - 1, rows);
}

void LayerStack::replace(std::size_t i, const RunRows& rows) {
    bytes_ += bytes(rows);
    bytes_ -= bytes(layers_[i]);
    if (bytes_ > max_bytes_) {
        throw InputError("the plan of all layers needs more than " + std::to_string(max_bytes_ >> 20) +
                         " MB of memory, and " + std::to_string(layers_.size()) +
                         " layers are in it so far; a survey with a coarser pitch than " +
                         format_number(pitch_, 6) + " mm needs less");
    }
    layers_[i] = rows;
}

std::int64_t LayerStack::total_length() const {
    std::int64_t sum = 0;
    for (const RunRows& rows : layers_) sum += rows.total_length();
    return sum;
}

RunBoxes LayerStack::boxes(const SurveyGrid& grid) const {
    std::size_t count = 0;
    for (const RunRows& rows : layers_) count += rows.runs().size();
    std::vector<PlacedRun> runs;
    runs.reserve(count);
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        for (std::size_t l = 0; l < layers_[i].lines(); ++l) {
            for (const Run& run : layers_[i].line(l)) {
                runs.push_back(
                    {static_cast<std::int32_t>(i), static_cast<std::int32_t>(l), run.begin, run.end});
            }
        }
    }
    return {grid, std::move(runs)};
}

}  // namespace lamella
