// Crossings of each line with the section's segments, sorted and summed to winding numbers.
#include "engine/mesh/mesh_section.h"

namespace lamella {
namespace {

struct Crossing {
    std::int32_t u;
    std::int32_t turn;  ///< change of the winding number along the line
};

struct LineCrossing {
    std::uint32_t line;
    Crossing crossing;
};

/// Returns the first line of the band at or after a position across (lines counted so that their positions
/// rise).
int first_line_from(const RowBand& band, double position, bool rising) {
    int lo = 0, hi = band.lines();
    const auto line = [&](int l) { return rising ? band.line(l) : band.line(band.lines() - 1 - l); };
    // Starts from a guess by the pitch, then compares the exact positions that the runs use.
    const double guess = (position - line(0)) / std::abs(band.line_pitch());
    int l = static_cast<int>(std::min(std::max(guess, 0.0), static_cast<double>(hi)));
    while (l > lo && line(l - 1) >= position) --l;
    while (l < hi && line(l) < position) ++l;
    return l;
}

void add_crossings(const SectionSegment& s, const RowBand& band, std::vector<LineCrossing>& out) {
    const int along = band.axis == Axis::x ? 0 : 1, across = 1 - along;
    const double a = s.from[across], b = s.to[across];
    if (a == b) return;
    // A line at v is crossed where exactly one end has its coordinate >= v: min < v <= max.
    const bool rising = band.across_pitch > 0;
    const double low = std::min(a, b), high = std::max(a, b);
    int first = first_line_from(band, low, rising), last = first_line_from(band, high, rising);
    const auto line_of = [&](int l) { return rising ? l : band.lines() - 1 - l; };
    while (first < band.lines() && band.line(line_of(first)) <= low) ++first;
    while (last < band.lines() && band.line(line_of(last)) <= high) ++last;
    // A row enters the solid where the segment falls, a column where it rises: the solid is on the segment's
    // left.
    std::int32_t turn = (a > b) == (band.axis == Axis::x) ? 1 : -1;
    if (band.along_pitch < 0) turn = -turn;
    for (int l = first; l < last; ++l) {
        const int line = line_of(l);
        const double u = band.coordinate(line_crossing(s, along, band.line(line)));
        out.push_back({static_cast<std::uint32_t>(line), {round_run(u), turn}});
    }
}

}  // namespace

MeshSection::MeshSection(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles, double z) {
    std::vector<Rect> boxes;
    for (const std::uint32_t t : triangles) {
        SectionSegment s;
        if (!section_segment(mesh, t, z, s)) continue;
        segments_.push_back(s);
        boxes.push_back({glm::min(s.from, s.to), glm::max(s.from, s.to)});
    }
    boxes_ = PlaneIndex(std::move(boxes));
}

void MeshSection::runs(const RowBand& band, RunRows& out) const {
    // Segments beyond the ends of the band count too: they wind around the points in it.
    std::vector<std::uint32_t> items;
    boxes_.query(band, items);
    std::vector<LineCrossing> found;
    for (const std::uint32_t i : items) add_crossings(segments_[i], band, found);

    const auto lines = static_cast<std::size_t>(band.lines());
    std::vector<std::uint32_t> starts(lines + 1, 0);
    for (const LineCrossing& c : found) ++starts[c.line + 1];
    for (std::size_t l = 0; l < lines; ++l) starts[l + 1] += starts[l];
    std::vector<Crossing> sorted(found.size());
    std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
    for (const LineCrossing& c : found) sorted[next[c.line]++] = c.crossing;

    const std::int32_t lo = band.lo * run_unit, hi = band.hi * run_unit;
    out.clear();
    for (std::size_t l = 0; l < lines; ++l) {
        const auto from = sorted.begin() + starts[l], to = sorted.begin() + starts[l + 1];
        std::sort(from, to, [](const Crossing& a, const Crossing& b) { return a.u < b.u; });
        int winding = 0;
        for (auto c = from; c != to; ++c) {
            if (winding != 0) out.push(std::max((c - 1)->u, lo), std::min(c->u, hi));
            winding += c->turn;
        }
        out.end_line();
    }
}

}  // namespace lamella
