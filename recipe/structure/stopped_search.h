// A search that was stopped, kept in a file until it goes on.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "recipe/structure/structure_report.h"

namespace lamella {

struct StoppedSearch {
    TopologyState state;
    std::vector<OptimizationStep> history;  ///< the steps so far
};

/// Writes the search as write_complete_file() does: numbers as they lie in memory, for the same kind of
/// machine.
void write_search(const std::filesystem::path& file, const StoppedSearch& search);

/// Reads a search; nothing if there is no file, or a damaged one. Lists are no longer than the file.
std::optional<StoppedSearch> read_search(const std::filesystem::path& file);

}  // namespace lamella
