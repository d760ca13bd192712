// Tries every direction and compares the spans.
#include "printers/toolpath/bridge_direction.h"

#include <algorithm>
#include <array>

#include "engine/base/deterministic_math.h"

namespace lamella {
namespace {

struct Spans {
    double unheld = 0;   ///< sum over spans of length times number of unsupported ends, mm
    double longest = 0;  ///< longest span, mm
};

Spans spans_along(const Polygons& hanging, const LayerBelow& footing, dvec2 direction, double width) {
    const Interval across = extent(hanging, {-direction.y, direction.x});
    const int count = std::max(1, static_cast<int>(across.width() / width));
    const double pitch = across.width() / count;
    Spans spans;
    for (const Segment& s : cut_lines(hanging, direction, across.lo + pitch / 2, pitch, count)) {
        const int free = static_cast<int>(!footing.holds(s.a - direction * width)) +
                         static_cast<int>(!footing.holds(s.b + direction * width));
        const double length = s.length();
        spans.unheld += free * length * pitch / width;
        spans.longest = std::max(spans.longest, length);
    }
    return spans;
}

}  // namespace

dvec2 bridge_direction(const Polygons& hanging, const LayerBelow& footing, double width) {
    constexpr int tries = 36;
    constexpr double alike = 0.02;  // share of the region within which directions count as equal
    std::array<dvec2, tries> directions;
    std::array<Spans, tries> spans;
    for (std::size_t i = 0; i < tries; ++i) {
        const SineCosine angle = sine_cosine(pi * static_cast<double>(i) / tries);
        directions[i] = {angle.cosine, angle.sine};
        spans[i] = spans_along(hanging, footing, directions[i], width);
    }
    const double least = std::ranges::min(spans, {}, &Spans::unheld).unheld;
    const double most = least + alike * area_of(hanging) / width;
    std::size_t best = tries;
    for (std::size_t i = 0; i < tries; ++i) {
        if (spans[i].unheld <= most && (best == tries || spans[i].longest < spans[best].longest)) best = i;
    }
    return directions[best];
}

}  // namespace lamella
