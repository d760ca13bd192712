// Hollow survey: layers are eroded by the wall as they stream; then a sweep from the top down makes the
// cavities.
#include "engine/surveys/hollow_survey.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/layers/survey_rows.h"
#include "engine/morphology/sampled_ball.h"
#include "engine/runs/row_sets.h"
#include "engine/surveys/printable_roof.h"

namespace lamella {
namespace {

/// Collects the insides, where cavities may be, layer by layer: the part eroded by the wall, without parts
/// that are too narrow.
class HollowSurveyor : public LayerPass {
  public:
    HollowSurveyor(const Job& job, const HollowOptions& options)
        : options_(options),
          band_(rows_over(job.bounds.rect(), options.pitch)),
          height_(job.layers.least_height() * options.layers_at_once),
          middle_(job.bounds.size() / 2.0),
          shrunk_(ball_lattice(band_, height_, reach(), reach()), units(reach())),
          insides_(options.max_bytes, options.pitch),
          groups_(options.layers_at_once, common) {}

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override;
    void write(const Layer& layer, LayerProduct& product) override;
    void finish() override;

    LayerStack& insides() { return insides_; }
    const RowBand& band() const { return band_; }
    double height() const { return height_; }
    double part_volume() const { return part_volume_; }
    double units(double mm) const { return mm * (run_unit / options_.pitch); }

  private:
    /// The wall plus the sampling error: a row of a layer stands for half a pitch and half a course to all
    /// sides, and so does a row of void.
    double reach() const {
        return options_.wall + std::sqrt(options_.pitch * options_.pitch + height_ * height_);
    }
    void push_group();
    void take_shrunk();
    RunRows wide_enough(const RunRows& rows) const;
    RunRows chamber_walls() const;

    const HollowOptions& options_;
    RowBand band_;
    double height_;  // of a group of layers_at_once layers; mm
    dvec3 middle_;   // centre of the bounds, from their lower corner, mm
    ErosionStream shrunk_;
    LayerStack insides_;
    LayerGroups groups_;  // intersection of the layers of the current group so far
    double part_volume_ = 0;
};

std::unique_ptr<LayerProduct> HollowSurveyor::render(const Layer& layer) const {
    auto product = std::make_unique<RowsProduct>();
    Scratch scratch;
    product->rows = all_rows(layer.part(), band_, scratch);
    product->area =
        static_cast<double>(product->rows.total_length()) / run_unit * options_.pitch * options_.pitch;
    return product;
}

void HollowSurveyor::write(const Layer& layer, LayerProduct& product) {
    RunRows& rows = static_cast<RowsProduct&>(product).rows;
    part_volume_ += product.area * layer.thickness();
    if (groups_.add(std::move(rows))) push_group();
}

void HollowSurveyor::finish() {
    if (!groups_.empty()) push_group();
    shrunk_.finish();
    take_shrunk();
}

void HollowSurveyor::push_group() {
    shrunk_.push(groups_.take());
    take_shrunk();
}

void HollowSurveyor::take_shrunk() {
    for (RunRows rows; shrunk_.pop(rows);) insides_.push(wide_enough(rows));
}

/// Subtracts the chamber walls and opens each chamber by a disc as wide as a bead.
RunRows HollowSurveyor::wide_enough(const RunRows& rows) const {
    RunRows divided = rows;
    if (options_.chamber > 0) subtract(rows, chamber_walls(), divided);
    if (options_.bead == 0) return divided;
    RunRows shrunk, opened;
    shrink_rows(divided, units(options_.bead / 2), run_unit, shrunk);
    grow_rows(WeightedRows(shrunk, units(options_.bead / 2)), run_unit, opened);
    return opened;
}

/// Returns the chamber walls along x and y, at least a bead wide. One of each kind goes through the middle.
RunRows HollowSurveyor::chamber_walls() const {
    const double every = options_.chamber + options_.bead, half = options_.bead / 2;
    const double width = band_.hi * options_.pitch;
    RunRows walls;
    for (int l = 0; l < band_.count; ++l) {
        const double y = (l + 0.5) * options_.pitch - middle_.y;
        if (std::abs(y - every * std::floor(y / every + 0.5)) < half + options_.pitch / 2) {
            walls.push(0, band_.hi * run_unit);
        } else {
            for (double x = middle_.x - every * std::floor(middle_.x / every); x < width; x += every) {
                walls.push(round_run(units(x - half)), round_run(units(x + half)));
            }
        }
        walls.end_line();
    }
    return walls;
}

/// Replaces the insides by the cavities, from the top down.
void sweep_down(LayerStack& layers, const RoofRule& rule, const CancelToken* cancel) {
    if (layers.size() == 0) return;
    RunRows above = empty_rows(layers[0].lines());
    for (std::size_t i = layers.size(); i-- > 0;) {
        if (cancel != nullptr && cancel->cancelled()) throw Interrupted("stopped while cavities were made");
        above = cavity_below(above, layers[i], rule);
        layers.replace(i, above);
    }
}

/// For each layer, the numbers of its components among those of the whole stack.
using ComponentNumbers = std::vector<std::vector<std::uint32_t>>;

/// Removes the runs of components that are too small.
void leave_solid(LayerStack& layers, const ComponentNumbers& numbers, RunComponents& components,
                 std::int64_t min_length) {
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const LabelledLayer labels = label_layer(layers[i], static_cast<int>(i), Growth{});
        RunRows rest;
        std::size_t k = 0;
        for (std::size_t l = 0; l < layers[i].lines(); ++l) {
            for (const Run& run : layers[i].line(l)) {
                const std::uint32_t number = numbers[i][labels.owners[k++]];
                if (components.component(number).extent.length >= min_length) rest.push(run.begin, run.end);
            }
            rest.end_line();
        }
        layers.replace(i, rest);
    }
}

/// Counts the cavities and removes those that are too small.
void sort_out(LayerStack& layers, std::int64_t min_length, HollowSurvey& survey) {
    RunComponents components(Growth{}, 0);
    ComponentNumbers numbers;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const int index = static_cast<int>(i);
        numbers.push_back(components.add(label_layer(layers[i], index, Growth{}), index));
    }
    for (const std::uint32_t number : components.numbers()) {
        const bool small = components.component(number).extent.length < min_length;
        ++(small ? survey.left_solid : survey.count);
    }
    if (survey.left_solid > 0) leave_solid(layers, numbers, components, min_length);
}

void check(const Job& job, const HollowOptions& options) {
    const auto refuse = [](const std::string& what) { throw InputError("hollowing out: " + what); };
    if (!(options.wall > 0 && options.step > 0)) refuse("the wall and the step must be above 0 mm");
    if (!(options.bead >= 0 && options.chamber >= 0 && options.min_volume >= 0 &&
          options.layers_at_once > 0)) {
        refuse("a width, a volume or the number of layers taken at once is below its least");
    }
    check_survey_pitch("hollowing out", job, options.pitch, options.step * options.layers_at_once);
}

}  // namespace

HollowSurvey hollow_out(const Job& given, const HollowOptions& options) {
    const Job job = in_equal_layers(given);
    check(job, options);
    HollowSurveyor surveyor(job, options);
    survey_layers(job, surveyor, options);
    LayerStack& layers = surveyor.insides();
    const double step = surveyor.units(options.step * options.layers_at_once);
    sweep_down(layers, {step, run_unit, surveyor.units(options.bead)}, options.cancel);
    const double unit_volume = options.pitch * options.pitch * surveyor.height() / run_unit;
    HollowSurvey survey;
    sort_out(layers, static_cast<std::int64_t>(std::ceil(options.min_volume / unit_volume)), survey);
    survey.volume = static_cast<double>(layers.total_length()) * unit_volume;
    survey.part_volume = surveyor.part_volume();
    const SurveyGrid grid{{job.bounds.lo.x, job.bounds.lo.y}, options.pitch, job.z0(), surveyor.height()};
    survey.cavities = std::make_shared<RunBoxes>(layers.boxes(grid));
    return survey;
}

}  // namespace lamella
