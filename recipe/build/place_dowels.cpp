// Surveys the intersection of all layers, eroded by the holes' radius and margin.
#include "recipe/build/place_dowels.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/layers/layer_stream.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "printers/vector/dowel_places.h"

namespace lamella {

namespace {

struct ClearProduct : LayerProduct {
    Polygons clear;  ///< allowed positions of a hole's axis
    bool empty = false;
};

/// Intersects the allowed positions of all layers so far. Throws InputError when a given place is not
/// allowed.
class ClearSurvey : public LayerPass {
  public:
    ClearSurvey(double radius, double tolerance, std::vector<dvec2> places)
        : radius_(radius), tolerance_(tolerance), places_(std::move(places)) {}

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<ClearProduct>();
        Polygons section;
        for (const Contour& contour : layer.contours(tolerance_))
            section.push_back(to_polygon(contour.points));
        product->empty = section.empty();
        product->clear = erode_polygons(section, radius_);
        return product;
    }
    void write(const Layer& layer, LayerProduct& product) override {
        auto& found = dynamic_cast<ClearProduct&>(product);
        if (found.empty) return;  // an empty layer needs no alignment
        for (const dvec2& place : places_) {
            if (is_inside(found.clear, place)) continue;
            throw InputError(fmt::format(
                "printer.dowel_at / --printer-dowel-at: the hole at ({}, {}) mm is outside layer {} or too "
                "close to its border; accepted: places {:.4g} mm inside every layer (dowel_diameter / 2 + "
                "dowel_margin), or a dowel_height that ends below that layer",
                place.x, place.y, layer.index(), radius_));
        }
        if (closed_ >= 0) return;
        clear_ = first_ ? std::move(found.clear) : intersect_polygons(clear_, found.clear);
        first_ = false;
        if (clear_.empty()) closed_ = layer.index();
    }

    const Polygons& clear() const { return clear_; }
    /// The first layer at which no allowed position is left; negative when there is none.
    int closed() const { return closed_; }

  private:
    double radius_, tolerance_;
    std::vector<dvec2> places_;
    Polygons clear_;
    bool first_ = true;
    int closed_ = -1;
};

std::vector<dvec2> places_of(const CuttingProfile& cutting) {
    std::vector<dvec2> places;
    for (const auto& row : cutting.dowel_at) places.emplace_back(row[0], row[1]);
    if (!places.empty() && cutting.dowels != 0 && places.size() != static_cast<std::size_t>(cutting.dowels)) {
        throw InputError(
            fmt::format("printer.dowel_at / --printer-dowel-at: {} places are given for {} dowels; accepted: "
                        "as many places as printer.dowels, or dowel_at alone",
                        places.size(), cutting.dowels));
    }
    return places;
}

/// Returns the number of layers whose cutting planes the holes pass through.
int layers_of(const Job& job, double height) {
    if (height == 0) return job.layers.count();
    int count = 0;
    while (count < job.layers.count() && job.plane(count) - job.z0() < height) ++count;
    return count;
}

}  // namespace

bool asks_for_dowels(const Recipe& recipe) {
    return recipe.printer.cutting.dowels != 0 || !recipe.printer.cutting.dowel_at.empty();
}

DowelHoles place_dowels(const Recipe& recipe, const Job& job) {
    const CuttingProfile& cutting = recipe.printer.cutting;
    if (cutting.dowels == 1) {
        throw InputError(
            "printer.dowels / --printer-dowels: a layer can rotate about a single pin; accepted: 0, 2 or 3");
    }
    DowelHoles holes;
    holes.diameter = cutting.dowel_diameter;
    const double top = cutting.dowel_height > 0 ? job.z0() + cutting.dowel_height : job.bounds.hi.z + 1;
    holes.height = {job.z0() - 1, top};
    const int layers = layers_of(job, cutting.dowel_height);
    if (layers == 0) {
        throw InputError(
            fmt::format("printer.dowel_height / --printer-dowel-height: {} mm does not reach the middle of "
                        "the first layer; "
                        "accepted: more than {} mm, or 0 for the whole part",
                        cutting.dowel_height, job.layers.middle(0)));
    }
    holes.at = places_of(cutting);
    ClearSurvey survey(cutting.dowel_diameter / 2 + cutting.dowel_margin, recipe.printer.vector.tolerance,
                       holes.at);
    Job lower = job;
    lower.layers = job.layers.lowest(layers);
    survey_layers(lower, survey, {});
    if (!holes.at.empty()) return holes;
    if (survey.closed() < 0) {
        const Rect bounds = job.bounds.rect();
        holes.at = dowel_places(survey.clear(), bounds.center(), cutting.dowels, cutting.dowel_diameter);
    }
    if (holes.at.empty()) {
        const std::string why =
            survey.closed() >= 0
                ? fmt::format("no place lies inside all layers up to layer {}, which begins at {:.4g} mm",
                              survey.closed(), job.layers.bottom(survey.closed()))
                : fmt::format("the area common to all layers is too small for {} holes", cutting.dowels);
        throw InputError(fmt::format(
            "printer.dowels / --printer-dowels: {}, with holes of {} mm and a margin of {} mm; accepted: a "
            "smaller dowel_height, a smaller dowel_diameter or dowel_margin, or no dowels",
            why, cutting.dowel_diameter, cutting.dowel_margin));
    }
    return holes;
}

FieldPtr without_dowels(FieldPtr solid, const DowelHoles& holes) {
    std::vector<FieldPtr> pins;
    for (const dvec2& p : holes.at) {
        pins.push_back(
            make_cylinder({p.x, p.y, holes.height.lo}, {p.x, p.y, holes.height.hi}, holes.diameter / 2));
    }
    return make_difference(std::move(solid), make_union(std::move(pins)));
}

nlohmann::ordered_json dowels_json(const DowelHoles& holes) {
    auto at = nlohmann::ordered_json::array();
    for (const dvec2& p : holes.at) at.push_back({p.x, p.y});
    return {{"diameter_mm", holes.diameter}, {"at_mm", std::move(at)}};
}

std::string dowels_text(const DowelHoles& holes) {
    std::string text = fmt::format("{} holes of {} mm at", holes.at.size(), holes.diameter);
    for (const dvec2& p : holes.at)
        text += fmt::format("{} ({:.2f}, {:.2f})", &p == &holes.at.front() ? "" : ",", p.x, p.y);
    return text + " mm";
}

}  // namespace lamella
