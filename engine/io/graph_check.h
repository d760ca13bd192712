// Checks the graphs of implicit functions: kinds, types, references and cycles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/io/graph_nodes.h"

namespace lamella {

/// Source of an input: an output of a node, or an input of the function.
struct GraphSource {
    static constexpr std::uint32_t function_inputs = 0xffffffffU;
    static constexpr std::uint32_t nothing = 0xfffffffeU;  ///< the input has no reference
    std::uint32_t node = function_inputs;
    std::uint32_t port = 0;

    bool is_node() const { return node < nothing; }
};

/// A graph that can be evaluated: every node's inputs in the order of its kind (further ones of a
/// functioncall in the order of the file), likewise its outputs, and the sources of all inputs.
struct CheckedGraph {
    struct Node {
        const NodeKind* kind = nullptr;
        std::vector<GraphSource> sources;  ///< one per input
    };
    ImplicitGraph graph;
    std::vector<Node> nodes;           ///< one per node of the graph
    std::vector<std::uint32_t> order;  ///< nodes in topological order, each behind its sources
    std::vector<GraphSource> outputs;  ///< one per output of the graph
};

/// Message about an input or output whose source is `nothing`.
inline constexpr const char* nothing_feeds_it = "nothing feeds it; it needs a ref of the form node.output";

/// Checks a whole graph, including unused nodes. Throws InputError for nodes of unknown kinds, names that are
/// duplicate or missing, inputs that are missing, superfluous, or of another type than their source, and for
/// cycles. Inputs and outputs without a reference are allowed, for editors leave them in nodes that are not
/// used: evaluation refuses them. `where` ("part.3mf: function 5") begins the message.
CheckedGraph check_graph(ImplicitGraph graph, const std::string& where);

}  // namespace lamella
