// Where a run's layers go: paths with the machine that each is for.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/machine_profiles.h"
#include "app/recipe.h"
#include "engine/backend.h"

namespace lamella {

/// A file or folder, and the machine it is made for.
struct Output {
    std::string path;
    PrinterProfile printer;
};

/// The outputs that a command line names: PATH, or PATH@PROFILE for another machine than the recipe's. A
/// path's ending that belongs to a back-end chooses it. None named: the default output of the recipe. Throws
/// InputError for a profile that there is none of, and for a path named twice.
std::vector<Output> read_outputs(const std::vector<std::string>& named, const Recipe& recipe,
                                 const MachineProfiles& profiles);

/// One back-end that writes all of them.
std::unique_ptr<Backend> make_outputs(const std::vector<Output>& outputs, bool force);

}  // namespace lamella
