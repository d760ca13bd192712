// A pass over slabs: differences of two sections, bisection along z, normals by central differences.
#include "engine/surveys/slope_survey.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/layers/survey_rows.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

/// What is known of the surface in a slab.
struct SlabSlopes : LayerProduct {
    double flattest = 0;
    Interval level{infinity, -infinity};  ///< heights of level points, mm
};

class SlopeSurveyor : public LayerPass {
  public:
    SlopeSurveyor(const Job& job, double pitch) : job_(job), pitch_(pitch) {
        profile_.step = job.layers.least_height();
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<SlabSlopes>();
        for (const Axis axis : {Axis::x, Axis::y}) {
            const RowBand band = rows_along(axis);
            Scratch scratch;
            const RunRows below = all_rows(layer.part_at(0), band, scratch),
                          above = all_rows(layer.part_at(1), band, scratch);
            look_at(without(below, above), band, true, layer, *product);
            look_at(without(above, below), band, false, layer, *product);
        }
        return product;
    }

    void write(const Layer& /*layer*/, LayerProduct& product) override {
        const auto& slab = static_cast<const SlabSlopes&>(product);
        constexpr double thinnest = 1e-3;  // of a slab, to which a level face is known
        double flattest = slab.flattest;
        if (slab.level.lo <= slab.level.hi) {
            const bool is_level = slab.level.hi - slab.level.lo <= thinnest * profile_.step;
            if (is_level) {
                profile_.levels.push_back((slab.level.lo + slab.level.hi) / 2 - job_.z0());
            } else {
                flattest = 1;
            }
        }
        profile_.flattest.push_back(flattest);
    }

    SlopeProfile take() { return std::move(profile_); }

  private:
    RowBand rows_along(Axis axis) const {
        const Rect rect = job_.bounds.rect();
        RowBand band = rows_over(rect, pitch_);
        if (axis == Axis::x) return band;
        band.axis = axis;
        std::swap(band.along_origin, band.across_origin);
        const std::int32_t along = band.hi;
        band.hi = band.count;
        band.count = along;
        return band;
    }

    /// Adds the surface over or under runs that only one section of the slab has: the lower one or the upper.
    void look_at(const RunRows& runs, const RowBand& band, bool is_below, const Layer& layer,
                 SlabSlopes& slab) const {
        constexpr std::int32_t most_samples = 8;  // of a run
        for (std::size_t l = runs.line_with_runs(0); l < runs.lines(); l = runs.line_with_runs(l + 1)) {
            stop_if_cancelled(layer.cancel());
            for (const Run& run : runs.line(l)) {
                const std::int32_t length = run.end - run.begin;
                const std::int32_t samples = std::min(1 + length / run_unit, most_samples);
                for (std::int32_t k = 0; k < samples; ++k) {
                    const double along = run.begin + (k + 0.5) * length / samples;
                    add_surface(on_band(band, along, static_cast<double>(l) + 0.5), is_below, layer, slab);
                }
            }
        }
    }

    /// Bisects for the surface over a point of the plane, and adds its normal. The heights of level faces are
    /// found more closely.
    void add_surface(dvec2 at, bool is_below, const Layer& layer, SlabSlopes& slab) const {
        constexpr int first_halvings = 4, more_halvings = 16;
        constexpr double upright = 1 - 1e-6;
        const double half = layer.thickness() / 2;
        Interval heights{layer.z() - half, layer.z() + half};
        halve(heights, at, is_below, first_halvings);
        const double middle = (heights.lo + heights.hi) / 2;
        const double normal = std::abs(normal_z({at, middle}, layer.thickness() / 16));
        if (normal < upright) {
            slab.flattest = std::max(slab.flattest, normal);
            return;
        }
        halve(heights, at, is_below, more_halvings);
        slab.level = {std::min(slab.level.lo, heights.lo), std::max(slab.level.hi, heights.hi)};
    }

    /// Halves an interval of heights about the surface over a point of the plane, so many times.
    void halve(Interval& heights, dvec2 at, bool is_below, int times) const {
        const double reach = (heights.hi - heights.lo) / 1024;
        for (int i = 0; i < times; ++i) {
            const double middle = (heights.lo + heights.hi) / 2;
            const bool is_solid = job_.part->value_within({at, middle}, reach) < 0;
            (is_solid == is_below ? heights.lo : heights.hi) = middle;
        }
    }

    /// Returns the z of the unit normal; 1 where values do not tell it.
    double normal_z(dvec3 p, double apart) const {
        const double reach = job_.layers.least_height();  // the surface is nearer: values are exact
        dvec3 slope;
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            dvec3 step(0);
            step[axis] = apart;
            slope[axis] = job_.part->value_within(p + step, reach) - job_.part->value_within(p - step, reach);
        }
        const double length = glm::length(slope);
        return length > 0 && std::isfinite(length) ? slope.z / length : 1;
    }

    const Job& job_;
    double pitch_;
    SlopeProfile profile_;
};

}  // namespace

double SlopeProfile::flattest_in(double bottom, double top) const {
    const auto slab = [&](double height) {
        return static_cast<std::size_t>(std::clamp(height / step, 0.0, static_cast<double>(flattest.size())));
    };
    const double tiny = 1e-9 * step;
    double most = 0;
    for (std::size_t i = slab(bottom + tiny);
         i < flattest.size() && static_cast<double>(i) * step < top - tiny; ++i)
        most = std::max(most, flattest[i]);
    return most;
}

SlopeProfile survey_slopes(const FieldPtr& solid, const Box& bounds, const SlopeSurveyOptions& options) {
    Job job;
    job.part = solid;
    job.bounds = bounds;
    job.layers = {static_cast<int>(std::ceil(bounds.size().z / options.step)), options.step};
    SlopeSurveyor surveyor(job, options.pitch);
    try {
        survey_layers(job, surveyor, options);
    } catch (const Interrupted&) {
        throw Interrupted("stopped before the heights of layers were known");
    }
    return surveyor.take();
}

}  // namespace lamella
