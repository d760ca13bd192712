// Union-find between the components that go through one layer and those of the next.
#include "engine/runs/streaming_components.h"

#include <algorithm>
#include <iterator>

namespace lamella {
namespace {

/// Returns the components of one layer; of their patches only the lengths are set.
std::vector<StreamingComponent> of_layer(const LabelledLayer& layer, int index, const ComponentTags& tags) {
    std::vector<StreamingComponent> components(layer.components.size());
    for (std::size_t c = 0; c < components.size(); ++c) {
        components[c].extent = layer.components[c];
        components[c].largest.layer = index;
        components[c].largest.length = layer.components[c].length;
        if (!tags.flags.empty()) components[c].flags = tags.flags[c];
        if (!tags.marks.empty()) components[c].marks = tags.marks[c];
    }
    return components;
}

/// Returns a flag per element: 1 unless it belongs to the set with the most elements.
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
    if (runs.size() < max_kept) runs.push_back(run);
}

void LayerPatch::include(const LayerPatch& other) {
    length += other.length;
    along += other.along;
    across += other.across;
    const std::size_t room = max_kept - std::min(max_kept, runs.size());
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

void StreamingComponent::include(StreamingComponent other) {
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

/// Joins between a layer's components and the live components.
class LayerJoins {
  public:
    LayerJoins(const LabelledLayer& layer, DisjointSets& sets)
        : sets_(sets),
          old_count_(static_cast<std::uint32_t>(sets.size() - layer.components.size())),
          joined_last_(layer.components.size(), none) {}

    /// Joins each run to the first run of `component` that it touches. Skips runs that were joined to it
    /// last.
    void join_to(std::uint32_t component, std::span<const LabelledRun> row,
                 std::span<const LabelledRun> older) {
        auto other = older.begin();
        for (const LabelledRun& run : row) {
            if (joined_last_[run.component] == component) continue;
            while (other != older.end() && (other->end < run.begin || other->component != component)) ++other;
            if (other == older.end()) return;
            if (other->begin <= run.end) join(run, *other);
        }
    }
    /// Joins each run to all runs that it touches of components other than `component`.
    void join_to_others_than(std::uint32_t component, std::span<const LabelledRun> row,
                             std::span<const LabelledRun> older) {
        auto first = row.begin();
        for (const LabelledRun& other : older) {
            if (other.component == component) continue;
            while (first != row.end() && first->end < other.begin) ++first;
            for (auto run = first; run != row.end() && run->begin <= other.end; ++run) join(*run, other);
        }
    }
    void join(const LabelledRun& run, const LabelledRun& older) {
        std::uint32_t& last = joined_last_[run.component];  // most joins repeat the last one
        if (last == older.component) return;
        last = older.component;
        sets_.join(old_count_ + run.component, older.component);
    }

  private:
    static constexpr std::uint32_t none = UINT32_MAX;

    DisjointSets& sets_;
    std::uint32_t old_count_;
    std::vector<std::uint32_t> joined_last_;
};

/// Joins the components that touch. In `sets` the layer's components follow the live ones.
void StreamingComponents::join_touching(const LabelledLayer& layer, DisjointSets& sets) const {
    LayerJoins joins(layer, sets);
    const int first = layer.first_row, end = first + layer.rows();
    for (int r = first; r < end; ++r) {
        const RowOfLast older = row_of_last(r);
        if (older.has_main) joins.join_to(main_, layer.row(r), last_.row(r));
        if (older.has_others) joins.join_to_others_than(main_, layer.row(r), last_.row(r));
    }
    // Diagonal neighbours matter only where a component is not yet joined to the largest set.
    const std::vector<std::uint8_t> apart = apart_from_most(sets);
    const auto any_apart = [&](std::span<const LabelledRun> row, std::size_t from) {
        return std::ranges::any_of(row,
                                   [&](const LabelledRun& run) { return apart[from + run.component] != 0; });
    };
    const auto older_apart = [&](int r) {
        const RowOfLast older = row_of_last(r);
        return (older.has_main && apart[main_] != 0) || (older.has_others && any_apart(last_.row(r), 0));
    };
    const bool layer_apart = std::find(apart.begin() + static_cast<std::ptrdiff_t>(live_.size()), apart.end(),
                                       std::uint8_t{1}) != apart.end();
    const auto join = [&](const LabelledRun& run, const LabelledRun& older) { joins.join(run, older); };
    bool below = older_apart(first - 1), beside = older_apart(first);
    for (int r = first; r < end; ++r) {
        const bool above = older_apart(r + 1);
        const bool is_apart = layer_apart && any_apart(layer.row(r), live_.size());
        if (is_apart || below) for_touching(layer.row(r), last_.row(r - 1), join);
        if (is_apart || above) for_touching(layer.row(r), last_.row(r + 1), join);
        below = beside;
        beside = above;
    }
}

StreamingComponents::RowOfLast StreamingComponents::row_of_last(int r) const {
    const int i = r - last_.first_row;
    return i < 0 || i >= last_.rows() ? RowOfLast{} : rows_of_last_[static_cast<std::size_t>(i)];
}

void StreamingComponents::add(LabelledLayer layer, int index, const ComponentTags& tags,
                              std::vector<EndedComponent>& ended) {
    std::vector<StreamingComponent> fresh = of_layer(layer, index, tags);
    const auto old_count = static_cast<std::uint32_t>(live_.size());
    DisjointSets sets(live_.size() + fresh.size());
    join_touching(layer, sets);
    // The layer's own components come first: runs of one layer are united before layers are compared.
    std::vector<StreamingComponent> joined(sets.size());
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
    std::vector<LayerPatch*> patches(fresh.size());  // null unless this layer is the component's largest
    for (std::uint32_t c = 0; c < fresh.size(); ++c) {
        places_of_fresh[c] = places[sets.find(old_count + c)];
        LayerPatch& patch = live_[places_of_fresh[c]].largest;
        if (patch.layer != index) continue;
        patch = {.layer = index};
        patches[c] = &patch;
    }
    const auto largest = std::ranges::max_element(
        live_, {}, [](const StreamingComponent& component) { return component.extent.length; });
    main_ = static_cast<std::uint32_t>(largest - live_.begin());
    rows_of_last_.resize(static_cast<std::size_t>(layer.rows()));
    for (std::size_t r = 0; r < rows_of_last_.size(); ++r) {
        const int row = layer.first_row + static_cast<int>(r);
        RowOfLast contents;
        for (std::size_t i = layer.starts[r]; i < layer.starts[r + 1]; ++i) {
            LabelledRun& run = layer.runs[i];
            LayerPatch* const patch = patches[run.component];
            if (patch != nullptr) patch->include(PlacedRun{index, row, run.begin, run.end});
            run.component = places_of_fresh[run.component];
            contents.has_main |= run.component == main_;
            contents.has_others |= run.component != main_;
        }
        rows_of_last_[r] = contents;
    }
    last_ = std::move(layer);
}

void StreamingComponents::finish(std::vector<EndedComponent>& ended) {
    for (StreamingComponent& component : live_) ended.push_back({std::move(component), false, 0});
    live_.clear();
    last_ = {};
}

}  // namespace lamella
