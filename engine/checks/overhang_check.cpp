// OverhangCheck: subtracts the dilated layers below from each layer.
#include "engine/checks/overhang_check.h"

#include <algorithm>
#include <cmath>

#include "engine/base/disjoint_sets.h"
#include "engine/morphology/dilated_difference.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

constexpr double rows_of_slope = 8;  // a slope is followed until the outline may have moved by so many rows
constexpr std::size_t max_slope_layers = 64;
constexpr double max_island_layers = 64;
constexpr std::size_t max_kept_words = std::size_t{2} << 20;  // words of all layers' cells, 16 MB

bool any_floats(const std::vector<std::uint8_t>& floats) {
    return std::ranges::find(floats, 1) != floats.end();
}

/// Clears the `floats` flag of components that touch rows of a layer below.
void sink_touching(const LabelledLayer& labelled, const RunRows& below, std::vector<std::uint8_t>& floats) {
    const auto run_floats = [&](const LabelledRun& run) { return floats[run.component] != 0; };
    for (const int aside : {0, -1, 1}) {  // 0 first: most lie straight above something
        if (!any_floats(floats)) return;
        for (int r = 0; r < static_cast<int>(below.lines()); ++r) {
            for_first_touching(labelled.row(r + aside), run_floats, below.line(static_cast<std::size_t>(r)),
                               [&](const LabelledRun& run, const Run&) { floats[run.component] = 0; });
        }
    }
}

/// Joins components in and beside a row that are connected in closer rows. A slim feature that runs nearly
/// along the rows appears at places far apart in two neighbouring rows.
void join_by_closer_rows(const LabelledLayer& labelled, int row, const CheckGrid& grid, const RowsIn& rows_in,
                         DisjointSets& sets) {
    constexpr int lines_a_row = 9;  // odd: the middle line coincides with the row
    constexpr std::uint32_t none = UINT32_MAX;
    RowBand band = grid.band;
    band.first = std::max(row - 1, 0);
    band.count = std::min(row + 2, grid.band.count) - band.first;
    band.sub = lines_a_row;
    const LabelledLayer closer = label_layer(rows_in(band), 0, Growth{});
    std::vector<std::uint32_t> seen_as(closer.components.size(), none);
    for (int k = 0; k < band.count; ++k) {
        for_touching(labelled.row(band.first + k), closer.row(k * lines_a_row + lines_a_row / 2),
                     [&](const LabelledRun& run, const LabelledRun& other) {
                         std::uint32_t& first = seen_as[other.component];
                         if (first == none) first = run.component;
                         sets.join(first, run.component);
                     });
    }
}

/// Clears the `floats` flag of pieces in a single row that are connected to a supported piece in closer rows:
/// rows cut slim tips into such pieces.
void sink_tips(const LabelledLayer& labelled, const CheckGrid& grid, const RowsIn& rows_in,
               std::vector<std::uint8_t>& floats) {
    DisjointSets sets(floats.size());
    int looked_at = -1;
    for (std::size_t c = 0; c < floats.size(); ++c) {  // by their first rows
        const ComponentExtent& extent = labelled.components[c];
        if (floats[c] == 0 || extent.first_row != extent.last_row || extent.first_row == looked_at) continue;
        looked_at = extent.first_row;
        join_by_closer_rows(labelled, looked_at, grid, rows_in, sets);
    }
    std::vector<std::uint8_t> held(floats.size(), 0);
    for (std::uint32_t c = 0; c < floats.size(); ++c) {
        if (floats[c] == 0) held[sets.find(c)] = 1;
    }
    for (std::uint32_t c = 0; c < floats.size(); ++c) {
        if (held[sets.find(c)] != 0) floats[c] = 0;
    }
}

/// Returns the points of `a` that are farther than `pitches` from `b`.
RunRows beyond(const RunRows& a, const RunRows& b, double pitches) {
    RunRows out;
    subtract_dilated(a, b, pitches * run_unit, run_unit, out);
    return out;
}

/// Returns the candidates of beyond(): the parts of `rows` in cells that may be farther than `pitches` from
/// the solid. `outer` are the cells that `rows` meet, `inner` the cells that the solid covers.
RunRows maybe_beyond(const RunRows& rows, const RowBitmask& outer, const RowBitmask& inner, double pitches) {
    RowBitmask suspected = outer;
    suspected.subtract_dilated(inner, inner_disc(pitches * run_unit, run_unit));
    return suspected.clip(rows, suspected.lattice().margin_lines);
}

/// Returns the runs of the chosen components of a layer.
RunRows rows_of(const RunRows& rows, const LabelledLayer& labelled, const std::vector<std::uint8_t>& chosen) {
    RunRows out;
    std::size_t i = 0;
    for (std::size_t l = rows.line_with_runs(0); l < rows.lines(); l = rows.line_with_runs(l + 1)) {
        out.end_lines(l - out.lines());
        for (const Run& run : rows.line(l)) {
            if (chosen[labelled.owners[i++]] != 0) out.push(run.begin, run.end);
        }
        out.end_line();
    }
    out.end_lines(rows.lines() - out.lines());
    return out;
}

/// Returns the rows without pieces whose diagonal is shorter than `least` mm.
RunRows large_pieces(RunRows rows, double least, const CheckGrid& grid) {
    if (rows.runs().empty()) return rows;
    const LabelledLayer labelled = label_layer(rows, 0, Growth{});
    return rows_of(rows, labelled, reaching(labelled, least, grid));
}

std::size_t layers_in(double height, double layer_height) {
    return static_cast<std::size_t>(std::max(std::ceil(height / layer_height - 1e-6), 0.0));
}

std::size_t layers_of_slope(const CheckGrid& grid, const PrintLimits& limits) {
    const std::size_t layers = layers_in(rows_of_slope * grid.band.along_pitch, limits.overhang);
    return std::clamp<std::size_t>(layers, 1, max_slope_layers);
}

std::size_t layers_of_small_island(const CheckGrid& grid, const PrintLimits& limits) {
    const double layers = std::sqrt(limits.island) / grid.layers.greatest_height();
    return limits.island > 0 ? static_cast<std::size_t>(std::clamp(layers, 1.0, max_island_layers)) : 0;
}

}  // namespace

OverhangCheck::OverhangCheck(const CheckContext& context)
    : grid_(context.grid),
      limits_(context.limits),
      follows_overhangs_(limits_.verdict(Check::overhangs) != Severity::off ||
                         limits_.verdict(Check::bridges) != Severity::off),
      slope_layers_(follows_overhangs_ ? layers_of_slope(grid_, limits_) : 0),
      support_layers_(1 + layers_in(limits_.support_gap, grid_.layers.least_height())),
      unheld_layers_(layers_of_small_island(grid_, limits_)),
      supports_(grid_, limits_.support_spacing, limits_.support_gap),
      islands_(context.max_faults),
      overhangs_(context.max_faults),
      bridges_(context.max_faults) {}

double OverhangCheck::allowance(int index, std::size_t layers_below) const {
    const double step = limits_.overhang / grid_.band.along_pitch;
    if (!limits_.overhang_grows || grid_.layers.equal()) return static_cast<double>(layers_below) * step;
    const double height = grid_.layers.height(index + 1 - static_cast<int>(layers_below), index + 1);
    return step * height / grid_.layers.least_height();
}

void OverhangCheck::add(LayerSample& sample, PreparedRows /*prepared*/) {
    LayerFootprint layer = std::move(sample.rows);
    LayerCells cells = *std::move(sample.cells);
    const int index = sample.index;
    Below next;
    if (below_.empty()) {
        next.hung = empty_rows(layer.part.lines());
        add_overhang(next.hung, index);
    } else {
        const RunRows islands = find_islands(layer, sample.printed(), sample.rows_in, index);
        if (follows_overhangs_) follow_overhangs(layer, cells.outer, islands, next, index);
    }
    supports_.add(layer.supports);
    next.rows = std::move(layer);
    const CellLattice& lattice = cells.outer.lattice();
    if (!below_.empty() && lattice.words * lattice.lines * slope_layers_ > max_kept_words)
        below_.back().inner.reset();
    next.inner = std::move(cells.inner);
    below_.push_back(std::move(next));
    if (below_.size() > std::max(slope_layers_, support_layers_)) below_.pop_front();
}

/// Finds and reports overhangs and long bridges, apart from islands. Stores the excused regions in `next`.
void OverhangCheck::follow_overhangs(const LayerFootprint& layer, const RowBitmask& outer,
                                     const RunRows& islands, Below& next, int index) {
    // Sampled by rows, a border may seem up to a pitch farther in.
    const Below& below = below_.back();
    const double reach = allowance(index, 1) + 1;
    const RunRows out = beyond(maybe_beyond(layer.part, outer, *below.inner, reach), below.rows.part, reach);
    const RunRows hanging = without(supports_.unheld(out), islands);
    const RunRows bad = judge_regions(layer, hanging, index);
    next.hung = united(without(hanging, bad), islands);
    const RunRows steep = too_steep(layer, outer, next.hung, index);
    add_overhang(standing_out(layer, united(bad, steep), index), index);
}

/// Returns the islands of a layer, and adds those that matter to the faults.
RunRows OverhangCheck::find_islands(const LayerFootprint& layer, const LabelledLayer& printed,
                                    const RowsIn& rows_in, int index) {
    std::vector<std::uint8_t> floats(printed.components.size(), 1);
    RunRows held;
    const RunRows* below = &below_.back().rows.printed();
    for (const RunRows& islands : unheld_) {
        if (islands.runs().empty()) continue;
        held = without(*below, islands);
        below = &held;
    }
    sink_touching(printed, *below, floats);
    const std::size_t oldest = below_.size() - std::min(below_.size(), support_layers_);
    for (std::size_t k = oldest; k < below_.size(); ++k)
        sink_touching(printed, below_[k].rows.supports, floats);
    if (any_floats(floats)) sink_tips(printed, grid_, rows_in, floats);
    if (!any_floats(floats)) {
        unheld_.clear();
        return empty_rows(layer.printed().lines());
    }
    RunRows floating = rows_of(layer.printed(), printed, floats);
    StreamingComponents one_layer;
    one_layer.add(label_layer(without(floating, keep_small(layer, printed, floats)), index, Growth{}), index,
                  {}, ended_);
    one_layer.finish(ended_);
    for (const EndedComponent& ended : ended_) {
        Fault fault = grid_.fault(ended.component);
        fault.size = grid_.area(ended.component.extent.length);
        islands_.add(std::move(fault));
    }
    ended_.clear();
    return floating;
}

/// Returns for each component that floats how many layers of small islands are below it.
std::vector<std::size_t> OverhangCheck::layers_below(const LabelledLayer& printed,
                                                     const std::vector<std::uint8_t>& floats) const {
    std::vector<std::size_t> layers(floats.size(), 0);
    for (std::size_t k = 0; k < unheld_.size(); ++k) {
        std::vector<std::uint8_t> apart = floats;
        sink_touching(printed, unheld_[k], apart);
        for (std::size_t c = 0; c < floats.size(); ++c) {
            if (floats[c] != 0 && apart[c] == 0) layers[c] = k + 1;
        }
    }
    return layers;
}

/// Keeps the components that float and are too small to be faults in `unheld_`, and returns them.
RunRows OverhangCheck::keep_small(const LayerFootprint& layer, const LabelledLayer& printed,
                                  const std::vector<std::uint8_t>& floats) {
    const std::vector<std::size_t> layers = layers_below(printed, floats);
    RunRows all = empty_rows(layer.printed().lines());
    std::vector<RunRows> kept;
    for (std::size_t k = 0; k < unheld_layers_; ++k) {
        std::vector<std::uint8_t> chosen(floats.size(), 0);
        for (std::size_t c = 0; c < floats.size(); ++c) {
            const bool is_small = grid_.area(printed.components[c].length) < limits_.island;
            chosen[c] = floats[c] != 0 && layers[c] == k && is_small ? 1 : 0;
        }
        kept.push_back(rows_of(layer.printed(), printed, chosen));
        all = united(all, kept.back());
    }
    unheld_ = std::move(kept);
    return all;
}

/// Returns the points that stand out too far over several layers, except those above regions that may hang.
RunRows OverhangCheck::too_steep(const LayerFootprint& layer, const RowBitmask& outer, const RunRows& hangs,
                                 int index) const {
    RunRows none = empty_rows(layer.part.lines());
    if (below_.size() < slope_layers_) return none;
    const std::size_t first = below_.size() - slope_layers_;
    const double far = allowance(index, slope_layers_) + 1;
    // Parts of small pieces are small: no need to test them.
    const auto large = [&](const RunRows& rows) { return large_pieces(rows, limits_.free_stretch, grid_); };
    const Below& lowest = below_[first];
    std::optional<RowBitmask> anew;
    if (!lowest.inner) anew = LayerCells(lowest.rows.part, outer.lattice()).inner;
    RunRows steep = large(maybe_beyond(layer.part, outer, lowest.inner ? *lowest.inner : *anew, far));
    const auto explain = [&](const RunRows& hung, std::size_t layers_below) {
        if (steep.runs().empty() || hung.runs().empty()) return;
        steep = beyond(steep, hung, allowance(index, layers_below) + 1);
    };
    explain(hangs, 0);
    for (std::size_t k = below_.size() - 1; k > first; --k) explain(below_[k].hung, below_.size() - k);
    if (steep.runs().empty()) return none;
    steep = beyond(large(steep), lowest.rows.part, far);
    // The test for supports is the dearest, so it comes last.
    return large(supports_.unheld(large(steep)));
}

/// Returns the runs of regions that cannot be bridged at all. Regions whose bridges are too long become
/// faults.
RunRows OverhangCheck::judge_regions(const LayerFootprint& layer, const RunRows& hanging, int index) {
    if (large_pieces(hanging, limits_.free_stretch, grid_).runs().empty()) return empty_rows(hanging.lines());
    std::vector<PlacedRun> bad;
    const RunRows held = without(layer.printed(), hanging);
    for (const HangingRegion& region :
         find_hanging_regions(hanging, held, limits_.free_stretch, index, grid_)) {
        if (!region.bridge) {
            bad.insert(bad.end(), region.runs.begin(), region.runs.end());
        } else if (*region.bridge > limits_.bridge) {
            LayerPatch patch{.layer = index};
            for (const PlacedRun& run : region.runs) patch.include(run);
            Fault fault = grid_.fault(patch);
            fault.size = *region.bridge;
            bridges_.add(std::move(fault));
        }
    }
    std::ranges::sort(bad);
    RunRows out;
    for (const PlacedRun& run : bad) {
        const auto row = static_cast<std::size_t>(run.row);
        out.end_lines(row - out.lines());
        out.push(run.begin, run.end);
    }
    out.end_lines(hanging.lines() - out.lines());
    return out;
}

/// Extends `found` to all points nearby that stand out over the layer below, so that faults are connected
/// from layer to layer.
RunRows OverhangCheck::standing_out(const LayerFootprint& layer, const RunRows& found, int index) const {
    if (found.runs().empty()) return found;
    const double reach = 2 * allowance(index, 1) + 2;
    const CellLattice& lattice = below_.back().inner->lattice();
    const RowBitmask near = LayerCells(found, lattice).outer.grown(outer_disc(reach * run_unit, run_unit));
    const RunRows all = without(near.clip(layer.part, lattice.margin_lines), below_.back().rows.printed());
    return without(all, beyond(all, found, reach));
}

void OverhangCheck::add_overhang(const RunRows& rows, int index) {
    hanging_.add(label_layer(rows, index, Growth{}), index, {}, ended_);
    for (const EndedComponent& ended : ended_) {
        if (ended.joined) continue;
        Fault fault = grid_.fault(ended.component);
        fault.size = grid_.area(ended.component.largest.length);
        overhangs_.add(std::move(fault));
    }
    ended_.clear();
}

void OverhangCheck::finish() {
    hanging_.finish(ended_);
    for (const EndedComponent& ended : ended_) {
        Fault fault = grid_.fault(ended.component);
        fault.size = grid_.area(ended.component.largest.length);
        overhangs_.add(std::move(fault));
    }
    ended_.clear();
}

}  // namespace lamella
