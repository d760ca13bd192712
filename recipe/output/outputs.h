// Where a run's layers go: paths with the machine that each is for.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/layers/backend.h"
#include "recipe/machine_profiles.h"
#include "recipe/recipe.h"

namespace lamella {

/// Makes a back-end that writes to a path.
using OpenBackendAt = std::function<std::unique_ptr<Backend>(const PrinterProfile& printer,
                                                             const std::string& path, bool force)>;

/// A back-end that is none of the registry's.
struct OutsideBackend {
    std::string name;
    std::string ending;  ///< of its files, with the dot; empty for none
    OpenBackendAt open;
};

/// A file or folder, and the machine it is made for.
struct Output {
    std::string path;
    PrinterProfile printer;
    OpenBackendAt open{};  ///< empty: the back-end that the machine names
};

/// The outputs that a command line names: PATH, or PATH@PROFILE for another machine than the recipe's, or for
/// one of the `outside`. A path's ending that belongs to a back-end chooses it. None named: the default
/// output of the recipe. Throws InputError for a profile that there is none of, and for a path named twice.
std::vector<Output> read_outputs(const std::vector<std::string>& named, const Recipe& recipe,
                                 const MachineProfiles& profiles,
                                 std::span<const OutsideBackend> outside = {});

/// One back-end that writes all of them.
std::unique_ptr<Backend> make_outputs(const std::vector<Output>& outputs, bool force);

}  // namespace lamella
