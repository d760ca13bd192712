// Connected components of a solid given as the runs of its layers, found in one pass from the first layer to
// the last.
#pragma once

#include <compare>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/disjoint_sets.h"
#include "engine/runs/runs.h"

namespace lamella {

/// How far a run reaches beyond itself when it looks for others. Two runs are joined when their boxes (a run
/// long, a row wide, a layer high) touch once each has grown by this much on every side.
struct Growth {
    std::int32_t units = 0;  ///< along the rows, in run units
    int rows = 0;            ///< across
    int layers = 0;          ///< over the height
};

/// A grown run and the number of its component.
struct LabelledRun {
    std::int32_t begin;
    std::int32_t end;
    std::uint32_t component;
};

/// What is known of a component: of its own runs, not of the grown ones.
struct ComponentExtent {
    std::int64_t length = 0;  ///< sum of the lengths of its runs, in run units
    Run along{INT32_MAX, INT32_MIN};
    int first_row = INT32_MAX, last_row = INT32_MIN;  ///< inclusive
    int first_layer = INT32_MAX, last_layer = INT32_MIN;

    void include(const ComponentExtent& other);
};

/// The grown runs of one layer and how they hang together within it.
struct LabelledLayer {
    int first_row = 0;                  ///< may be negative: growing adds rows
    std::vector<std::uint32_t> starts;  ///< where each row's runs begin; one more than there are rows
    std::vector<LabelledRun> runs;      ///< by row, then begin; disjoint; components numbered by appearance
    std::vector<ComponentExtent> components;
    std::vector<std::uint32_t> owners;  ///< the component of each run that was given, in their order

    int rows() const { return static_cast<int>(starts.size()) - 1; }
    /// The runs of a row; empty where the layer has no such row.
    std::span<const LabelledRun> row(int r) const {
        const int i = r - first_row;
        if (i < 0 || i >= rows()) return {};
        const auto at = static_cast<std::size_t>(i);
        return {runs.data() + starts[at], starts[at + 1] - starts[at]};
    }
    /// Packs or unpacks. Throws FaultError for what is no labelled layer.
    void serialize(Archive& parcel);
};

/// Grows and labels a layer's runs: line l is row l. Pure, so layers can be labelled at once.
LabelledLayer label_layer(const RunRows& rows, int layer, const Growth& growth);

/// Calls visit(a, b) for every run of `a` and of `b`, two sorted, disjoint lists, that overlap or touch.
template <typename A, typename B, typename Visit>
void for_touching(std::span<const A> a, std::span<const B> b, Visit visit) {
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        if (a[i].begin <= b[j].end && b[j].begin <= a[i].end) visit(a[i], b[j]);
        if (a[i].end < b[j].end) {
            ++i;
        } else {
            ++j;
        }
    }
}

/// Calls visit(a, b) for every run of `a` that is wanted when its turn comes and the first one of `b` that it
/// overlaps or touches.
template <typename A, typename Wanted, typename B, typename Visit>
void for_first_touching(std::span<const A> a, Wanted wanted, std::span<const B> b, Visit visit) {
    auto other = b.begin();
    for (const A& run : a) {
        if (!wanted(run)) continue;
        while (other != b.end() && other->end < run.begin) ++other;
        if (other == b.end()) return;
        if (other->begin <= run.end) visit(run, *other);
    }
}

/// A grown run of a component: where it lies in the stack of layers.
struct PlacedRun {
    std::int32_t layer;
    std::int32_t row;
    std::int32_t begin;
    std::int32_t end;
    friend auto operator<=>(const PlacedRun&,
                            const PlacedRun&) =
        default;  // NOLINT(modernize-use-nullptr): misread by the tool
};

/// Joins labelled layers to components of the whole solid (union-find; a component's number is that of its
/// earliest run). Memory: the layers within reach of the last one, the runs kept of small components, and
/// twelve bytes for every place where a component begins.
class RunComponents {
  public:
    struct Component {
        ComponentExtent extent;
        std::size_t run_count = 0;          ///< grown runs
        std::vector<PlacedRun> runs;        ///< all of them while small, else none
        std::vector<std::uint32_t> groups;  ///< sorted marks given by the caller
    };

    /// max_runs: a component with more grown runs than this keeps none of them.
    RunComponents(const Growth& growth, std::size_t max_runs);

    /// Adds the next layer, labelled with the same growth. Returns for each of the layer's components its
    /// number in the solid; numbers stay valid, `find` says what they have been joined to.
    std::vector<std::uint32_t> add(LabelledLayer layer, int index);
    /// The number under which this component goes now.
    std::uint32_t find(std::uint32_t number);
    /// Marks a component; where components join, so do their marks.
    void mark(std::uint32_t number, std::uint32_t group);
    /// Grown runs kept at the moment.
    std::size_t runs_kept() const { return runs_kept_; }
    /// Numbers of all components, ascending, that is by where they begin.
    std::vector<std::uint32_t> numbers() const;
    const Component& component(std::uint32_t number) { return *components_[find(number)]; }

  private:
    void unite(std::uint32_t a, std::uint32_t b);
    void forget_runs(Component& component);

    int reach_;  ///< layers back that a new layer can join
    std::size_t max_runs_;
    std::size_t runs_kept_ = 0;
    std::deque<LabelledLayer> recent_;  ///< newest last; components are numbers of the solid
    DisjointSets sets_;
    std::vector<std::unique_ptr<Component>> components_;  ///< null once joined to another
};

}  // namespace lamella
