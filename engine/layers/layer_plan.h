// LayerPlan: the heights at which a job is cut into layers.
#pragma once

#include <string>
#include <vector>

namespace lamella {

/// Layers of equal height, one on the other.
struct EqualLayers {
    int count = 0;
    double height = 0;  ///< of each, mm

    friend bool operator==(const EqualLayers&, const EqualLayers&) = default;
};

/// The layers of a job, from the bed upward: runs of equal layers, each on the one before. All heights are in
/// mm over the bed. Immutable; memory grows with the number of runs, not of layers. Numbers of layers are not
/// checked, unless a function says so.
///
/// A plan may hold several stacks of layers, each from the bed upward, one after the other: the parts of a
/// plate that are printed one by one. Layers and runs are then counted through all of them.
class LayerPlan {
  public:
    /// No layers.
    LayerPlan() = default;
    /// Layers of one height.
    LayerPlan(int count, double height) : LayerPlan({EqualLayers{count, height}}) {}
    /// Neighbouring runs of the same height become one; runs without layers vanish.
    explicit LayerPlan(const std::vector<EqualLayers>& runs);
    /// Returns the stacks of several plans, each of one stack with layers.
    static LayerPlan stacked(const std::vector<LayerPlan>& plans);

    int count() const { return count_; }
    /// Whether all layers have the same height.
    bool equal() const { return runs_.size() <= 1; }
    double height(int layer) const { return run_of(layer).height; }
    double bottom(int layer) const { return at(layer, 0); }
    double middle(int layer) const { return at(layer, 0.5); }
    double top(int layer) const { return at(layer, 1); }
    /// Returns the height of all layers together; that of the highest stack.
    double total() const;
    /// Returns the number of stacks, the stack of a layer, and the stack's first layer; layers of the next
    /// one begin where its own end, and first_of_stack(stacks()) is the number of layers.
    int stacks() const { return static_cast<int>(stack_ends_.size()) + 1; }
    int stack_of(int layer) const;
    int first_of_stack(int stack) const;
    /// Returns the height of the layers [first, last) together.
    double height(int first, int last) const;
    double least_height() const { return least_; }
    double greatest_height() const { return greatest_; }
    /// Returns the layer that holds a height; the lowest or highest one for heights beyond. Of several
    /// stacks, a layer of the first.
    int layer_at(double height) const;

    /// Returns the runs, lowest first.
    std::vector<EqualLayers> runs() const;
    /// Returns a plan of layers whose heights are divided by a number.
    LayerPlan divided(double by) const;
    /// Returns a plan of the lowest layers, this many.
    LayerPlan lowest(int count) const;
    /// Returns a plan with layers of another one below these.
    LayerPlan raised(const LayerPlan& below) const;

    /// Whether the lowest layers are those of another plan, all of them.
    bool begins_like(const LayerPlan& other) const;
    /// Returns a text such as "0.05 mm" or "0.1 to 0.3 mm".
    std::string heights_text() const;

    friend bool operator==(const LayerPlan& a, const LayerPlan& b) {
        return a.runs() == b.runs() && a.stack_ends_ == b.stack_ends_;
    }

  private:
    struct Run {
        int first;
        double bottom, height;
    };
    const Run& run_of(int layer) const;
    /// Returns the height at a share of the layer.
    double at(int layer, double share) const {
        const Run& run = run_of(layer);
        return run.bottom + ((layer - run.first) + share) * run.height;
    }

    std::vector<Run> runs_;
    std::vector<int> stack_ends_;  // of all stacks but the last
    int count_ = 0;
    double least_ = 0, greatest_ = 0;
};

/// Returns the number of layers of height `h` (mm) that hold some of a part of this height (mm): those whose
/// lowest cutting plane, at this share of the layer, lies below the part's top by more than a millionth of a
/// layer; at least one. Throws InputError when a height is not positive and finite, or when there would be
/// more than 10 million layers.
int count_layers(double part_height, double h, double lowest_plane = 0.5);

/// Returns equal layers that hold a part of this height; throws as count_layers() does.
LayerPlan equal_layers(double part_height, double h, double lowest_plane = 0.5);

}  // namespace lamella
