// Checks of implicit functions' graphs: kinds, types, references and cycles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/io/graph_nodes.h"

namespace lamella {

/// What feeds an input: an output of a node, or an input of the function.
struct GraphSource {
    static constexpr std::uint32_t function_inputs = 0xffffffffU;
    std::uint32_t node = function_inputs;
    std::uint32_t port = 0;
};

/// A graph that can be evaluated: every node's inputs in the order of its kind (of a functioncall those
/// beyond in the order of the file), its outputs likewise, and what feeds them.
struct CheckedGraph {
    struct Node {
        const NodeKind* kind = nullptr;
        std::vector<GraphSource> sources;  ///< one an input
    };
    ImplicitGraph graph;
    std::vector<Node> nodes;           ///< one a node of the graph
    std::vector<std::uint32_t> order;  ///< nodes, each behind those that feed it
    std::vector<GraphSource> outputs;  ///< one an output of the graph
};

/// Checks a graph wholly, nodes that nothing needs included. `where` ("part.3mf: function 5") begins the
/// message of the InputError for nodes of unknown kinds, names that are taken or missing, inputs that are
/// missing, surplus, or of other types than what feeds them, and for cycles.
CheckedGraph check_graph(ImplicitGraph graph, const std::string& where);

}  // namespace lamella
