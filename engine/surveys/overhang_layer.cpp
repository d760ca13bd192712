// SurveyedLayer: rows, dilated rows, pieces and sampled outlines of one layer.
#include "engine/surveys/overhang_layer.h"

#include "engine/surveys/overhang_survey.h"

namespace lamella {
namespace {

constexpr int rows_per_band = 64;  // a band's runs stay in the cache

RunRows all_rows(const Layer& layer, RowBand band) {
    RunRows all, some;
    const int count = band.count;
    for (band.first = 0; band.first < count; band.first += rows_per_band) {
        band.count = std::min(rows_per_band, count - band.first);
        layer.runs(band, some);
        all.append_lines(some);
    }
    return all;
}

/// Dilates rows by a disc about each point of a row. The radius is in rows.
RunRows grown_by_disc(const RunRows& rows, double radius) {
    const int reach = static_cast<int>(radius);
    std::vector<std::int32_t> widths;
    for (int k = 0; k <= reach; ++k)
        widths.push_back(round_run(run_unit * std::sqrt(radius * radius - k * k)));
    RunRows out;
    std::vector<Run> line;
    const auto begins_first = [](const Run& a, const Run& b) { return a.begin < b.begin; };
    const int count = static_cast<int>(rows.lines());
    for (int r = 0; r < count; ++r) {
        line.clear();
        for (int k = std::max(-reach, -r); k <= std::min(reach, count - 1 - r); ++k) {
            const std::int32_t width = widths[static_cast<std::size_t>(std::abs(k))];
            const int near = r + k;
            const auto sorted = static_cast<std::ptrdiff_t>(line.size());
            for (const Run& run : rows.line(static_cast<std::size_t>(near))) {
                line.push_back({run.begin - width, run.end + width});
            }
            std::inplace_merge(line.begin(), line.begin() + sorted, line.end(), begins_first);
        }
        for (const Run& run : line) out.push(run.begin, run.end);
        out.end_line();
    }
    return out;
}

std::vector<LayerPiece> measure(const SurveyedLayer& layer, const RowBand& band) {
    std::vector<LayerPiece> pieces(layer.labelled.components.size());
    std::size_t i = 0;
    for (std::size_t l = 0; l < layer.rows.lines(); ++l) {
        const double y = band.line(static_cast<int>(l));
        for (const Run& run : layer.rows.line(l)) {
            LayerPiece& piece = pieces[layer.labelled.owners[i++]];
            const double length = (static_cast<double>(run.end) - run.begin) / run_unit * band.along_pitch;
            const double area = length * band.across_pitch;
            piece.area += area;
            piece.moment += area * dvec2(band.along(0.5 * (static_cast<double>(run.begin) + run.end)), y);
        }
    }
    return pieces;
}

void sample_outline(const Contour& contour, double most, SurveyedLayer& layer) {
    constexpr int min_samples = 4;
    const auto& points = contour.points;
    const std::size_t n = points.size();
    double perimeter = 0;
    for (std::size_t k = 0; k < n; ++k) perimeter += length(points[(k + 1) % n] - points[k]);
    if (!(perimeter > 0)) return;
    OutlinePath path;
    path.first = layer.samples.size();
    path.count = static_cast<std::size_t>(std::max(std::ceil(perimeter / most), double(min_samples)));
    path.step = perimeter / static_cast<double>(path.count);
    double walked = 0;  // at the end of the edge before
    std::size_t next = 0;
    for (std::size_t k = 0; k < n && next < path.count; ++k) {
        const dvec2 a = points[k], edge = points[(k + 1) % n] - a;
        const double edge_length = length(edge);
        if (edge_length == 0) continue;
        const dvec2 along = edge / edge_length;
        for (double at = 0; next < path.count; ++next) {
            at = static_cast<double>(next) * path.step - walked;
            if (at >= edge_length) break;
            layer.samples.push_back({a + along * at, {-along.y, along.x}});
        }
        walked += edge_length;
    }
    // Rounding may move the last sample to the path's end, which is its first sample; it is dropped then.
    path.count = layer.samples.size() - path.first;
    layer.paths.push_back(path);
}

void find_piece(OutlinePath& path, const SurveyedLayer& layer, const SurveyResolution& by) {
    constexpr std::size_t tries = 8;  // a blade thinner than a row may meet a row elsewhere on the path
    const std::size_t stride = std::max<std::size_t>(1, path.count / tries);
    for (std::size_t k = 0; k < path.count && path.piece == no_piece; k += stride) {
        path.piece = layer.piece_at(layer.bead(layer.samples[path.first + k], by.width), by.band);
    }
}

}  // namespace

SurveyResolution::SurveyResolution(const Job& job, const OverhangLimits& limits)
    : tolerance(std::min(limits.width / 8, limits.overhang / 2)),
      step(limits.width / 2),
      width(limits.width),
      overhang(limits.overhang),
      growth(0) {
    // Rows at most twice the overhang apart tell inside from outside wherever no border is near.
    const double pitch = std::min(std::max(limits.width / 4, limits.overhang / 8), limits.overhang);
    const dvec3 size = job.bounds.size();
    band.along_origin = job.bounds.lo.x;
    band.across_origin = job.bounds.lo.y;
    band.along_pitch = band.across_pitch = pitch;
    band.count = static_cast<int>(size.y / pitch) + 1;
    band.hi = static_cast<int>(size.x / pitch) + 1;
    // Sampled by rows, the border may seem up to a pitch farther in. That must not make carried regions hang.
    growth = overhang + pitch;
}

double SurveyedLayer::stand_out(dvec2 p, const SurveyResolution& by) const {
    if (rows.lines() == 0) return infinity;
    if (const auto near = border.distance(p, by.overhang)) return *near;
    const double row = std::floor((p.y - by.band.across_origin) / by.band.across_pitch);
    if (row < 0 || row >= static_cast<double>(rows.lines())) return infinity;
    const double u = by.band.coordinate(p.x);
    for (const Run& run : rows.line(static_cast<std::size_t>(row))) {
        if (run.begin <= u && u < run.end) return -infinity;
    }
    return infinity;
}

std::uint32_t SurveyedLayer::piece_at(dvec2 p, const RowBand& band) const {
    const int row = static_cast<int>(std::floor((p.y - band.across_origin) / band.across_pitch));
    const double u = band.coordinate(p.x);
    std::uint32_t nearest = no_piece;
    double least = 2.0 * run_unit;  // at most a row and a pixel away
    for (int r = row - 1; r <= row + 1; ++r) {
        const double away = r == row ? 0 : run_unit;
        for (const LabelledRun& run : labelled.row(r)) {
            const double gap = std::max({run.begin - u, u - run.end, 0.0}) + away;
            if (gap < least) {
                least = gap;
                nearest = run.component;
            }
        }
    }
    return nearest;
}

dvec2 SurveyedLayer::middle(std::uint32_t piece, const RowBand& band) const {
    const LayerPiece& whole = pieces[piece];
    const dvec2 center = whole.moment / whole.area;
    dvec2 nearest(0);
    double least = infinity;
    const ComponentExtent& extent = labelled.components[piece];
    for (int r = extent.first_row; r <= extent.last_row; ++r) {
        const double y = band.line(r);
        for (const LabelledRun& run : labelled.row(r)) {
            if (run.component != piece) continue;
            const double x = std::min(std::max(center.x, band.along(run.begin)), band.along(run.end));
            const double away = length(dvec2(x, y) - center);
            if (away < least) {
                least = away;
                nearest = {x, y};
            }
        }
    }
    return nearest;
}

dvec2 SurveyedLayer::bead(const OutlineSample& sample, double width) const {
    return sample.at + sample.inward * (border.way_through(sample.at, sample.inward, width) / 2);
}

std::unique_ptr<SurveyedLayer> survey_layer(const Layer& layer, const SurveyResolution& by) {
    auto product = std::make_unique<SurveyedLayer>();
    product->rows = all_rows(layer, by.band);
    product->grown = grown_by_disc(product->rows, by.growth / by.band.across_pitch);
    product->labelled = label_layer(product->rows, layer.index(), Growth{});
    product->pieces = measure(*product, by.band);
    for (const LayerPiece& piece : product->pieces) product->area += piece.area;
    const std::vector<Contour> contours = layer.contours(by.tolerance);
    constexpr double min_cell = 1;  // mm; outlines are made of edges about as long
    product->border = ContourIndex(contours, std::max(min_cell, 2 * by.overhang));
    for (const Contour& contour : contours) sample_outline(contour, by.step, *product);
    for (OutlinePath& path : product->paths) find_piece(path, *product, by);
    return product;
}

}  // namespace lamella
