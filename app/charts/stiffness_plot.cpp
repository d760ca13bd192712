// Draws lines on logarithmic axes, and a surface of small quadrilaterals sorted back to front.
#include "app/charts/stiffness_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/charts/svg_text.h"

namespace lamella {

namespace {

constexpr double panel = 480, left = 78, top = 46, bottom = 56, right = 18;  // px

/// The logarithmic axes of the chart: density and modulus.
struct Axes {
    double min_density = -2;  ///< powers of ten
    double min_young, max_young;

    double x(double density) const {
        return left + (std::log10(density) - min_density) / -min_density * (panel - left - right);
    }
    double y(double young) const {
        return panel - bottom -
               (std::log10(young) - min_young) / (max_young - min_young) * (panel - top - bottom);
    }
};

std::string grid(const Axes& axes) {
    std::string text;
    const double x0 = left, x1 = panel - right, y0 = panel - bottom, y1 = top;
    for (int power = static_cast<int>(axes.min_density); power <= 0; ++power) {
        const double x = axes.x(std::pow(10.0, power));
        text += fmt::format("<path class=\"grid\" d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/>\n", x, y0, y1);
        text += svg_label(x, y0 + 18, fmt::format("{:g} %", 100 * std::pow(10.0, power)),
                          "text-anchor=\"middle\"");
    }
    for (int power = static_cast<int>(axes.min_young); power <= static_cast<int>(axes.max_young); ++power) {
        const double y = axes.y(std::pow(10.0, power));
        text += fmt::format("<path class=\"grid\" d=\"M{0:.1f} {1:.1f}H{2:.1f}\"/>\n", x0, y, x1);
        text += svg_label(x0 - 6, y + 4, fmt::format("{:g}", std::pow(10.0, power)), "text-anchor=\"end\"");
    }
    text += svg_label((x0 + x1) / 2, panel - 14, "density, of the solid's", "text-anchor=\"middle\"");
    text += fmt::format(
        "<text transform=\"translate(16 {:.1f}) rotate(-90)\" text-anchor=\"middle\">E, MPa</text>\n",
        (y0 + y1) / 2);
    return text;
}

/// Draws a curve of moduli over densities from the minimum to 1.
template <typename Young>
std::string curve(const Axes& axes, const char* colour, const Young& young_of_density) {
    constexpr int steps = 60;
    std::string path;
    for (int i = 0; i <= steps; ++i) {
        const double density = std::pow(10.0, axes.min_density * (1 - static_cast<double>(i) / steps));
        path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", axes.x(density),
                            axes.y(young_of_density(density)));
    }
    return fmt::format("<path class=\"line\" stroke=\"{}\" d=\"{}\"/>\n", colour, path);
}

std::string law_curve(const Axes& axes, const StiffnessPlot& plot) {
    std::string path, dots;
    for (const FoamLawPoint& point : plot.law) {
        const double young = point.young * plot.material.young, x = axes.x(point.density);
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, axes.y(young));
        dots +=
            fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"#20639b\"/>\n", x, axes.y(young));
        const double spread = std::min(2 * point.spread, 0.9);
        if (spread > 0) {
            dots += fmt::format("<path class=\"line\" stroke=\"#20639b\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>\n", x,
                                axes.y(young * (1 - spread)), axes.y(young * (1 + spread)));
        }
    }
    return fmt::format("<path class=\"line\" stroke=\"#20639b\" d=\"{}\"/>\n", path) + dots;
}

std::string legend(const StiffnessPlot& plot) {
    std::string text;
    double y = top + 16;
    const auto entry = [&](const char* colour, const std::string& words) {
        text += fmt::format("<path class=\"line\" stroke=\"{}\" d=\"M{:.1f} {:.1f}h18\"/>\n", colour,
                            left + 10, y - 4);
        text += svg_label(left + 34, y, words);
        y += 17;
    };
    entry("#888888", "Voigt: no structure is stiffer");
    entry("#d98a00", "Hashin, Shtrikman: no isotropic one is");
    if (!plot.law.empty()) entry("#20639b", "the foam's law");
    if (plot.sample)
        entry("#c0392b", fmt::format("this foam: {:.3g} MPa, {:.3g} % solid", plot.sample->young,
                                     100 * plot.sample->density));
    return text;
}

std::string chart(const StiffnessPlot& plot) {
    Axes axes{-2, 0, 0};
    double min_young = plot.material.young * 1e-2, min_density = 1e-2;
    const auto consider = [&](double density, double young) {
        min_young = std::min(min_young, young);
        min_density = std::min(min_density, density);
    };
    for (const FoamLawPoint& point : plot.law) consider(point.density, point.young * plot.material.young);
    if (plot.sample) consider(plot.sample->density, plot.sample->young);
    axes.min_density = std::floor(std::log10(min_density) + 1e-9);
    axes.min_young = std::floor(std::log10(min_young));
    axes.max_young = std::ceil(std::log10(plot.material.young) - 1e-9);
    std::string text = grid(axes);
    text += curve(axes, "#888888", [&](double density) { return density * plot.material.young; });
    text += curve(axes, "#d98a00",
                  [&](double density) { return hashin_shtrikman(plot.material, density).young; });
    if (!plot.law.empty()) text += law_curve(axes, plot);
    if (plot.sample) {
        text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"#c0392b\"/>\n",
                            axes.x(plot.sample->density), axes.y(plot.sample->young));
    }
    return text + legend(plot);
}

struct Facet {
    std::array<dvec2, 4> corners;
    double depth, young, light;
};

/// Returns the facets of the surface, seen from the front, the right and above; its greatest modulus is
/// scaled to 1.
std::vector<Facet> facets_of(const ElasticTensor& compliance, double most) {
    constexpr int rings = 36, around = 72;
    const dvec3 towards = glm::normalize(dvec3(0.55, -0.75, 0.45));  // direction of the eye
    const dvec3 across = glm::normalize(glm::cross(dvec3(0, 0, 1), towards)),
                up = glm::cross(towards, across);
    const auto place = [&](int ring, int turn) {
        const double polar = std::numbers::pi * ring / rings, angle = 2 * std::numbers::pi * turn / around;
        const dvec3 n{std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)};
        return n * (directional_modulus(compliance, n) / most);
    };
    std::vector<Facet> facets;
    for (int ring = 0; ring < rings; ++ring) {
        for (int turn = 0; turn < around; ++turn) {
            const std::array<dvec3, 4> corners{place(ring, turn), place(ring + 1, turn),
                                               place(ring + 1, turn + 1), place(ring, turn + 1)};
            Facet facet{};
            dvec3 middle(0);
            for (std::size_t i = 0; i < 4; ++i) {
                facet.corners[i] = {glm::dot(corners[i], across), glm::dot(corners[i], up)};
                middle += corners[i] * 0.25;
            }
            const dvec3 normal = glm::cross(corners[2] - corners[0], corners[3] - corners[1]);
            const double length = glm::length(normal);
            facet.light = length > 0 ? 0.55 + 0.45 * std::abs(glm::dot(normal / length, towards)) : 1;
            facet.depth = glm::dot(middle, towards);
            facet.young = glm::length(middle) * most;
            facets.push_back(facet);
        }
    }
    std::ranges::stable_sort(facets, {}, &Facet::depth);
    return facets;
}

std::string surface(const StiffnessPlot::Sample& sample) {
    const ElasticTensor compliance = compliance_of(sample.stiffness);
    const Interval moduli = directional_moduli(compliance);
    const double radius = 0.36 * panel, x = panel * 1.5, y = panel * 0.52;
    std::string text;
    for (const Facet& facet : facets_of(compliance, moduli.hi)) {
        std::string points;
        for (const dvec2& corner : facet.corners)
            points += fmt::format("{:.1f},{:.1f} ", x + radius * corner.x, y - radius * corner.y);
        const double share = moduli.hi > moduli.lo * 1.001 ? (facet.young - moduli.lo) / moduli.width() : 0.5;
        const auto tone = [&](double low, double high) {
            return static_cast<int>(
                std::lround(facet.light * (low + std::clamp(share, 0.0, 1.0) * (high - low))));
        };
        const std::string colour =
            fmt::format("#{:02x}{:02x}{:02x}", tone(54, 250), tone(96, 196), tone(160, 60));
        text += fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"{}\"/>\n", points, colour, colour);
    }
    text += svg_label(x, top + 16, "Young's modulus to all sides", "text-anchor=\"middle\"");
    text +=
        svg_label(x, panel - 32, fmt::format("{:.4g} (blue) to {:.4g} MPa (yellow)", moduli.lo, moduli.hi),
                  "text-anchor=\"middle\"");
    text +=
        svg_label(x, panel - 14, fmt::format("{:.2g} % from isotropic", 100 * anisotropy(sample.stiffness)),
                  "text-anchor=\"middle\"");
    return text;
}

}  // namespace

std::string stiffness_svg(const StiffnessPlot& plot) {
    const double width = plot.sample ? 2 * panel : panel;
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" viewBox=\"0 0 {0:g} "
        "{1:g}\">\n"
        "<style>text{{font:13px sans-serif;fill:#222}}.grid{{stroke:#ddd;fill:none}}.line{{fill:none;"
        "stroke-width:1.6}}polygon{{stroke-width:.4}}</style>\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"white\"/>\n",
        width, panel);
    text += svg_label(left, 26, svg_escaped(plot.title), "style=\"font-weight:bold\"");
    text += chart(plot);
    if (plot.sample) text += surface(*plot.sample);
    return text + "</svg>\n";
}

}  // namespace lamella
