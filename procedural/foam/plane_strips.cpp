// Fills strips on demand, and assigns a band's lines to strips.
#include "procedural/foam/plane_strips.h"

#include "engine/field/slice_context.h"

namespace lamella {

PlaneStrips::PlaneStrips(const Field& field, Query meeting, const Rect& region, int strips, double z)
    : SampledSlice(field, z),
      meeting_(std::move(meeting)),
      region_(region),
      z_(z),
      height_(region.size().y / strips),
      strips_(static_cast<std::size_t>(strips)) {}

const PlaneStrips::Rows& PlaneStrips::open(std::size_t strip) const {
    Strip& opened = strips_[strip];
    std::call_once(opened.opened, [&] {
        const auto at = static_cast<double>(strip);
        const bool last = strip + 1 == strips_.size();
        const Rect rect{{region_.lo.x, region_.lo.y + height_ * at},
                        {region_.hi.x, last ? region_.hi.y : region_.lo.y + height_ * (at + 1)}};
        const PlanePieces pieces = meeting_(strip, rect);
        opened.rows =
            std::make_unique<const Rows>(Rows{BeamRows(pieces.beams, z_), WedgeRows(pieces.walls, z_)});
    });
    return *opened.rows;
}

std::size_t PlaneStrips::strip_of(double y) const {
    const double at = std::floor((y - region_.lo.y) / height_);
    return static_cast<std::size_t>(std::min(std::max(at, 0.0), static_cast<double>(strips_.size() - 1)));
}

void PlaneStrips::runs(const RowBand& band, Scratch& scratch, RunRows& out) const {
    RunCollector& runs = scratch.collector;
    runs.clear();
    const auto collect = [&](const Rows& rows, const LineRange& lines) {
        rows.beams.collect(band, lines, runs);
        rows.walls.collect(band, lines, runs);
    };
    if (band.axis == Axis::y || strips_.size() == 1) {
        for (std::size_t strip = 0; strip < strips_.size(); ++strip) collect(open(strip), {0, band.lines()});
    } else {
        // Each line belongs to one strip, whatever band it is in.
        for (int first = 0, last = 0; first < band.lines(); first = last) {
            const std::size_t strip = strip_of(band.line(first));
            while (last < band.lines() && strip_of(band.line(last)) == strip) ++last;
            collect(open(strip), {first, last});
        }
    }
    runs.merge(band, out);
}

}  // namespace lamella
