// Union-find between the components that go through one layer and those of the next.
#include "engine/passing_components.h"

#include <algorithm>
#include <iterator>

namespace lamella {
namespace {

/// The components of a layer by themselves; of their patches nothing but how long they are.
std::vector<PassingComponent> of_layer(const LabelledLayer& layer, int index, const ComponentTags& tags) {
    std::vector<PassingComponent> components(layer.components.size());
    for (std::size_t c = 0; c < components.size(); ++c) {
        components[c].extent = layer.components[c];
        components[c].largest.layer = index;
        components[c].largest.length = layer.components[c].length;
        if (!tags.flags.empty()) components[c].flags = tags.flags[c];
        if (!tags.marks.empty()) components[c].marks = tags.marks[c];
    }
    return components;
}

/// Which members do not belong to the set that most of them belong to.
std::vector<std::uint8_t> apart_from_most(DisjointSets& sets) {
    std::vector<std::uint32_t> members(sets.size(), 0);
    for (std::uint32_t c = 0; c < sets.size(); ++c) ++members[sets.find(c)];
    const auto most = static_cast<std::uint32_t>(std::ranges::max_element(members) - members.begin());
    std::vector<std::uint8_t> apart(sets.size());
    for (std::uint32_t c = 0; c < sets.size(); ++c) apart[c] = sets.find(c) != most ? 1 : 0;
    return apart;
}

}  // namespace

void LayerPatch::include(const PlacedRun& run) {
    const auto width = std::int64_t{run.end} - run.begin;
    length += width;
    along += static_cast<double>(width) * 0.5 * (static_cast<double>(run.begin) + run.end);
    across += static_cast<double>(width) * run.row;
    if (runs.size() < most_kept) runs.push_back(run);
}

void LayerPatch::include(const LayerPatch& other) {
    length += other.length;
    along += other.along;
    across += other.across;
    const std::size_t room = most_kept - std::min(most_kept, runs.size());
    const auto taken = static_cast<std::ptrdiff_t>(std::min(room, other.runs.size()));
    runs.insert(runs.end(), other.runs.begin(), other.runs.begin() + taken);
}

LayerPatch::Point LayerPatch::middle() const {
    const auto whole = static_cast<double>(std::max<std::int64_t>(length, 1));
    const double u = along / whole, v = across / whole;
    Point best{u, 0};
    double nearest = infinity;
    for (const PlacedRun& run : runs) {
        const double inset = std::min(0.5 * run_unit, 0.5 * (static_cast<double>(run.end) - run.begin));
        const double place = std::min(std::max(u, run.begin + inset), run.end - inset);
        const double du = (place - u) / run_unit, dv = run.row - v, d = du * du + dv * dv;
        if (d < nearest) {
            nearest = d;
            best = {place, std::clamp(v, run.row - 0.5, run.row + 0.5)};
        }
    }
    return best;
}

void PassingComponent::include(PassingComponent other) {
    extent.include(other.extent);
    flags |= other.flags;
    if (!other.marks.empty()) {
        std::vector<std::uint32_t> all;
        std::ranges::set_union(marks, other.marks, std::back_inserter(all));
        marks.swap(all);
    }
    if (other.largest.layer == largest.layer) {
        largest.include(other.largest);
    } else if (other.largest.length > largest.length ||
               (other.largest.length == largest.length && other.largest.layer < largest.layer)) {
        largest = std::move(other.largest);
    }
}

/// Joins what touches: a layer's components, which follow those that live, and these.
void PassingComponents::join_touching(const LabelledLayer& layer, DisjointSets& sets) const {
    constexpr std::uint32_t none = UINT32_MAX;
    const auto old_count = static_cast<std::uint32_t>(live_.size());
    std::vector<std::uint32_t> joined_last(layer.components.size(), none);  // most say the same again
    const auto join = [&](const LabelledRun& run, const LabelledRun& older) {
        std::uint32_t& last = joined_last[run.component];
        if (last == older.component) return;
        last = older.component;
        sets.join(old_count + run.component, older.component);
    };
    const int first = layer.first_row, end = first + layer.rows();
    for (int r = first; r < end; ++r) {
        const std::span<const LabelledRun> older = last_.row(r);
        if (older.empty()) continue;
        // Where all is of one component, as in most rows, a run that is joined to it needs no look.
        const std::uint32_t only = older.front().component;
        if (std::ranges::all_of(older, [&](const LabelledRun& run) { return run.component == only; })) {
            const auto wanted = [&](const LabelledRun& run) { return joined_last[run.component] != only; };
            for_first_touching(layer.row(r), wanted, older, join);
        } else {
            for_touching(layer.row(r), older, join);
        }
    }
    // Rows beside each other matter where something is not yet joined to what all the rest is.
    const std::vector<std::uint8_t> apart = apart_from_most(sets);
    const auto any_apart = [&](std::span<const LabelledRun> row, std::uint32_t from) {
        return std::ranges::any_of(row,
                                   [&](const LabelledRun& run) { return apart[from + run.component] != 0; });
    };
    std::vector<std::uint8_t> older_apart;  // of rows from one before the first to one behind the last
    for (int r = first - 1; r <= end; ++r) older_apart.push_back(any_apart(last_.row(r), 0) ? 1 : 0);
    auto before = older_apart.begin();
    for (int r = first; r < end; ++r, ++before) {
        if (layer.row(r).empty()) continue;
        const bool is_apart = any_apart(layer.row(r), old_count);
        if (is_apart || before[0] != 0) for_touching(layer.row(r), last_.row(r - 1), join);
        if (is_apart || before[2] != 0) for_touching(layer.row(r), last_.row(r + 1), join);
    }
}

void PassingComponents::add(LabelledLayer layer, int index, const ComponentTags& tags,
                            std::vector<EndedComponent>& ended) {
    std::vector<PassingComponent> fresh = of_layer(layer, index, tags);
    const auto old_count = static_cast<std::uint32_t>(live_.size());
    DisjointSets sets(live_.size() + fresh.size());
    join_touching(layer, sets);
    // The layer's own components first: the runs of one layer belong together before layers are compared.
    std::vector<PassingComponent> joined(sets.size());
    std::vector<std::uint8_t> goes_on(sets.size(), 0);
    for (std::uint32_t c = 0; c < fresh.size(); ++c) {
        const std::uint32_t root = sets.find(old_count + c);
        if (goes_on[root] == 0) {
            joined[root] = std::move(fresh[c]);
            goes_on[root] = 1;
        } else {
            joined[root].include(std::move(fresh[c]));
        }
    }
    std::vector<std::uint32_t> group_flags(sets.size());
    for (std::uint32_t c = 0; c < sets.size(); ++c) {
        const std::uint32_t root = sets.find(c);
        group_flags[root] |= c < old_count ? live_[c].flags : joined[root].flags;
    }
    for (std::uint32_t c = 0; c < old_count; ++c) {
        const std::uint32_t root = sets.find(c);
        if (goes_on[root] == 0) {
            ended.push_back({std::move(live_[c]), false, 0});
            continue;
        }
        if (group_flags[root] != live_[c].flags) ended.push_back({live_[c], true, group_flags[root]});
        joined[root].include(std::move(live_[c]));
    }
    std::vector<std::uint32_t> places(sets.size());
    live_.clear();
    for (std::uint32_t c = 0; c < sets.size(); ++c) {
        if (goes_on[c] == 0) continue;
        places[c] = static_cast<std::uint32_t>(live_.size());
        live_.push_back(std::move(joined[c]));
    }
    std::vector<std::uint32_t> places_of_fresh(fresh.size());
    std::vector<LayerPatch*> patches(fresh.size());  // null: most layers are not the largest of what goes on
    for (std::uint32_t c = 0; c < fresh.size(); ++c) {
        places_of_fresh[c] = places[sets.find(old_count + c)];
        LayerPatch& largest = live_[places_of_fresh[c]].largest;
        if (largest.layer != index) continue;
        largest = {.layer = index};
        patches[c] = &largest;
    }
    std::size_t i = 0;
    for (int r = 0; r < layer.rows(); ++r) {
        for (const std::size_t row_end = layer.starts[static_cast<std::size_t>(r) + 1]; i < row_end; ++i) {
            LabelledRun& run = layer.runs[i];
            LayerPatch* const patch = patches[run.component];
            if (patch != nullptr) patch->include(PlacedRun{index, layer.first_row + r, run.begin, run.end});
            run.component = places_of_fresh[run.component];
        }
    }
    last_ = std::move(layer);
}

void PassingComponents::finish(std::vector<EndedComponent>& ended) {
    for (PassingComponent& component : live_) ended.push_back({std::move(component), false, 0});
    live_.clear();
    last_ = {};
}

}  // namespace lamella
