// Parses paths, endings and profiles of outputs.
#include "recipe/output/outputs.h"

#include <algorithm>
#include <filesystem>

#include "engine/base/error.h"
#include "printers/common/several_outputs.h"
#include "printers/registry.h"
#include "recipe/printer_choice.h"

namespace lamella {
namespace {

/// Returns the position of the profile in PATH@PROFILE; npos when there is none. An @ in a folder's name or
/// before an ending belongs to the path.
std::size_t profile_mark(const std::string& named) {
    const std::size_t mark = named.rfind('@');
    if (mark == std::string::npos || named.find_first_of("/.", mark) != std::string::npos)
        return std::string::npos;
    return mark;
}

Output read_output(const std::string& named, const Recipe& recipe, const MachineProfiles& profiles,
                   std::span<const OutsideBackend> outside) {
    const std::size_t mark = profile_mark(named);
    Output output{named.substr(0, mark), recipe.printer};
    if (output.path.empty())
        throw InputError("--output: \"" + named + "\" does not name a file; accepted: PATH or PATH@PROFILE");
    for (const OutsideBackend& backend : outside) {
        const bool is_named = mark != std::string::npos && named.substr(mark + 1) == backend.name;
        const bool has_ending =
            mark == std::string::npos && !backend.ending.empty() && output.path.ends_with(backend.ending);
        if (is_named || has_ending) output.open = backend.open;
    }
    if (output.open) return output;
    if (mark != std::string::npos) {
        const std::string name = named.substr(mark + 1);
        const std::optional<MachineProfile> profile = profiles.find(name);
        if (!profile) {
            throw InputError("--output " + named + ": " + profiles.unknown(name) +
                             " (if the file name itself contains an @, give it an ending such as .sl1)");
        }
        output.printer = profile->printer;
    }
    const std::string backend = backend_of_ending(output.path, output.printer.backend);
    if (!backend.empty()) output.printer.backend = backend;
    return output;
}

std::filesystem::path in_full(const std::string& path) {
    return std::filesystem::absolute(std::filesystem::path(path) / "").lexically_normal();
}

}  // namespace

std::vector<Output> read_outputs(const std::vector<std::string>& named, const Recipe& recipe,
                                 const MachineProfiles& profiles, std::span<const OutsideBackend> outside) {
    std::vector<Output> outputs;
    for (const std::string& text : named) {
        outputs.push_back(read_output(text, recipe, profiles, outside));
        const auto same = [&](const Output& other) {
            return in_full(other.path) == in_full(outputs.back().path);
        };
        if (std::count_if(outputs.begin(), outputs.end(), same) > 1) {
            throw InputError("--output: " + outputs.back().path + " is named twice");
        }
    }
    if (outputs.empty())
        outputs.push_back({default_output(recipe.printer, recipe.part.name), recipe.printer});
    return outputs;
}

std::unique_ptr<Backend> make_outputs(const std::vector<Output>& outputs, bool force) {
    std::vector<std::unique_ptr<Backend>> backends;
    backends.reserve(outputs.size());
    for (const Output& output : outputs) {
        backends.push_back(output.open ? output.open(output.printer, output.path, force)
                                       : make_backend(output.printer, output.path, force));
    }
    return backends.size() == 1 ? std::move(backends.front()) : make_several_outputs(std::move(backends));
}

}  // namespace lamella
