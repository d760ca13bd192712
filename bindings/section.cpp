// Sections: pixels, runs and contours of a job at one height.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "bindings/combined_slice.h"
#include "bindings/handles.h"
#include "engine/contours/coverage.h"
#include "engine/solids/polygon_slice.h"

using namespace lamella;

namespace {

constexpr int rows_at_once = 64;

void set_bounds(lamella_section& section) {
    Rect box = section.part->bounds();
    if (section.supports) box = unite(box, section.supports->bounds());
    for (int axis = 0; axis < 2; ++axis) {
        section.info.lower[axis] = box.lo[axis];
        section.info.upper[axis] = box.hi[axis];
    }
}

std::unique_ptr<lamella_section> cut_at(const Job& job, double z, int layer = -1) {
    auto made = std::make_unique<lamella_section>();
    made->parts = {job.part, job.supports};
    made->context = std::make_unique<SliceContext>();
    made->part = &made->context->slice(*job.part, z);
    if (job.supports) made->supports = &made->context->slice(*job.supports, z);
    made->info.layer = layer;
    made->info.z = z;
    made->info.thickness = job.layers.height(layer >= 0 ? layer : job.layers.layer_at(z - job.z0()));
    set_bounds(*made);
    return made;
}

/// An empty slice.
const SliceField& nothing() {
    static const PolygonSlice empty({});
    return empty;
}

/// The slice that `what` selects: part, supports or both.
class Asked {
  public:
    Asked(const lamella_section& section, std::int32_t what) {
        if (what < LAMELLA_PART || what > (LAMELLA_PART | LAMELLA_SUPPORTS))
            throw BadCall(fmt::format("what: {} is neither part, nor supports, nor both", what));
        const SliceField* supports = section.supports ? section.supports : &nothing();
        if (what == LAMELLA_PART) slice_ = section.part;
        if (what == LAMELLA_SUPPORTS) slice_ = supports;
        if (slice_ == nullptr)
            slice_ =
                section.supports ? &both_.emplace(*section.part, *supports, Combine::either) : section.part;
    }
    Asked(const Asked&) = delete;
    Asked& operator=(const Asked&) = delete;
    const SliceField& operator*() const { return *slice_; }

  private:
    const SliceField* slice_ = nullptr;
    std::optional<CombinedSlice> both_;
};

/// Returns the band of `count` rows of a raster from row `first` on.
RowBand band_of(const lamella_raster& raster, int first, int count) {
    RowBand band;
    band.along_origin = raster.x;
    band.along_pitch = raster.pitch_x;
    band.across_origin = raster.y;
    band.across_pitch = raster.pitch_y;
    band.first = first;
    band.count = count;
    band.sub = std::max(raster.lines, 1);
    band.hi = raster.columns;
    return band;
}

lamella_raster raster_of(const lamella_raster* given) {
    constexpr int max_pixels = 1 << 21, max_lines = 64;
    const lamella_raster raster = taken(given, "raster");
    if (raster.columns < 1 || raster.columns > max_pixels || raster.rows < 1 || raster.rows > max_pixels)
        throw BadCall(fmt::format("raster: columns and rows must be from 1 to {}", max_pixels));
    if (raster.lines < 0 || raster.lines > max_lines)
        throw BadCall(fmt::format("raster: lines must be from 0 to {}", max_lines));
    const auto fits = [](double pitch) { return std::isfinite(pitch) && pitch != 0; };
    if (!fits(raster.pitch_x) || !fits(raster.pitch_y) || !std::isfinite(raster.x + raster.y))
        throw BadCall("raster: its place must be finite, its pitches neither 0 nor infinite");
    return raster;
}

double tolerance_of(double tolerance) {
    constexpr double least = 1e-4, most = 1e3;
    if (!(tolerance >= least && tolerance <= most))
        throw BadCall(fmt::format("tolerance: must be from {} to {} mm", least, most));
    return tolerance;
}

lamella_contours* flat(const std::vector<Contour>& contours) {
    auto made = std::make_unique<lamella_contours>();
    std::size_t count = 0;
    for (const Contour& contour : contours) count += contour.points.size();
    made->points.reserve(2 * count);
    made->first.reserve(contours.size() + 1);
    made->parents.reserve(contours.size());
    made->first.push_back(0);
    for (const Contour& contour : contours) {
        for (const dvec2& p : contour.points) {
            made->points.push_back(p.x);
            made->points.push_back(p.y);
        }
        made->first.push_back(made->points.size() / 2);
        made->parents.push_back(contour.parent);
        made->area += signed_area(contour.points);
    }
    return made.release();
}

std::vector<std::vector<dvec2>> polygons_of(const lamella_polygons* given) {
    const lamella_polygons polygons = taken(given, "inside");
    std::vector<std::vector<dvec2>> list;
    if (polygons.count == 0) return list;
    const std::size_t* first = &wanted(polygons.first, "inside: first");
    const double* points = &wanted(polygons.points, "inside: points");
    for (std::size_t i = 0; i < polygons.count; ++i) {
        if (first[i] > first[i + 1]) throw BadCall("inside: first must not fall");
        std::vector<dvec2>& polygon = list.emplace_back();
        for (std::size_t k = first[i]; k < first[i + 1]; ++k) {
            polygon.emplace_back(points[2 * k], points[2 * k + 1]);
            if (!std::isfinite(polygon.back().x + polygon.back().y))
                throw BadCall("inside: a point is not finite");
        }
    }
    return list;
}

}  // namespace

void lamella::lend_layer(const Layer& layer, lamella_section& section) {
    section.part = &layer.part();
    section.supports = layer.supports();
    section.info.layer = layer.index();
    section.info.z = layer.z();
    section.info.thickness = layer.thickness();
    set_bounds(section);
}

std::int32_t lamella_section_open(lamella_context* context, const lamella_job* job, double z,
                                  lamella_section** section) {
    return guarded(context, [&] {
        wanted(section, "section");
        if (!std::isfinite(z)) throw BadCall("z: must be finite");
        *section = cut_at(wanted(job, "job").job, z).release();
    });
}

std::int32_t lamella_section_open_layer(lamella_context* context, const lamella_job* job, std::int32_t layer,
                                        lamella_section** section) {
    return guarded(context, [&] {
        wanted(section, "section");
        const Job& cut = wanted(job, "job").job;
        if (layer < 0 || layer >= cut.layers.count()) throw BadCall("layer: the job has no such layer");
        *section = cut_at(cut, cut.plane(layer), layer).release();
    });
}

void lamella_section_destroy(lamella_section* section) { delete section; }

std::int32_t lamella_section_info_get(lamella_context* context, const lamella_section* section,
                                      lamella_section_info* info) {
    return guarded(context, [&] { hand_out(info, wanted(section, "section").info, "info"); });
}

std::int32_t lamella_section_coverage(lamella_context* context, lamella_section* section, std::int32_t what,
                                      const lamella_raster* raster, std::uint8_t* pixels,
                                      std::size_t stride) {
    return guarded(context, [&] {
        const Asked slice(wanted(section, "section"), what);
        const lamella_raster grid = raster_of(raster);
        const auto width = static_cast<std::size_t>(grid.columns);
        if (stride != 0 && stride < width) throw BadCall("stride: is less than a row of pixels");
        std::uint8_t* row = &wanted(pixels, "pixels");
        const auto lines = section->scratch.rows();
        std::vector<GreyRun> greys;
        for (int first = 0; first < grid.rows; first += rows_at_once) {
            const RowBand band = band_of(grid, first, std::min(rows_at_once, grid.rows - first));
            (*slice).runs(band, section->scratch, *lines);
            greys.clear();
            grid.lines == 0 ? threshold(band, *lines, greys) : coverage(band, *lines, greys);
            std::size_t column = 0;
            for (const GreyRun& grey : greys) {
                std::memset(row + column, grey.value, grey.length);
                column += grey.length;
                if (column < width) continue;
                row += stride == 0 ? width : stride;
                column = 0;
            }
        }
    });
}

std::int32_t lamella_section_runs(lamella_context* context, lamella_section* section, std::int32_t what,
                                  const lamella_raster* raster, lamella_runs** runs) {
    return guarded(context, [&] {
        const Asked slice(wanted(section, "section"), what);
        wanted(runs, "runs");
        const lamella_raster grid = raster_of(raster);
        auto made = std::make_unique<lamella_runs>();
        made->first.push_back(0);
        const auto lines = section->scratch.rows();
        for (int first = 0; first < grid.rows; first += rows_at_once) {
            const RowBand band = band_of(grid, first, std::min(rows_at_once, grid.rows - first));
            (*slice).runs(band, section->scratch, *lines);
            for (std::size_t l = 0; l < lines->lines(); ++l) {
                for (const Run& run : lines->line(l)) {
                    made->ends.push_back(run.begin);
                    made->ends.push_back(run.end);
                }
                made->first.push_back(made->ends.size() / 2);
            }
        }
        *runs = made.release();
    });
}

void lamella_runs_destroy(lamella_runs* runs) { delete runs; }

std::int32_t lamella_runs_view_get(lamella_context* context, const lamella_runs* runs,
                                   lamella_runs_view* view) {
    return guarded(context, [&] {
        const lamella_runs& made = wanted(runs, "runs");
        lamella_runs_view found{};
        found.line_count = made.first.size() - 1;
        found.first = made.first.data();
        found.ends = made.ends.data();
        hand_out(view, found, "view");
    });
}

std::int32_t lamella_section_contours(lamella_context* context, lamella_section* section, std::int32_t what,
                                      double tolerance, lamella_contours** contours) {
    return guarded(context, [&] {
        const Asked slice(wanted(section, "section"), what);
        wanted(contours, "contours");
        *contours = flat(trace_contours(*slice, tolerance_of(tolerance), section->scratch));
    });
}

std::int32_t lamella_section_fill(lamella_context* context, lamella_section* section, std::int32_t what,
                                  const lamella_polygons* inside, double tolerance,
                                  lamella_contours** contours) {
    return guarded(context, [&] {
        const Asked slice(wanted(section, "section"), what);
        wanted(contours, "contours");
        const PolygonSlice polygons(polygons_of(inside));
        const CombinedSlice filled(*slice, polygons, Combine::both);
        *contours = flat(trace_contours(filled, tolerance_of(tolerance), section->scratch));
    });
}

void lamella_contours_destroy(lamella_contours* contours) { delete contours; }

std::int32_t lamella_contours_view_get(lamella_context* context, const lamella_contours* contours,
                                       lamella_contours_view* view) {
    return guarded(context, [&] {
        const lamella_contours& made = wanted(contours, "contours");
        lamella_contours_view found{};
        found.count = made.parents.size();
        found.first = made.first.data();
        found.points = made.points.data();
        found.parent = made.parents.data();
        found.area = made.area;
        hand_out(view, found, "view");
    });
}
