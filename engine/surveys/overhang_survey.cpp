// Overhang survey: a back-end of the layer stream. Layers are sampled in parallel and compared in order.
#include "engine/surveys/overhang_survey.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "engine/surveys/overhang_spans.h"

namespace lamella {
namespace {

class OverhangSurveyor : public LayerPass {
  public:
    OverhangSurveyor(const Job& job, const OverhangSurveyOptions& options)
        : options_(options),
          by_(job, options.limits),
          z0_(job.z0()),
          below_(std::make_unique<SurveyedLayer>()),
          placer_(options.limits.spacing, options.blocked),
          components_(Growth{}, 0) {
        if (options.stability) stability_.emplace(*options.stability, options.limits.spacing, z0_);
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<HeldProduct>();
        product->layer = survey_layer(layer, by_);
        product->area = product->layer->area;
        return product;
    }
    void write(const Layer& layer, LayerProduct& product) override {
        auto surveyed = std::move(static_cast<HeldProduct&>(product).layer);
        compare(layer, *surveyed);
        below_ = std::move(surveyed);
    }

    OverhangSurvey result();

  private:
    /// Holds the layer by pointer, so that it can be kept for comparison with the next one.
    struct HeldProduct : LayerProduct {
        std::unique_ptr<SurveyedLayer> layer;
    };

    void compare(const Layer& layer, const SurveyedLayer& surveyed);
    std::vector<double> stand_out(const SurveyedLayer& layer) const;
    void number_pieces(const SurveyedLayer& layer, int index);
    void hold_islands(const SurveyedLayer& layer, double z, std::size_t points_before, bool small_ones);
    void weigh(const SurveyedLayer& layer, double thickness);
    void lay_on_bed(const SurveyedLayer& layer);
    void offer_places(const SurveyedLayer& layer, const std::vector<double>& out, double z, double thickness);
    void make_steady(const SurveyedLayer& layer, std::size_t points_before, double top);

    const OverhangSurveyOptions& options_;
    SurveyResolution by_;
    double z0_;
    std::unique_ptr<SurveyedLayer> below_;
    SupportPlacer placer_;
    RunComponents components_;
    std::optional<PrintStability> stability_;
    std::vector<std::uint32_t> numbers_;  ///< the component of each piece of the current layer
    std::vector<std::uint8_t> island_;    ///< by piece: 1 if its component begins with it
    std::vector<std::uint32_t> live_;     ///< components of the layer before, ascending
    std::uint32_t known_ = 0;             ///< number of components so far
    OverhangSurvey survey_;
};

void OverhangSurveyor::compare(const Layer& layer, const SurveyedLayer& surveyed) {
    const double z = z0_ + layer.bottom();
    const bool lies = layer.index() == 0 && options_.on_bed;
    const std::size_t points_before = placer_.points().size();
    number_pieces(surveyed, layer.index());
    if (stability_) weigh(surveyed, layer.thickness());
    if (lies) {
        if (stability_) lay_on_bed(surveyed);
    } else {
        const std::vector<double> out = stand_out(surveyed);
        const PathQuestion question{surveyed, by_, options_.limits, options_.enforced.get(), z, out, island_};
        hold_islands(surveyed, z, points_before, true);
        const PathFindings found = hold_paths(question, placer_);
        survey_.hanging_length += found.hanging_length;
        survey_.own_bridges += found.own_bridges;
        hold_spans(question, *below_, found.bridge_ways, placer_);
        hold_islands(surveyed, z, points_before, false);
        if (stability_) offer_places(surveyed, out, z, layer.thickness());
    }
    if (stability_) make_steady(surveyed, points_before, z + layer.thickness());
}

std::vector<double> OverhangSurveyor::stand_out(const SurveyedLayer& layer) const {
    std::vector<double> out;
    out.reserve(layer.samples.size());
    for (const OutlineSample& sample : layer.samples) out.push_back(below_->stand_out(sample.at, by_));
    return out;
}

void OverhangSurveyor::number_pieces(const SurveyedLayer& layer, int index) {
    numbers_ = components_.add(layer.labelled, index);
    island_.clear();
    const std::uint32_t known = known_;
    for (const std::uint32_t number : numbers_) {
        island_.push_back(number >= known ? 1 : 0);
        known_ = std::max(known_, number + 1);
    }
    if (!stability_) return;
    for (const std::uint32_t number : live_) {
        const std::uint32_t now = components_.find(number);
        if (now != number) stability_->join(now, number);
    }
    live_ = numbers_;
    std::sort(live_.begin(), live_.end());
    live_.erase(std::unique(live_.begin(), live_.end()), live_.end());
    stability_->keep_only(live_);
}

/// Places a point in the middle of islands that have none: of small ones before the outlines are walked, of
/// large ones afterwards.
void OverhangSurveyor::hold_islands(const SurveyedLayer& layer, double z, std::size_t points_before,
                                    bool small_ones) {
    if (std::find(island_.begin(), island_.end(), 1) == island_.end()) return;
    std::vector<std::uint8_t> has_point(island_.size(), 0);
    for (std::size_t k = points_before; k < placer_.points().size(); ++k) {
        const std::uint32_t piece = layer.piece_at(dvec2(placer_.points()[k].at), by_.band);
        if (piece != no_piece) has_point[piece] = 1;
    }
    for (std::uint32_t piece = 0; piece < island_.size(); ++piece) {
        if (island_[piece] == 0 || has_point[piece] != 0) continue;
        const ComponentExtent& extent = layer.labelled.components[piece];
        const double x = static_cast<double>(extent.along.end - extent.along.begin) / run_unit,
                     y = extent.last_row - extent.first_row + 1;
        const double reach = by_.band.across_pitch * std::sqrt(x * x + y * y) / 2;
        if ((reach <= options_.limits.spacing) != small_ones) continue;
        placer_.place({layer.middle(piece, by_.band), z}, SupportReason::island);
    }
}

void OverhangSurveyor::weigh(const SurveyedLayer& layer, double thickness) {
    for (std::size_t piece = 0; piece < numbers_.size(); ++piece) {
        const LayerPiece& p = layer.pieces[piece];
        stability_->add(numbers_[piece], p.area * thickness, p.moment * thickness);
    }
}

void OverhangSurveyor::lay_on_bed(const SurveyedLayer& layer) {
    std::vector<std::vector<dvec2>> borders(numbers_.size());
    for (int r = 0; r < layer.labelled.rows(); ++r) {
        for (const LabelledRun& run : layer.labelled.row(r)) {
            for (const std::int32_t u : {run.begin, run.end}) {
                for (const int edge : {r, r + 1})
                    borders[run.component].push_back(on_band(by_.band, u, edge));
            }
        }
    }
    for (std::size_t piece = 0; piece < numbers_.size(); ++piece) {
        const LayerPiece& p = layer.pieces[piece];
        stability_->lay_on_bed(numbers_[piece], p.area, p.moment, borders[piece]);
    }
}

/// Offers the samples that stand out over the layer below: there the surface faces down, so that a support
/// can reach it, unless it is nearly upright.
void OverhangSurveyor::offer_places(const SurveyedLayer& layer, const std::vector<double>& out, double z,
                                    double thickness) {
    // After simplification, equal outlines in two layers may differ by a quarter of the tolerance.
    const double measurable = std::max(by_.tolerance / 4, thickness / 3);
    for (const OutlinePath& path : layer.paths) {
        if (path.piece == no_piece) continue;
        const std::uint32_t component = numbers_[path.piece];
        for (std::size_t k = path.first; k < path.first + path.count; ++k) {
            if (!(out[k] > measurable)) continue;
            const OutlineSample& sample = layer.samples[k];
            if (!stability_->wants(component, {sample.at, z})) continue;
            const dvec3 place(layer.bead(sample, std::min(by_.width, 2 * out[k])), z);
            if (stability_->wants(component, place) && !placer_.blocked(place)) {
                stability_->offer(component, place);
            }
        }
    }
}

void OverhangSurveyor::make_steady(const SurveyedLayer& layer, std::size_t points_before, double top) {
    for (std::size_t k = points_before; k < placer_.points().size(); ++k) {
        const dvec3 at = placer_.points()[k].at;
        const std::uint32_t piece = layer.piece_at(dvec2(at), by_.band);
        if (piece != no_piece) stability_->hold(numbers_[piece], at);
    }
    for (const dvec3 at : stability_->steady(top)) placer_.place(at, SupportReason::stability);
}

OverhangSurvey OverhangSurveyor::result() {
    survey_.points = placer_.points();
    survey_.blocked = placer_.left_out();
    std::stable_sort(survey_.points.begin(), survey_.points.end(),
                     [](const SupportPoint& a, const SupportPoint& b) { return a.at.z < b.at.z; });
    if (stability_ && stability_->topples_at() < infinity)
        survey_.topples_at = stability_->topples_at() - z0_;
    return std::move(survey_);
}

void check_number(const char* name, double value, bool zero_too) {
    if (value < 1e9 && (zero_too ? value >= 0 : value > 0)) return;
    const bool printable = std::abs(value) < 1e9;
    throw InputError(std::string("overhang survey: the ") + name +
                     (printable ? " of " + format_number(value, 9) : std::string()) +
                     " makes no sense; accepted: numbers below 1e9 " +
                     (zero_too ? "of at least 0" : "greater than 0"));
}

void check(const Job& job, const OverhangSurveyOptions& options) {
    const OverhangLimits& limits = options.limits;
    check_number("overhang", limits.overhang, false);
    check_number("width", limits.width, false);
    check_number("spacing", limits.spacing, false);
    check_number("free stretch", limits.free_stretch, true);
    check_number("bridge", limits.bridge, true);
    if (options.stability) {
        const StabilityLimits& s = *options.stability;
        check_number("margin", s.margin, true);
        check_number("push", s.push, true);
        check_number("adhesion", s.adhesion, true);
        check_number("bond", s.bond, true);
        check_number("contact", s.contact, false);
        check_number("density", s.density, true);
        check_number("least height", s.min_height, true);
    }
    if (!job.part) throw InputError("overhang survey: there is no part");
    const dvec3 size = job.bounds.size();
    if (job.bounds.empty() || !std::isfinite(size.x + size.y + size.z))
        throw InputError("overhang survey: the part's bounds are empty or infinite");
    const double side = std::max(size.x, size.y);
    constexpr double max_rows = 1 << 15;
    const double pitch = std::min(std::max(limits.width / 4, limits.overhang / 8), limits.overhang);
    if (side / pitch < max_rows) return;
    throw InputError(
        "overhang survey: an overhang of " + format_number(limits.overhang, 9) + " mm and a width of " +
        format_number(limits.width, 9) + " mm are too fine for a part of " + format_number(side, 9) +
        " mm; accepted: an overhang of at least a 2^15th of the part and a width of four times that");
}

}  // namespace

OverhangSurvey survey_overhangs(const Job& job, const OverhangSurveyOptions& options) {
    check(job, options);
    Job bare = job;
    bare.supports = nullptr;
    OverhangSurveyor surveyor(bare, options);
    survey_layers(bare, surveyor, options);
    return surveyor.result();
}

}  // namespace lamella
