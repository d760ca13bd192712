// The outputs of a run: paths, each with its machine.
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

/// A back-end that is not in the registry, such as a plugin's.
struct OutsideBackend {
    std::string name;
    std::string ending;  ///< file name ending, with the dot; empty for none
    OpenBackendAt open;
};

/// An output file or folder and its machine.
struct Output {
    std::string path;
    PrinterProfile printer;
    OpenBackendAt open{};  ///< empty: the machine's back-end
};

/// Parses the outputs of a command line: PATH, or PATH@PROFILE for a machine other than the recipe's or for
/// one of the `outside` back-ends. A path's ending that belongs to a back-end selects it. Without any,
/// returns the recipe's default output. Throws InputError for an unknown profile and for a path named twice.
std::vector<Output> read_outputs(const std::vector<std::string>& named, const Recipe& recipe,
                                 const MachineProfiles& profiles,
                                 std::span<const OutsideBackend> outside = {});

/// Makes one back-end that writes all outputs; `force` replaces existing ones.
std::unique_ptr<Backend> make_outputs(const std::vector<Output>& outputs, bool force);

}  // namespace lamella
