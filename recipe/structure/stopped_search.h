// Searches that were stopped, kept in files until they go on.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "procedural/appearance/appearance_optimizer.h"
#include "recipe/structure/structure_report.h"

namespace lamella {

/// A search with a TopologyState or an AppearanceState.
template <typename State>
struct StoppedSearch {
    State state;
    std::vector<OptimizationStep> history;  ///< the steps so far
};

/// Writes the search as write_complete_file() does: numbers as they lie in memory, for the same kind of
/// machine.
template <typename State>
void write_search(const std::filesystem::path& file, const StoppedSearch<State>& search);

/// Reads a search; nothing if there is no file, a damaged one, or one of the other kind. Lists are no longer
/// than the file.
template <typename State>
std::optional<StoppedSearch<State>> read_search(const std::filesystem::path& file);

/// Writes the search with the report's history, and returns whether it is kept: not without a file, nor when
/// it cannot be written, which becomes a note.
template <typename State>
bool keep_search(const std::filesystem::path& file, const State& state, StructureReport& report);

/// Returns the state that a search is to go on from, and gives the report its history. Throws InputError if
/// the file keeps none.
template <typename State>
State kept_search(const std::filesystem::path& file, StructureReport& report);

}  // namespace lamella
