// LayerPieces: the pieces of a layer that can hold others, and the slivers beside them, for the tip survey.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/runs/run_components.h"

namespace lamella {

/// A tip, or a piece on the bed, by the order in which they begin.
using TipNode = std::uint32_t;

/// The pieces of a layer that hold, and the slivers beside them, which touch some of these, or none.
struct LayerPieces {
    RunRows rows;
    LabelledLayer firm, slivers;
    std::vector<std::vector<std::uint32_t>> beside{};   ///< by sliver: the firm pieces that it touches
    std::vector<TipNode> firm_nodes{}, sliver_nodes{};  ///< that the components belong to

    int rows_count() const { return static_cast<int>(rows.lines()); }
};

/// By how many rows, and pixels along them, tips are grown: what no row sees between two goes as well.
inline constexpr int tip_growth = 2;

/// Returns the part of the rows that rectangles within them cover, of so many rows and so long, run units.
RunRows opened(const RunRows& rows, int height, std::int32_t length);

/// Divides a layer into what rectangles cover, as in opened(), and slivers; nodes are left open.
LayerPieces tip_pieces(RunRows rows, int layer, int height, std::int32_t length);

/// Returns the part of row r that a node's runs cover once they are grown, kept off the others of that row.
RunRows grown_row(const LayerPieces& layer, TipNode node, int r);

/// Sorts a list, and drops what is equal to the entry before it.
template <typename T>
void sort_unique(std::vector<T>& list) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// Calls visit(a, b) for the components of two layers whose runs overlap or touch, in the same row or the
/// next.
template <typename Visit>
void for_touching_pieces(const LabelledLayer& a, const LabelledLayer& b, const Visit& visit) {
    for (int r = a.first_row; r < a.first_row + a.rows(); ++r) {
        if (a.row(r).empty()) continue;
        for (const int aside : {-1, 0, 1}) {
            for_touching(a.row(r), b.row(r + aside), [&](const LabelledRun& run, const LabelledRun& other) {
                visit(run.component, other.component);
            });
        }
    }
}

/// Calls visit(run) for the runs of a row that belong to a node, or for all others.
template <typename Visit>
void for_runs(const LayerPieces& layer, int row, TipNode node, bool own, const Visit& visit) {
    for (const LabelledRun& run : layer.firm.row(row)) {
        if ((layer.firm_nodes[run.component] == node) == own) visit(run);
    }
    for (const LabelledRun& run : layer.slivers.row(row)) {
        if ((layer.sliver_nodes[run.component] == node) == own) visit(run);
    }
}

/// Calls visit(run, node) for the runs of a row and the nodes of the layer below that they overlap.
template <typename Visit>
void for_nodes(const LayerPieces& below, int row, std::span<const Run> runs, const Visit& visit) {
    const auto visit_overlap = [&](const std::vector<TipNode>& nodes) {
        return [&](const Run& run, const LabelledRun& piece) {
            const Run part{std::max(run.begin, piece.begin), std::min(run.end, piece.end)};
            if (part.begin < part.end) visit(part, nodes[piece.component]);
        };
    };
    for_touching(runs, below.firm.row(row), visit_overlap(below.firm_nodes));
    for_touching(runs, below.slivers.row(row), visit_overlap(below.sliver_nodes));
}

}  // namespace lamella
