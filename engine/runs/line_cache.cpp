// Selects lines by their numbers.
#include "engine/runs/line_cache.h"

#include <algorithm>

namespace lamella {
namespace {

/// Returns true if line numbers and run coordinates mean the same in both bands.
bool count_alike(const RowBand& a, const RowBand& b) {
    return a.axis == b.axis && a.sub == b.sub && a.along_origin == b.along_origin &&
           a.along_pitch == b.along_pitch && a.across_origin == b.across_origin &&
           a.across_pitch == b.across_pitch && a.lo == b.lo && a.hi == b.hi;
}

}  // namespace

void LineCache::add(const RowBand& band, const RunRows& rows) {
    if (finished_ || band.step != 1 || !count_alike(band, wanted_)) return;
    const auto wanted = static_cast<std::size_t>(wanted_.lines());
    const int begin = band.number(0), end = begin + band.lines();
    std::size_t next = rows_.lines();
    const auto number = [&] { return wanted_.number(static_cast<int>(next)); };
    while (next < wanted && number() < begin) ++next;
    rows_.end_lines(next - rows_.lines());
    for (; next < wanted && number() < end; ++next)
        rows_.append_line(rows.line(static_cast<std::size_t>(number() - begin)));
}

void LineCache::finish(const RowBand& band) {
    if (finished_ || band.step != 1 || !count_alike(band, wanted_)) return;
    rows_.end_lines(static_cast<std::size_t>(wanted_.lines()) - rows_.lines());
    finished_ = true;
}

}  // namespace lamella
