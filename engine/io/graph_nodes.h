// The kinds of nodes that an implicit function may be made of, and what each one computes.
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

/// A value within a formula: as many nodes as its type has components, or the number of a resource.
struct GraphValue {
    GraphType type = GraphType::scalar;
    std::array<FormulaBuilder::Node, 16> parts{};  ///< of a matrix row by row
    std::int64_t resource = 0;
};

/// An input or output that a kind of node has.
struct NodePort {
    std::string_view name;
    std::string_view types;      ///< of s, v, m, r: those it may have; several: all such ports have the same
    std::string_view also = {};  ///< another name that earlier drafts gave it
};

/// A kind of node.
struct NodeKind {
    std::string_view name;
    std::vector<NodePort> inputs, outputs;
    /// The outputs from the inputs; null where a node needs more than formulas: `functioncall`, which has
    /// further ports, too, `mesh`, `unsignedmesh` and `constresourceid`.
    std::vector<GraphValue> (*make)(FormulaBuilder& builder, const GraphNode& node,
                                    std::span<const GraphValue> inputs) = nullptr;
};

/// The kind of that name; null when there is none that is supported.
const NodeKind* find_node_kind(std::string_view name);

/// The letter of a type in NodePort::types.
char letter_of(GraphType type);

}  // namespace lamella
