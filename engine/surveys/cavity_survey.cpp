// Cavity survey: the void of each layer is labelled in parallel and joined in order.
#include "engine/surveys/cavity_survey.h"

#include <algorithm>
#include <map>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "engine/layers/survey_rows.h"
#include "engine/runs/run_components.h"

namespace lamella {
namespace {

constexpr int cavity_band_rows = 64;  // a band's runs stay in the cache

/// Returns rows over the job's bounds, surrounded by a row and a column of void.
RowBand void_band(const Job& job, double pitch) {
    const dvec3 size = job.bounds.size();
    RowBand band;
    band.along_origin = job.bounds.lo.x - pitch;
    band.across_origin = job.bounds.lo.y - pitch;
    band.along_pitch = band.across_pitch = pitch;
    band.count = static_cast<int>(size.y / pitch) + 4;
    band.hi = static_cast<int>(size.x / pitch) + 4;
    return band;
}

/// A component's runs in one layer, and sums of their positions weighted with their lengths.
struct LayerShare {
    int layer = 0;
    std::int64_t length = 0;
    double along = 0, across = 0;
    std::vector<PlacedRun> runs;

    void include(const PlacedRun& run) {
        const std::int64_t width = run.end - run.begin;
        length += width;
        along += static_cast<double>(width) * 0.5 * (run.begin + run.end);
        across += static_cast<double>(width) * run.row;
        runs.push_back(run);
    }
    void include(const LayerShare& other) {
        length += other.length;
        along += other.along;
        across += other.across;
        runs.insert(runs.end(), other.runs.begin(), other.runs.end());
    }
};

struct VoidProduct : LayerProduct {
    LabelledLayer voids;
    std::vector<LayerShare> shares;  ///< by component
};

class CavitySurveyor : public LayerPass {
  public:
    CavitySurveyor(const Job& job, const CavitySurveyOptions& options)
        : pitch_(options.pitch),
          height_(job.layers.least_height()),
          z0_(job.z0()),
          band_(void_band(job, options.pitch)),
          components_(Growth{}, 0) {
        // A layer of pure void lies below the first one.
        RunRows all;
        for (int r = 0; r < band_.count; ++r) {
            all.push(0, band_.hi * run_unit);
            all.end_line();
        }
        outside_ = components_.add(label_layer(all, -1, Growth{}), -1).front();
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override;
    void write(const Layer& layer, LayerProduct& product) override;

    CavitySurvey result(std::size_t most);

  private:
    struct Ends {
        LayerShare low, high;
    };
    dvec3 middle(const LayerShare& share) const;
    void include_ends(std::map<std::uint32_t, Ends>& all, std::uint32_t number, const Ends& more) const;

    double pitch_, height_, z0_;  ///< mm
    RowBand band_;
    RunComponents components_;
    std::uint32_t outside_ = 0;
    int last_layer_ = -1;
    std::map<std::uint32_t, Ends> ends_;  ///< by the component's number when it was last met
};

std::unique_ptr<LayerProduct> CavitySurveyor::render(const Layer& layer) const {
    auto product = std::make_unique<VoidProduct>();
    Scratch scratch;
    const auto some = scratch.rows();
    RunRows voids;
    RowBand band = band_;
    double solid = 0;
    for (band.first = 0; band.first < band_.count; band.first += cavity_band_rows) {
        band.count = std::min(cavity_band_rows, band_.count - band.first);
        layer.part().runs(band, scratch, *some);
        solid += static_cast<double>(some->total_length());
        for (std::size_t l = 0; l < some->lines(); ++l) {
            std::int32_t from = 0;
            for (const Run& run : some->line(l)) {
                voids.push(from, run.begin);
                from = run.end;
            }
            voids.push(from, band_.hi * run_unit);
            voids.end_line();
        }
    }
    product->area = solid / run_unit * pitch_ * pitch_;
    product->voids = label_layer(voids, layer.index(), Growth{});
    product->shares.resize(product->voids.components.size());
    for (int r = 0; r < band_.count; ++r) {
        for (const LabelledRun& run : product->voids.row(r)) {
            LayerShare& share = product->shares[run.component];
            share.layer = layer.index();
            share.include(PlacedRun{layer.index(), r, run.begin, run.end});
        }
    }
    return product;
}

void CavitySurveyor::include_ends(std::map<std::uint32_t, Ends>& all, std::uint32_t number,
                                  const Ends& more) const {
    const auto [found, first] = all.emplace(number, more);
    if (first) return;
    Ends& known = found->second;
    if (more.low.layer < known.low.layer) {
        known.low = more.low;
    } else if (more.low.layer == known.low.layer) {
        known.low.include(more.low);
    }
    if (more.high.layer > known.high.layer) {
        known.high = more.high;
    } else if (more.high.layer == known.high.layer) {
        known.high.include(more.high);
    }
}

void CavitySurveyor::write(const Layer& layer, LayerProduct& product) {
    auto& labelled = static_cast<VoidProduct&>(product);
    last_layer_ = layer.index();
    const auto numbers = components_.add(std::move(labelled.voids), layer.index());
    // Components that joined the outside are forgotten; those that joined another one are merged with it.
    for (std::size_t c = 0; c < numbers.size(); ++c) {
        const std::uint32_t number = components_.find(numbers[c]);
        if (number == components_.find(outside_)) continue;
        include_ends(ends_, number, {labelled.shares[c], labelled.shares[c]});
    }
    std::map<std::uint32_t, Ends> joined;
    bool changed = false;
    for (const auto& [number, ends] : ends_) changed = changed || components_.find(number) != number;
    if (!changed) return;
    for (const auto& [number, ends] : ends_) {
        const std::uint32_t now = components_.find(number);
        if (now != components_.find(outside_)) include_ends(joined, now, ends);
    }
    ends_.swap(joined);
}

/// Returns a point of the runs, as near to their centroid as possible, but half a pixel inside its run.
dvec3 CavitySurveyor::middle(const LayerShare& share) const {
    const auto length = static_cast<double>(share.length);
    const double along = share.along / length / run_unit, across = share.across / length;
    const PlacedRun* best = nullptr;
    double place = 0, nearest = infinity;
    for (const PlacedRun& run : share.runs) {
        // Half a pixel in from the ends, where there is room.
        const double begin = static_cast<double>(run.begin) / run_unit,
                     end = static_cast<double>(run.end) / run_unit;
        const double inset = std::min(0.5, 0.5 * (end - begin));
        const double u = std::min(std::max(along, begin + inset), end - inset);
        const double d = (u - along) * (u - along) + (run.row - across) * (run.row - across);
        if (d < nearest) {
            nearest = d;
            best = &run;
            place = u;
        }
    }
    return {band_.along_origin + place * pitch_, band_.across_origin + (best->row + 0.5) * pitch_,
            z0_ + (share.layer + 0.5) * height_};
}

CavitySurvey CavitySurveyor::result(std::size_t most) {
    CavitySurvey survey;
    for (const auto& [number, ends] : ends_) {
        // The void of the last layer continues above it.
        if (ends.high.layer == last_layer_) continue;
        const auto& component = components_.component(number);
        const double volume =
            static_cast<double>(component.extent.length) / run_unit * pitch_ * pitch_ * height_;
        ++survey.count;
        survey.volume += volume;
        survey.cavities.push_back({volume, middle(ends.low), middle(ends.high)});
    }
    std::stable_sort(survey.cavities.begin(), survey.cavities.end(), [](const Cavity& a, const Cavity& b) {
        return a.volume != b.volume ? a.volume > b.volume : a.lowest.z < b.lowest.z;
    });
    if (survey.cavities.size() > most) survey.cavities.resize(most);
    return survey;
}

}  // namespace

CavitySurvey survey_cavities(const Job& given, const CavitySurveyOptions& options) {
    const Job job = in_equal_layers(given);
    const Interval suited = survey_pitch_range(job);
    if (!(options.pitch > 0) || !suited.contains(options.pitch)) {
        throw InputError("cavity survey: the pitch of " + format_number(options.pitch, 9) +
                         " mm does not suit the part; accepted: " + format_number(suited.lo, 9) + " to " +
                         format_number(suited.hi, 9) + " mm");
    }
    CavitySurveyor surveyor(job, options);
    survey_layers(job, surveyor, options);
    return surveyor.result(options.most);
}

}  // namespace lamella
