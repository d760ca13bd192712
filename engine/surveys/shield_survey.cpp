// Shield survey: layers are dilated by gap and wall as they stream; then sweeps make the enclosure, and its
// outermost wall is kept.
#include "engine/surveys/shield_survey.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/layers/survey_rows.h"
#include "engine/morphology/layer_offset.h"
#include "engine/runs/row_sets.h"
#include "engine/surveys/printable_enclosure.h"

namespace lamella {
namespace {

/// Collects the regions that the shield must enclose, layer by layer.
class ShieldSurveyor : public LayerPass {
  public:
    ShieldSurveyor(const Job& job, const ShieldOptions& options)
        : options_(options),
          // The wall in whole rows; reach_ has one more row for features between the surveyed rows.
          wall_(std::ceil(options.wall / options.pitch - 1e-9) * run_unit),
          reach_(units(options.gap) + wall_ + run_unit),
          smooth_(units(options.bead)),
          rect_(grown(job.bounds.rect(), (reach_ + smooth_ + wall_ + 2 * run_unit) / units(1))),
          band_(rows_over(rect_, options.pitch)),
          layers_(options.max_bytes, options.pitch),
          groups_(options.layers_at_once, united) {}

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override;
    void write(const Layer& layer, LayerProduct& product) override;
    void finish() override {
        if (!groups_.empty()) layers_.push(groups_.take());
    }

    LayerStack& layers() { return layers_; }
    dvec2 origin() const { return rect_.lo; }
    double units(double mm) const { return mm * (run_unit / options_.pitch); }
    /// Returns the wall's thickness, run units.
    double wall() const { return wall_; }

  private:
    const ShieldOptions& options_;
    double wall_, reach_, smooth_;  // run units
    Rect rect_;
    RowBand band_;
    LayerStack layers_;
    LayerGroups groups_;  // union of the layers of the current group so far
};

std::unique_ptr<LayerProduct> ShieldSurveyor::render(const Layer& layer) const {
    auto product = std::make_unique<RowsProduct>();
    Scratch scratch;
    RunRows print = all_rows(layer.part(), band_, scratch);
    if (layer.supports() != nullptr) print = united(print, all_rows(*layer.supports(), band_, scratch));
    RunRows wide;
    grow_rows(WeightedRows(print, reach_ + smooth_), run_unit, wide);
    shrink_rows(wide, smooth_, run_unit, product->rows);
    return product;
}

void ShieldSurveyor::write(const Layer& /*layer*/, LayerProduct& product) {
    if (groups_.add(std::move(static_cast<RowsProduct&>(product).rows))) layers_.push(groups_.take());
}

/// Returns the rows with parts thinner than `least` thickened to about that thickness.
RunRows thickened(const RunRows& rows, double least) {
    RunRows core, opened, grown;
    shrink_rows(rows, least / 2, run_unit, core);
    // One more row: slivers where rows graze an outline do not count as thin.
    grow_rows(WeightedRows(core, least / 2 + run_unit), run_unit, opened);
    grow_rows(WeightedRows(without(rows, opened), least / 2), run_unit, grown);
    return united(rows, grown);
}

/// Replaces each layer by the points within the wall's thickness of its outline.
void keep_walls(LayerStack& layers, double wall) {
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const RunRows outer = thickened(layers[i], wall);
        RunRows inside;
        shrink_rows(outer, wall, run_unit, inside);
        layers.replace(i, without(outer, inside));
    }
}

void check(const Job& job, const ShieldOptions& options) {
    const auto refuse = [](const std::string& what) { throw InputError("shield: " + what); };
    if (!(options.wall > 0 && options.step > 0)) refuse("the wall and the step must be above 0 mm");
    if (!(options.gap >= 0 && options.bead >= 0 && options.layers_at_once > 0))
        refuse("the gap, the bead or the number of layers taken at once is below its least");
    check_survey_pitch("shield", job, options.pitch, options.step * options.layers_at_once);
}

}  // namespace

ShieldSurvey make_shield(const Job& given, const ShieldOptions& options) {
    const Job job = in_equal_layers(given);
    check(job, options);
    ShieldSurveyor surveyor(job, options);
    survey_layers(job, surveyor, options);
    LayerStack& layers = surveyor.layers();
    ShieldSurvey survey;
    const double step = surveyor.units(options.step * options.layers_at_once);
    constexpr double corner = 2.5;  // steps: corners of 50 degrees and more may move with their sides
    survey.sweeps = enclose(layers, {step, corner * step, run_unit}, options.cancel);
    keep_walls(layers, surveyor.wall());
    const double height = job.layers.least_height() * options.layers_at_once;
    survey.volume =
        static_cast<double>(layers.total_length()) / run_unit * options.pitch * options.pitch * height;
    survey.wall =
        std::make_shared<RunBoxes>(layers.boxes({surveyor.origin(), options.pitch, job.z0(), height}));
    return survey;
}

}  // namespace lamella
