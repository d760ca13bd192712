// The kinds of nodes in implicit functions, and the formulas that they stand for.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/formula/formula_builder.h"
#include "engine/io/implicit_graph.h"

namespace lamella {

/// A value within a formula: one builder node per component of its type, or the number of a resource.
struct GraphValue {
    GraphType type = GraphType::scalar;
    std::array<FormulaBuilder::Node, 16> parts{};  ///< matrices row by row
    std::int64_t resource = 0;
};

/// An input or output of a kind of node.
struct NodePort {
    std::string_view name;
    std::string_view types;      ///< allowed types, of s, v, m, r; all ports with several share one
    std::string_view also = {};  ///< another name, from earlier drafts
};

/// A kind of node.
struct NodeKind {
    std::string_view name;
    std::vector<NodePort> inputs, outputs;
    /// Computes the outputs from the inputs. Null for kinds that need more than formulas: `functioncall`
    /// (which also has further ports), `mesh`, `unsignedmesh` and `constresourceid`.
    std::vector<GraphValue> (*make)(FormulaBuilder& builder, const GraphNode& node,
                                    std::span<const GraphValue> inputs) = nullptr;
};

/// Returns the kind of that name; null when it is not supported.
const NodeKind* find_node_kind(std::string_view name);

/// Returns the letter of a type in NodePort::types.
char letter_of(GraphType type);

}  // namespace lamella
