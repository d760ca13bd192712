// Openings by rectangles, row by row.
#include "engine/surveys/tip_pieces.h"

#include <utility>

#include "engine/runs/row_sets.h"

namespace lamella {

namespace {

/// Makes one line of the runs, which come in any order.
RunRows line_of(std::vector<Run> runs) {
    std::ranges::sort(runs, {}, &Run::begin);
    RunRows line;
    for (const Run& run : runs) line.push(run.begin, run.end);
    line.end_line();
    return line;
}

}  // namespace

RunRows opened(const RunRows& rows, int height, std::int32_t length) {
    const auto lines = static_cast<int>(rows.lines());
    RunRows inner = rows, outer;
    for (int k = 1; k < height; ++k) {
        RunRows next;
        for (int l = 0; l < lines; ++l) {
            const int above = l + k;
            const auto line =
                above < lines ? rows.line(static_cast<std::size_t>(above)) : std::span<const Run>();
            intersect_line(inner.line(static_cast<std::size_t>(l)), line, next);
        }
        inner = std::move(next);
    }
    for (int l = 0; l < lines; ++l) {
        std::vector<Run> line;
        for (int k = std::max(l - height + 1, 0); k <= l; ++k) {
            for (const Run& run : inner.line(static_cast<std::size_t>(k))) {
                if (run.end - run.begin >= length) line.push_back(run);
            }
        }
        std::ranges::sort(line, {}, &Run::begin);
        for (const Run& run : line) outer.push(run.begin, run.end);
        outer.end_line();
    }
    return outer;
}

LayerPieces tip_pieces(RunRows rows, int layer, int height, std::int32_t length) {
    const RunRows firm = opened(rows, height, length);
    LayerPieces pieces{.rows = std::move(rows), .firm = label_layer(firm, layer, Growth{}), .slivers = {}};
    pieces.slivers = label_layer(without(pieces.rows, firm), layer, Growth{});
    pieces.beside.resize(pieces.slivers.components.size());
    for_touching_pieces(pieces.slivers, pieces.firm, [&](std::uint32_t sliver, std::uint32_t piece) {
        pieces.beside[sliver].push_back(piece);
    });
    for (auto& list : pieces.beside) sort_unique(list);
    return pieces;
}

RunRows grown_row(const LayerPieces& layer, TipNode node, int r) {
    std::vector<Run> grown, others, own;
    const auto into = [](std::vector<Run>& list, std::int32_t by) {
        return [&list, by](const LabelledRun& run) { list.push_back({run.begin - by, run.end + by}); };
    };
    for (int aside = -tip_growth; aside <= tip_growth; ++aside)
        for_runs(layer, r + aside, node, true, into(grown, tip_growth * run_unit));
    for_runs(layer, r, node, false, into(others, run_unit / 2));
    for_runs(layer, r, node, true, into(own, 0));
    return united(without(line_of(std::move(grown)), line_of(std::move(others))), line_of(std::move(own)));
}

}  // namespace lamella
