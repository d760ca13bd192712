// GraphLowering: converts implicit functions to formulas, with all calls inlined and all values split into
// numbers.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "engine/field/grading.h"
#include "engine/io/graph_check.h"

namespace lamella {

/// A function whose graph has been checked. A faulty one matters only once it is used.
struct CheckedFunction {
    GraphFunction function;
    CheckedGraph graph;  ///< of an ImplicitGraph
    std::string where;   ///< for messages: "part.3mf: function 5 \"sphere\""
    std::string fault;   ///< what is wrong with it, as a whole message; empty if it can be evaluated
};

/// Throws InputError if the function is faulty.
void require_sound(const CheckedFunction& function);

/// External resources of functions. The gradings are evaluated in the caller's coordinates: those of the
/// model for meshes, uvw for images.
struct GraphResources {
    /// Returns the function with that number; null when there is none.
    std::function<const CheckedFunction*(std::int64_t id)> function;
    /// Returns the signed or unsigned distance to a mesh. Throws InputError that says what is wrong.
    std::function<GradingPtr(std::int64_t object, bool with_sign)> mesh;
    /// Returns a channel of the image, 0 to 3 for red to alpha: 0 to 1, before scale and offset. Tile style
    /// `none` clamps.
    std::function<GradingPtr(const ImageFunction& image, int channel)> image;
};

/// Lowers functions into one builder. A resource that is no formula becomes a further input of the builder: a
/// grading is appended to `others`, to be evaluated at the builder's inputs 0 to 2.
class GraphLowering {
  public:
    using Values = std::map<std::string, GraphValue, std::less<>>;

    GraphLowering(FormulaBuilder& builder, std::vector<GradingPtr>& others, const GraphResources& resources)
        : builder_(builder), others_(others), resources_(resources) {}

    /// Returns the wanted outputs of a function, at most all. Throws InputError for arguments that are
    /// missing, superfluous or of the wrong type, outputs and resources that do not exist, functions that
    /// are faulty or call themselves, inputs that nothing feeds, and for graphs beyond the limits on size and
    /// nesting.
    Values call(const CheckedFunction& function, const Values& arguments,
                std::span<const std::string> wanted);

  private:
    Values call_graph(const CheckedFunction& function, const Values& arguments,
                      std::span<const std::string> wanted);
    Values call_image(const ImageFunction& image, const GraphValue& place,
                      std::span<const std::string> wanted);
    std::vector<GraphValue> evaluate(const CheckedFunction& in, std::uint32_t node,
                                     std::span<const GraphValue> inputs);
    std::vector<GraphValue> call_node(const CheckedFunction& in, const GraphNode& node,
                                      std::span<const GraphValue> inputs);
    FormulaBuilder::Node sample(const std::string& name, const std::function<GradingPtr()>& make,
                                const GraphValue& place);

    FormulaBuilder& builder_;
    std::vector<GradingPtr>& others_;
    const GraphResources& resources_;
    std::set<std::int64_t> open_;  ///< functions in the current call chain
    std::size_t evaluated_ = 0;    ///< number of nodes, in all calls
    std::map<std::string, GradingPtr> sources_;
    std::map<std::pair<std::string, std::array<FormulaBuilder::Node, 3>>, FormulaBuilder::Node> samples_;
    std::vector<int> depth_;  ///< of each of `others`: how many nested samples its position depends on
};

}  // namespace lamella
