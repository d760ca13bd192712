// Samples beads along their length and splits them.
#include "printers/toolpath/hanging_beads.h"

#include <cmath>

namespace lamella {
namespace {

constexpr double samples_a_width = 4;

/// A stretch of a bead, mm from its start.
struct Stretch {
    double from = 0;
    double to = 0;
    bool hangs = false;
    double length() const { return to - from; }
};

/// A bead as an open line, with the length up to each point and the width there, mm.
struct Line {
    std::vector<dvec2> points;
    std::vector<double> ways;
    std::vector<double> widths;
};

Line line_of(const Bead& bead) {
    Line line;
    const std::size_t n = bead.points.size();
    for (std::size_t i = 0; i < n + (bead.closed ? 1 : 0); ++i) {
        const dvec2 p = bead.points[i % n];
        const dvec2 step = line.points.empty() ? dvec2(0) : p - line.points.back();
        line.ways.push_back((line.ways.empty() ? 0 : line.ways.back()) +
                            std::sqrt(step.x * step.x + step.y * step.y));
        line.points.push_back(p);
        line.widths.push_back(bead.width_at(i % n));
    }
    return line;
}

void append(Stretch next, std::vector<Stretch>& stretches) {
    if (!stretches.empty() && stretches.back().hangs == next.hangs)
        stretches.back().to = next.to;
    else
        stretches.push_back(next);
}

std::vector<Stretch> stretches_of(const Line& line, const LayerBelow& footing, double step) {
    std::vector<Stretch> stretches;
    for (std::size_t i = 1; i < line.points.size(); ++i) {
        const double length = line.ways[i] - line.ways[i - 1];
        const int samples = std::max(1, static_cast<int>(std::ceil(length / step)));
        const auto way = [&](double sample) { return line.ways[i - 1] + length * (sample / samples); };
        for (int k = 0; k < samples; ++k) {
            const double t = (k + 0.5) / samples;
            const dvec2 p = line.points[i - 1] + (line.points[i] - line.points[i - 1]) * t;
            append({way(k), way(k + 1), !footing.holds(p)}, stretches);
        }
    }
    return stretches;
}

/// Merges stretches of one kind that are too short into their neighbours. In a loop the first stretch
/// continues the last.
std::vector<Stretch> without_short(const std::vector<Stretch>& stretches, bool hanging, double least,
                                   bool closed) {
    std::vector<Stretch> longer;
    const bool joined = closed && stretches.front().hangs == stretches.back().hangs;
    const double seam = joined ? stretches.front().length() + stretches.back().length() : 0;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
        Stretch s = stretches[i];
        const bool at_seam = joined && (i == 0 || i + 1 == stretches.size());
        if (stretches.size() > 1 && s.hangs == hanging && (at_seam ? seam : s.length()) < least)
            s.hangs = !hanging;
        append(s, longer);
    }
    return longer;
}

Bead piece_of(const Bead& bead, const Line& line, const Stretch& stretch) {
    Bead piece = bead;
    piece.points.clear();
    piece.widths.clear();
    piece.closed = false;
    piece.hangs = stretch.hangs;
    const auto add = [&](dvec2 p, double width) {
        piece.points.push_back(p);
        if (!bead.widths.empty()) piece.widths.push_back(width);
    };
    const auto add_between = [&](std::size_t i, double way) {  // between points i - 1 and i
        const double t = (way - line.ways[i - 1]) / (line.ways[i] - line.ways[i - 1]);
        add(line.points[i - 1] + (line.points[i] - line.points[i - 1]) * t,
            line.widths[i - 1] + (line.widths[i] - line.widths[i - 1]) * t);
    };
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        const double way = line.ways[i], before = i > 0 ? line.ways[i - 1] : way;
        if (before < stretch.from && stretch.from < way) add_between(i, stretch.from);
        if (stretch.from <= way && way <= stretch.to) add(line.points[i], line.widths[i]);
        if (before < stretch.to && stretch.to < way) add_between(i, stretch.to);
    }
    return piece;
}

}  // namespace

std::vector<Bead> cut_hanging(const std::vector<Bead>& beads, const LayerBelow& footing) {
    std::vector<Bead> cut;
    cut.reserve(beads.size());
    for (const Bead& bead : beads) {
        const Line line = line_of(bead);
        if (bead.hangs || !(line.ways.back() > 0)) {
            cut.push_back(bead);
            continue;
        }
        std::vector<Stretch> stretches = stretches_of(line, footing, bead.width / samples_a_width);
        for (const bool hanging : {false, true})
            stretches = without_short(stretches, hanging, bead.width, bead.closed);
        if (stretches.size() == 1) {
            cut.push_back(bead);
            cut.back().hangs = stretches.front().hangs;
            continue;
        }
        for (const Stretch& stretch : stretches) cut.push_back(piece_of(bead, line, stretch));
    }
    return cut;
}

}  // namespace lamella
