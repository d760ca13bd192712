// Connected components of a solid given as runs layer by layer, found in one pass from the first layer up.
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

/// Reach of a run when it is joined to others. Two runs are joined when their boxes (a run long, a row wide,
/// a layer high) touch after each has been dilated by this much on every side.
struct Growth {
    std::int32_t units = 0;  ///< along the rows, in run units
    int rows = 0;            ///< across
    int layers = 0;          ///< over the height
};

/// A dilated run and the number of its component.
struct LabelledRun {
    std::int32_t begin;
    std::int32_t end;
    std::uint32_t component;
};

/// Size of a component, measured on its original runs, not on the dilated ones.
struct ComponentExtent {
    std::int64_t length = 0;  ///< sum of the lengths of its runs, in run units
    Run along{INT32_MAX, INT32_MIN};
    int first_row = INT32_MAX, last_row = INT32_MIN;  ///< inclusive
    int first_layer = INT32_MAX, last_layer = INT32_MIN;

    void include(const ComponentExtent& other);
};

/// The dilated runs of one layer and its connected components.
struct LabelledLayer {
    int first_row = 0;                  ///< may be negative: dilation adds rows
    std::vector<std::uint32_t> starts;  ///< where each row's runs begin; one more than there are rows
    std::vector<LabelledRun> runs;      ///< by row, then begin; disjoint; components numbered by appearance
    std::vector<ComponentExtent> components;
    std::vector<std::uint32_t> owners;  ///< the component of each original run, in input order

    int rows() const { return static_cast<int>(starts.size()) - 1; }
    /// Returns the runs of a row; empty where the layer has no such row.
    std::span<const LabelledRun> row(int r) const {
        const int i = r - first_row;
        if (i < 0 || i >= rows()) return {};
        const auto at = static_cast<std::size_t>(i);
        return {runs.data() + starts[at], starts[at + 1] - starts[at]};
    }
    /// Packs or unpacks. Throws FaultError when the bytes are no labelled layer.
    void serialize(Archive& parcel);
};

/// Dilates and labels a layer's runs: line l is row l. Pure, so layers can be labelled in parallel.
LabelledLayer label_layer(const RunRows& rows, int layer, const Growth& growth);

/// Calls visit(a, b) for every pair of runs of two sorted, disjoint lists that overlap or touch.
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

/// Calls visit(a, b) for each run of `a` and the first run of `b` that it overlaps or touches. `wanted` is
/// asked just before each run of `a`, so that earlier visits can exclude later runs.
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

/// A dilated run of a component: its position in the stack of layers.
struct PlacedRun {
    std::int32_t layer;
    std::int32_t row;
    std::int32_t begin;
    std::int32_t end;
    friend auto operator<=>(const PlacedRun&,
                            const PlacedRun&) =
        default;  // NOLINT(modernize-use-nullptr): misread by the tool
};

/// Joins labelled layers into components of the whole solid (union-find; a component's number is that of its
/// earliest run). Memory: the layers within reach of the last one, the kept runs of small components, and
/// twelve bytes for every place where a component begins.
class RunComponents {
  public:
    struct Component {
        ComponentExtent extent;
        std::size_t run_count = 0;          ///< dilated runs
        std::vector<PlacedRun> runs;        ///< all of them while the component is small, else none
        std::vector<std::uint32_t> groups;  ///< sorted marks set by the caller
    };

    /// `max_runs`: a component with more dilated runs than this keeps none of them.
    RunComponents(const Growth& growth, std::size_t max_runs);

    /// Adds the next layer, labelled with the same growth. Returns for each of the layer's components its
    /// number in the solid. Numbers stay valid; `find` returns the component that a number was joined to.
    std::vector<std::uint32_t> add(LabelledLayer layer, int index);
    /// Returns the current number of this component.
    std::uint32_t find(std::uint32_t number);
    /// Marks a component; joined components unite their marks.
    void mark(std::uint32_t number, std::uint32_t group);
    /// Returns how many dilated runs are kept at the moment.
    std::size_t runs_kept() const { return runs_kept_; }
    /// Returns the numbers of all components, ascending, that is in order of where they begin.
    std::vector<std::uint32_t> numbers() const;
    const Component& component(std::uint32_t number) { return *components_[find(number)]; }

  private:
    void unite(std::uint32_t a, std::uint32_t b);
    void forget_runs(Component& component);

    int reach_;  ///< how many layers back a new layer can join
    std::size_t max_runs_;
    std::size_t runs_kept_ = 0;
    std::deque<LabelledLayer> recent_;  ///< newest last; labels are component numbers of the solid
    DisjointSets sets_;
    std::vector<std::unique_ptr<Component>> components_;  ///< null once joined to another
};

}  // namespace lamella
