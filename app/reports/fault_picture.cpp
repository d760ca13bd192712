// Sections are painted in layers of colour; side views are rendered from blocks of layers.
#include "app/reports/fault_picture.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/reports/layer_block.h"
#include "recipe/output/preview_render.h"

namespace lamella {
namespace {

constexpr dvec3 paper{1, 1, 1};
constexpr dvec3 below_colour{0.89, 0.91, 0.93};
constexpr dvec3 part_colour{0.60, 0.65, 0.70};
constexpr dvec3 support_colour{0.35, 0.56, 0.80};
constexpr dvec3 fault_colour{0.85, 0.11, 0.11};
constexpr double fault_opacity = 0.8;  // colours below show through

/// A picture being painted: colours from 0 to 1.
class Canvas {
  public:
    Canvas(const Rect& shown, int width) : shown_(shown), empty_(shown, width) {
        colours_.assign(static_cast<std::size_t>(empty_.width()) * static_cast<std::size_t>(empty_.height()),
                        paper);
    }

    /// Paint a slice, or runs of another band, over the picture.
    void paint(const SliceField& slice, dvec3 colour) {
        RunCoverage shares = empty_;
        shares.add(slice);
        blend(shares, colour, 1);
    }
    void paint(std::span<const PlacedRun> runs, const RowBand& band, dvec3 colour, double opacity) {
        RunCoverage shares = empty_;
        shares.add(runs, band);
        blend(shares, colour, opacity);
    }

    SectionPicture finish() const {
        const int width = empty_.width(), height = empty_.height();
        SectionPicture done{{width, height, {}}, shown_, empty_.pixel()};
        done.picture.rgb.reserve(colours_.size() * 3);
        for (const dvec3& colour : colours_) {
            for (int k = 0; k < 3; ++k)
                done.picture.rgb.push_back(static_cast<std::uint8_t>(std::lround(colour[k] * 255)));
        }
        return done;
    }

  private:
    /// Picture rows go down, coverage rows go up.
    void blend(const RunCoverage& shares, dvec3 colour, double opacity) {
        std::size_t pixel = 0;
        for (int row = shares.height(); row-- > 0;) {
            for (int column = 0; column < shares.width(); ++column, ++pixel) {
                const double share = shares.at(column, row) * opacity;
                colours_[pixel] = colours_[pixel] * (1 - share) + colour * share;
            }
        }
    }

    Rect shown_;
    RunCoverage empty_;
    std::vector<dvec3> colours_;
};

/// Layers in a rectangle as solids: the print, and the fault's runs in its layer, the last one.
struct Blocks {
    std::shared_ptr<const LayerBlock> printed, fault;
};

Blocks blocks_of(const Job& job, int first, const Fault& fault, const RowBand& band, const Rect& rect,
                 int width) {
    std::vector<RunCoverage> printed;
    for (int i = first; i <= fault.layer; ++i) {
        const Layer layer(job, i);
        RunCoverage& shares = printed.emplace_back(rect, width);
        shares.add(layer.part());
        if (layer.supports() != nullptr) shares.add(*layer.supports());
    }
    RunCoverage wrong(rect, width);
    wrong.add(fault.runs, band);
    printed.back().subtract(wrong);
    for (RunCoverage& shares : printed) shares.blur();
    const auto bottom = [&](int layer) { return job.z0() + job.layers.bottom(layer); };
    const dvec3 top{rect.hi, bottom(fault.layer + 1)};
    return {std::make_shared<LayerBlock>(Box{{rect.lo, bottom(first)}, top}, std::move(printed)),
            std::make_shared<LayerBlock>(Box{{rect.lo, bottom(fault.layer)}, top}, std::vector{wrong})};
}

}  // namespace

SectionPicture draw_section(const Job& job, int layer, const Rect& shown, int width,
                            std::span<const PlacedRun> fault, const RowBand& band) {
    Canvas canvas(shown, width);
    if (layer > 0) {
        const Layer below(job, layer - 1);
        canvas.paint(below.part(), below_colour);
    }
    const Layer cut(job, layer);
    canvas.paint(cut.part(), part_colour);
    if (cut.supports() != nullptr) canvas.paint(*cut.supports(), support_colour);
    canvas.paint(fault, band, fault_colour, fault_opacity);
    return canvas.finish();
}

Picture draw_fault(const Job& job, const Fault& fault, const RowBand& band, int width) {
    const Rect rect = about_fault(fault, band, job);
    const double depth = rect.size().y / 2;
    const int first = job.layers.layer_at(job.layers.bottom(fault.layer) - depth);
    const Blocks blocks = blocks_of(job, first, fault, band, rect, width / 2);
    PreviewOptions options;
    options.width = width;
    options.height = width * 3 / 4;
    options.cut = '-';
    options.elevation = 40;
    options.faults = true;
    return render_preview(blocks.printed, blocks.fault, blocks.printed->bounds(), options);
}

Rect about_fault(const Fault& fault, const RowBand& band, const Job& job) {
    constexpr double least = 6;  // mm, minimum size shown unless the part is smaller
    Rect rect;
    for (const PlacedRun& run : fault.runs) {
        for (const dvec2 corner : {on_band(band, run.begin, run.row), on_band(band, run.end, run.row + 1)}) {
            rect.lo = glm::min(rect.lo, corner);
            rect.hi = glm::max(rect.hi, corner);
        }
    }
    if (rect.empty()) rect = fault.box.rect();
    const dvec2 whole = job.bounds.size() * 1.1;
    const double width = std::max({1.6 * rect.size().x, 1.6 * rect.size().y * 4 / 3,
                                   std::min(least, std::max(whole.x, whole.y * 4 / 3))});
    const dvec2 half{width / 2, width * 3 / 8};
    return {rect.center() - half, rect.center() + half};
}

}  // namespace lamella
