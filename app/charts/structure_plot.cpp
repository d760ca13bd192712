// Two panels of SVG: polylines over the steps, and rectangles of the shape's columns.
#include "app/charts/structure_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/charts/svg_text.h"
#include "procedural/volume/density_bricks.h"
#include "recipe/structure/structure_report.h"

namespace lamella {

namespace {

constexpr double panel_width = 520, panel_height = 420, chart_left = 70, chart_right = 60, chart_top = 50,
                 chart_bottom = 50;  // px

/// A curve over the steps with an axis of its own.
template <typename Value>
std::string curve(const StructureReport& report, Interval range, const char* colour, const Value& value) {
    const double steps = std::max(1.0, static_cast<double>(report.history.size()) - 1);
    std::string path;
    for (std::size_t i = 0; i < report.history.size(); ++i) {
        const double share = range.width() > 0 ? (value(report.history[i]) - range.lo) / range.width() : 0.5;
        path += fmt::format(
            "{}{:.1f} {:.1f}", i == 0 ? "M" : "L",
            chart_left + static_cast<double>(i) / steps * (panel_width - chart_left - chart_right),
            panel_height - chart_bottom -
                std::clamp(share, 0.0, 1.0) * (panel_height - chart_top - chart_bottom));
    }
    return fmt::format("<path class=\"line\" stroke=\"{}\" d=\"{}\"/>\n", colour, path);
}

std::string chart(const StructureReport& report) {
    if (report.history.empty()) return "";  // stopped before the first step
    const bool has_picture = report.appearance > 0;
    const auto aim = [&](const OptimizationStep& step) {
        return has_picture ? step.appearance : step.compliance;
    };
    // The first steps from grey would press all others to the bottom.
    std::vector<double> values;
    for (const OptimizationStep& step : report.history) values.push_back(aim(step));
    std::ranges::sort(values);
    const double median = values[values.size() / 2];
    const Interval range{0, std::min(values.back(), 3 * median)};
    std::string text;
    constexpr int lines = 4;
    for (int i = 0; i <= lines; ++i) {
        const double share = static_cast<double>(i) / lines;
        const double y = panel_height - chart_bottom - share * (panel_height - chart_top - chart_bottom);
        text += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", chart_left, y,
                            panel_width - chart_right);
        text += svg_label(chart_left - 6, y + 4, fmt::format("{:.3g}", range.lo + share * range.width()),
                          "text-anchor=\"end\" fill=\"#20639b\"");
        text += svg_label(panel_width - chart_right + 6, y + 4, fmt::format("{:.0f} %", 100 * share),
                          "fill=\"#d98a00\"");
    }
    text += curve(report, {0, 1}, "#d98a00", [](const OptimizationStep& step) { return step.volume; });
    text += curve(report, {0, 1}, "#999999", [](const OptimizationStep& step) { return step.greyness; });
    text += curve(report, range, "#20639b", aim);
    const double y = panel_height - 14;
    text += svg_label(chart_left, y, has_picture ? "difference from the picture" : "compliance, N mm",
                      "fill=\"#20639b\"");
    text += svg_label(chart_left + 190, y, "volume", "fill=\"#d98a00\"");
    text += svg_label(chart_left + 250, y, "greyness", "fill=\"#777\"");
    text += svg_label(panel_width - chart_right, y, fmt::format("{} steps", report.history.size()),
                      "text-anchor=\"end\"");
    return text;
}

/// Where points of the part lie on the second panel.
struct View {
    Box box;
    int up = 1;  ///< axis that points upward: y of a plate, z of a solid
    double scale = 1;
    dvec2 origin{0};

    View(const Box& shown, int dimensions) : box(shown), up(dimensions == 2 ? 1 : 2) {
        constexpr double margin = 40;
        scale = std::min((panel_width - 2 * margin) / box.size().x,
                         (panel_height - chart_top - margin) / box.size()[up]);
        origin = {1.5 * panel_width - 0.5 * scale * box.size().x,
                  0.5 * (panel_height + chart_top) + 0.5 * scale * box.size()[up]};
    }
    dvec2 at(dvec3 p) const {
        return {origin.x + scale * (p.x - box.lo.x), origin.y - scale * (p[up] - box.lo[up])};
    }
};

/// How solid a column along the line of sight is, as a share of the most solid one possible.
class Columns {
  public:
    Columns(const OptimizedPart& part, bool is_foam)
        : densities_(*part.densities), use_(part.use), is_foam_(is_foam) {
        if (is_foam) densest_ = std::max(1e-9, static_cast<double>(std::ranges::max(densities_.samples())));
    }
    int columns() const { return static_cast<int>(densities_.size()[0]); }
    int rows() const { return static_cast<int>(densities_.size()[is_plate() ? 1 : 2]); }
    double share(int column, int row) const {
        const std::size_t depth = is_plate() ? 1 : densities_.size()[1];
        const auto x = static_cast<std::size_t>(column), along = static_cast<std::size_t>(row);
        double sum = 0;
        for (std::size_t k = 0; k < depth; ++k)
            sum += is_plate() ? solid_share(x, along, 0) : solid_share(x, k, along);
        return sum / static_cast<double>(depth);
    }

  private:
    bool is_plate() const { return densities_.size()[2] == 1; }
    double solid_share(std::size_t x, std::size_t y, std::size_t z) const {
        const VoxelIndex& size = densities_.size();
        if (use_[(z * size[1] + y) * size[0] + x] == ElementUse::outside) return 0;
        constexpr double solid = 0.5;
        const auto density = static_cast<double>(densities_.at(x, y, z));
        return is_foam_ ? density / densest_ : density > solid ? 1 : 0;
    }

    const DensityBricks& densities_;
    const std::vector<ElementUse>& use_;
    bool is_foam_;
    double densest_ = 1;
};

std::string shape(const View& view, const Columns& columns) {
    const double width = view.scale * view.box.size().x / columns.columns(),
                 height = view.scale * view.box.size()[view.up] / columns.rows();
    constexpr int tones = 12;
    std::string text = "<g shape-rendering=\"crispEdges\">\n";
    for (int row = 0; row < columns.rows(); ++row) {
        int tone = 0, from = 0;
        const auto end = [&](int x) {
            if (tone > 0) {
                const int light = 225 - tone * 150 / tones;
                text += fmt::format(
                    "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
                    "fill=\"#{:02x}{:02x}{:02x}\"/>\n",
                    view.origin.x + from * width, view.origin.y - (row + 1) * height, (x - from) * width,
                    height, light - 10, light, light + 15);
            }
            from = x;
        };
        for (int x = 0; x < columns.columns(); ++x) {
            const int now = static_cast<int>(std::ceil(columns.share(x, row) * tones - 1e-9));
            if (now == tone) continue;
            end(x);
            tone = now;
        }
        end(columns.columns());
    }
    return text + "</g>\n";
}

/// Calls visit(item) for at most so many items of a list, evenly spread.
template <typename Item, typename Visit>
void for_some(const std::vector<Item>& items, std::size_t most, const Visit& visit) {
    const std::size_t count = std::min(items.size(), most);
    for (std::size_t i = 0; i < count; ++i) visit(items[(2 * i + 1) * items.size() / (2 * count)]);
}

std::string holds(const View& view, const StructureReport& report) {
    std::string text;
    for_some(report.held, 60, [&](const dvec3& p) {
        const dvec2 at = view.at(p);
        text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"#2e8b57\"/>\n", at.x, at.y);
    });
    for_some(report.loaded, 12, [&](const NodeForce& load) {
        constexpr double length = 34, head = 5;
        const dvec2 at = view.at(load.at);
        const dvec2 along(load.force.x, -load.force[view.up]);
        const double size = glm::length(along);
        if (size == 0) return;  // along the line of sight
        const dvec2 way = along / size, across(-way.y, way.x), back = at - head * way;
        text += fmt::format("<path class=\"line\" stroke=\"#c0392b\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n",
                            at.x - length * way.x, at.y - length * way.y, back.x, back.y);
        text += fmt::format(
            "<polygon fill=\"#c0392b\" points=\"{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}\"/>\n", at.x, at.y,
            back.x - head * way.x + head * across.x, back.y - head * way.y + head * across.y,
            back.x - head * way.x - head * across.x, back.y - head * way.y - head * across.y);
    });
    return text;
}

}  // namespace

std::string structure_svg(const std::string& title, const OptimizedPart& part, bool is_foam) {
    const StructureReport& report = *part.report;
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" viewBox=\"0 0 {0:g} "
        "{1:g}\">\n<style>text{{font:13px sans-serif}}.grid{{stroke:#ddd;fill:none}}.line{{fill:none;"
        "stroke-width:1.8}}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        2 * panel_width, panel_height);
    text += svg_label(chart_left, 26, svg_escaped(title), "style=\"font-weight:bold\"");
    text += chart(report);
    const View view(part.densities->box(), report.dimensions);
    text +=
        svg_label(1.5 * panel_width, 26,
                  fmt::format("{:.4g} N mm, {:.1f} % of the part", report.compliance, 100 * report.volume),
                  "text-anchor=\"middle\"");
    return text + shape(view, Columns(part, is_foam)) + holds(view, report) + "</svg>\n";
}

}  // namespace lamella
