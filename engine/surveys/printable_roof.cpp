// Printable roofs: each connected part of a layer becomes cavity as a whole, or by dilation and a hip roof.
#include "engine/surveys/printable_roof.h"

#include <algorithm>

#include "engine/morphology/layer_offset.h"
#include "engine/runs/row_sets.h"
#include "engine/runs/run_components.h"

namespace lamella {
namespace {

/// Returns the rows [first, first + count) of a layer; rows outside it are empty.
RunRows rows_of(const RunRows& all, int first, int count) {
    RunRows some;
    for (int l = first; l < first + count; ++l) {
        const bool known = 0 <= l && l < static_cast<int>(all.lines());
        some.append_line(known ? all.line(static_cast<std::size_t>(l)) : std::span<const Run>());
    }
    return some;
}

/// The cavity of one connected part of a layer's inside. All rows cover the part, and as many rows beside it
/// as a step reaches.
class PartCavity {
  public:
    PartCavity(const RunRows& above, const RunRows& part, const RoofRule& rule)
        : above_(above), part_(part), rule_(rule) {}

    RunRows largest() const {
        if (overhang(part_).runs().empty()) return part_;
        const RunRows cavity = without_thin_walls_lost(grown_above());
        return united(cavity, under_hip_roof(cavity));
    }

  private:
    RunRows grown(const RunRows& rows, double by) const {
        RunRows out;
        grow_rows(WeightedRows(rows, by), rule_.row_pitch, out);
        return out;
    }
    RunRows shrunk(const RunRows& rows, double by) const {
        RunRows out;
        shrink_rows(rows, by, rule_.row_pitch, out);
        return out;
    }
    /// Returns the solid above such a cavity that would hang farther than a step from the solid beside it.
    RunRows overhang(const RunRows& cavity) const { return without(shrunk(cavity, rule_.step), above_); }

    /// Returns the cavity above, dilated by a step. Walls between its parts that would be too thin become
    /// cavity.
    RunRows grown_above() const {
        RunRows cavity = common(grown(above_, rule_.step), part_);
        if (rule_.min_wall == 0 || cavity.runs().empty()) return cavity;
        const double half = rule_.min_wall / 2;
        return common(united(cavity, shrunk(grown(cavity, half), half)), part_);
    }

    /// Returns the cavity without the points near hanging solid that have solid above them: thin walls
    /// continue downward.
    RunRows without_thin_walls_lost(const RunRows& cavity) const {
        const RunRows hanging = overhang(cavity);
        if (hanging.runs().empty()) return cavity;
        const RunRows about = grown(hanging, rule_.step + rule_.min_wall / 2);
        return without(cavity, without(about, above_));
    }

    /// Returns the erosion of the part by the least distance that leaves nothing hanging, by bisection.
    RunRows under_hip_roof(const RunRows& cavity) const {
        constexpr int parts_of_a_step = 16;
        double too_little = 0, enough = half_width();
        RunRows best = empty_rows(part_.lines());
        while (enough - too_little > rule_.step / parts_of_a_step) {
            const double distance = (too_little + enough) / 2;
            const RunRows middle = shrunk(part_, distance);
            if (overhang(united(cavity, middle)).runs().empty()) {
                enough = distance;
                best = middle;
            } else {
                too_little = distance;
            }
        }
        return best;
    }

    /// Returns an upper bound of the distance of the part's points from its border.
    double half_width() const {
        std::int32_t longest = 0;
        for (const Run& run : part_.runs()) longest = std::max(longest, run.end - run.begin);
        return std::min<double>(longest, rule_.row_pitch * static_cast<double>(part_.lines())) / 2;
    }

    const RunRows& above_;
    const RunRows& part_;
    const RoofRule& rule_;
};

/// Returns the rows of one component of a labelled layer, with `margin` empty rows on either side.
RunRows rows_of_component(const RunRows& all, const LabelledLayer& labels, std::uint32_t component,
                          int margin) {
    const ComponentExtent& extent = labels.components[component];
    RunRows rows;
    for (int l = extent.first_row - margin; l <= extent.last_row + margin; ++l) {
        if (extent.first_row <= l && l <= extent.last_row) {
            for (const Run& run : all.line(static_cast<std::size_t>(l))) {
                const auto i = static_cast<std::size_t>(&run - all.runs().data());
                if (labels.owners[i] == component) rows.push(run.begin, run.end);
            }
        }
        rows.end_line();
    }
    return rows;
}

/// Returns the union of a whole layer and rows that begin at its line `first`.
RunRows joined(const RunRows& whole, const RunRows& some, int first) {
    return united(whole, rows_of(some, -first, static_cast<int>(whole.lines())));
}

}  // namespace

RunRows cavity_below(const RunRows& above, const RunRows& inside, const RoofRule& rule) {
    const LabelledLayer labels = label_layer(inside, 0, Growth{});
    const int margin = static_cast<int>(rule.step / rule.row_pitch) + 1;
    RunRows all = empty_rows(inside.lines());
    for (std::uint32_t c = 0; c < labels.components.size(); ++c) {
        const RunRows part = rows_of_component(inside, labels, c, margin);
        const int first = labels.components[c].first_row - margin;
        const RunRows near = rows_of(above, first, static_cast<int>(part.lines()));
        all = joined(all, PartCavity(near, part, rule).largest(), first);
    }
    return all;
}

}  // namespace lamella
