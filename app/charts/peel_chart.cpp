// Two panels above each other that share the axis of heights.
#include "app/charts/peel_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "app/charts/svg_text.h"

namespace lamella {

namespace {

/// Sizes of the chart, px.
struct ChartSize {
    static constexpr double width = 760, left = 64, right = 748, panel = 150, gap = 34, top = 24;
};

/// A panel: its upper side, and where the values of its axis lie, 0 (below) to 1.
struct Panel {
    double y0;
    std::function<double(double)> share;

    double y(double value) const { return y0 + ChartSize::panel * (1 - std::clamp(share(value), 0.0, 1.0)); }
};

/// The horizontal axis: heights over the plate, mm.
struct HeightAxis {
    double height;
    double x(double z) const { return ChartSize::left + z / height * (ChartSize::right - ChartSize::left); }
};

/// Returns the smallest number of the form 1, 2 or 5 times a power of ten that is at least this.
double round_up(double least) {
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (digit * power >= least * (1 - 1e-9)) return digit * power;
    return 10 * power;
}

std::string level(const Panel& panel, double value, const char* style) {
    return fmt::format("<path {} d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", style, ChartSize::left, panel.y(value),
                       ChartSize::right) +
           svg_label(ChartSize::left - 6, panel.y(value) + 4, fmt::format("{:g}", value),
                     "text-anchor=\"end\"");
}

/// Draws a step for each value, from layer to layer.
std::string steps(const Panel& panel, const HeightAxis& axis, const LayerCurve& curve,
                  const LayerPlan& layers, const char* style) {
    std::string path = fmt::format("M{:.1f} {:.1f}", axis.x(0), panel.y0 + ChartSize::panel);
    int layer = 0;
    for (const double value : curve.values()) {
        layer = std::min(layer + curve.layers_each(), layers.count());
        path += fmt::format("V{:.1f}H{:.1f}", panel.y(value), axis.x(layers.bottom(layer)));
    }
    return fmt::format("<path {} d=\"{}V{:.1f}Z\"/>\n", style, path, panel.y0 + ChartSize::panel);
}

double greatest(const LayerCurve& curve) {
    return curve.values().empty() ? 0 : *std::ranges::max_element(curve.values());
}

std::string heights(const HeightAxis& axis, double y) {
    const double apart = round_up(axis.height / 8);
    std::string text;
    for (int i = 0; i * apart <= axis.height * (1 + 1e-9); ++i)
        text +=
            svg_label(axis.x(i * apart), y + 16, fmt::format("{:g}", i * apart), "text-anchor=\"middle\"");
    return text + svg_label((ChartSize::left + ChartSize::right) / 2, y + 34, "height over the plate, mm",
                            "text-anchor=\"middle\"");
}

}  // namespace

std::string peel_chart(const PeelCurve& curve, double limit, const LayerPlan& layers) {
    constexpr const char* grid = "stroke=\"#dde3ea\" fill=\"none\"";
    const HeightAxis axis{layers.bottom(layers.count())};
    const double most = round_up(std::max(greatest(curve.area), 1e-3));
    const double powers = std::ceil(std::log10(std::max({greatest(curve.load), limit, 10.0})) - 1e-9);
    const Panel areas{ChartSize::top, [most](double area) { return area / most; }};
    const Panel loads{ChartSize::top + ChartSize::panel + ChartSize::gap,
                      [powers](double factor) { return factor <= 1 ? 0 : std::log10(factor) / powers; }};
    const double bottom = loads.y0 + ChartSize::panel;
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\" "
        "font-family=\"system-ui,sans-serif\" font-size=\"13\" "
        "fill=\"#1d2733\" aria-label=\"area and load of each layer\">\n",
        ChartSize::width, bottom + 40);
    text += svg_label(ChartSize::left, areas.y0 - 8, "area of the layer, mm2");
    for (int i = 0; i <= 2; ++i) text += level(areas, most * i / 2, grid);
    text += steps(areas, axis, curve.area, layers, "fill=\"#99a6b3\"");
    text += svg_label(ChartSize::left, loads.y0 - 8, "area pulled over the area that holds it");
    for (int power = 0; power <= static_cast<int>(powers); ++power)
        text += level(loads, std::pow(10.0, power), grid);
    text += steps(loads, axis, curve.load, layers, "fill=\"#598fcc\"");
    text += level(loads, limit, "stroke=\"#d91c1c\" stroke-dasharray=\"6 4\" fill=\"none\"");
    return text + heights(axis, bottom) + "</svg>\n";
}

}  // namespace lamella
