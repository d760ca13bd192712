// Connected components of layers that stream by; a component is forgotten once its last layer has passed.
#pragma once

#include <vector>

#include "engine/runs/run_components.h"

namespace lamella {

/// The runs of a component in one layer, the first `max_kept` of them.
struct LayerPatch {
    static constexpr std::size_t max_kept = 4096;

    int layer = 0;
    std::int64_t length = 0;       ///< sum of all of their lengths, in run units
    double along = 0, across = 0;  ///< sums of their middles (run units, rows), weighted with their lengths
    std::vector<PlacedRun> runs{};

    void include(const PlacedRun& run);
    void include(const LayerPatch& other);
    /// The point nearest to the middle of all in the run that is nearest to it: its run coordinate, half a
    /// pixel inside the run where it is that long, and its row, up to half a row from the run's.
    struct Point {
        double along;
        double row;
    };
    Point middle() const;
};

/// A component as far as it is known.
struct StreamingComponent {
    ComponentExtent extent;
    std::uint32_t flags = 0;             ///< of all that belongs to it, given by the caller
    std::vector<std::uint32_t> marks{};  ///< the same, sorted
    LayerPatch largest;                  ///< its largest layer, of equals the lowest, among the parts that
                                         ///< it was joined from

    void include(StreamingComponent other);
};

/// A component that ends with a layer, or is joined to what has flags that it lacks.
struct EndedComponent {
    StreamingComponent component;    ///< as it was before the layer
    bool joined = false;             ///< it goes on as a part of another one
    std::uint32_t joined_flags = 0;  ///< of what it is joined to, its own included
};

/// What the caller knows of each component of a layer; empty where there is nothing to tell.
struct ComponentTags {
    std::vector<std::uint32_t> flags{};
    std::vector<std::vector<std::uint32_t>> marks{};  ///< each sorted
};

/// Joins labelled layers to components as RunComponents does without growth: runs that overlap or touch, in
/// neighbouring rows and layers, corners included, are one. Memory: the runs of one layer and one patch for
/// each component that goes through it.
class StreamingComponents {
  public:
    /// Adds the next layer, labelled without growth. Appends those components that have ended, the earliest
    /// first.
    void add(LabelledLayer layer, int index, const ComponentTags& tags, std::vector<EndedComponent>& ended);
    /// No more layers will come: ends all.
    void finish(std::vector<EndedComponent>& ended);
    /// Lets the marks of those that go through the last layer be changed; they have to stay sorted.
    template <typename Change>
    void change_marks(Change change) {
        for (StreamingComponent& component : live_) change(component.marks);
    }

  private:
    /// Of which components the runs of a row are.
    struct RowOfLast {
        bool has_main = false, has_others = false;
    };
    void join_touching(const LabelledLayer& layer, DisjointSets& sets) const;
    RowOfLast row_of_last(int r) const;

    LabelledLayer last_;                    // components are places in live_
    std::vector<StreamingComponent> live_;  // the earliest first
    std::uint32_t main_ = 0;                // the largest of them
    std::vector<RowOfLast> rows_of_last_;
};

}  // namespace lamella
