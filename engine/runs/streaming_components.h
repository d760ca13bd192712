// StreamingComponents: connected components of layers that stream by, each forgotten after its last layer.
#pragma once

#include <vector>

#include "engine/runs/run_components.h"

namespace lamella {

/// The runs of a component in one layer; keeps the first `max_kept` of them.
struct LayerPatch {
    static constexpr std::size_t max_kept = 4096;

    int layer = 0;
    std::int64_t length = 0;       ///< sum of the lengths of all runs, in run units
    double along = 0, across = 0;  ///< sums of the runs' centres (run units, rows), weighted by length
    std::vector<PlacedRun> runs{};

    void include(const PlacedRun& run);
    void include(const LayerPatch& other);
    /// A point inside the patch near its centroid, in the kept run nearest to the centroid: `along` is a run
    /// coordinate, at least half a pixel inside the run where the run is long enough; `row` is at most half a
    /// row from the run's.
    struct Point {
        double along;
        double row;
    };
    Point middle() const;
};

/// A component, as far as the layers so far show it.
struct StreamingComponent {
    ComponentExtent extent;
    std::uint32_t flags = 0;             ///< union of the flags of its parts, set by the caller
    std::vector<std::uint32_t> marks{};  ///< union of the marks of its parts, sorted
    LayerPatch largest;  ///< its largest layer; ties go to the lowest. Compared whenever parts are joined

    void include(StreamingComponent other);
};

/// Report of a component that ends with a layer, or is joined to components with flags that it lacks.
struct EndedComponent {
    StreamingComponent component;    ///< its state before the layer
    bool joined = false;             ///< it continues as part of another component
    std::uint32_t joined_flags = 0;  ///< flags of the joined component, its own included
};

/// The caller's flags and marks for each component of a layer; empty when there are none.
struct ComponentTags {
    std::vector<std::uint32_t> flags{};
    std::vector<std::vector<std::uint32_t>> marks{};  ///< each sorted
};

/// Joins labelled layers into components like RunComponents without growth: runs that overlap or touch, in
/// neighbouring rows and layers, corners included, are connected. Memory: the runs of one layer and one patch
/// for each component that goes through it.
class StreamingComponents {
  public:
    /// Adds the next layer, labelled without growth. Appends the components that have ended, the earliest
    /// first.
    void add(LabelledLayer layer, int index, const ComponentTags& tags, std::vector<EndedComponent>& ended);
    /// Ends the stream: appends all components that are left.
    void finish(std::vector<EndedComponent>& ended);
    /// Calls `change` on the marks of each component that goes through the last layer; they have to stay
    /// sorted.
    template <typename Change>
    void change_marks(Change change) {
        for (StreamingComponent& component : live_) change(component.marks);
    }

  private:
    /// Kinds of components with runs in a row of the last layer: the main one, others.
    struct RowOfLast {
        bool has_main = false, has_others = false;
    };
    void join_touching(const LabelledLayer& layer, DisjointSets& sets) const;
    RowOfLast row_of_last(int r) const;

    LabelledLayer last_;                    // labels are indices into live_
    std::vector<StreamingComponent> live_;  // the earliest first
    std::uint32_t main_ = 0;                // index of the largest of them
    std::vector<RowOfLast> rows_of_last_;
};

}  // namespace lamella
