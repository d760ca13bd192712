// Parses paths, endings and profiles of outputs.
#include "recipe/output/outputs.h"

#include <fmt/format.h>

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

/// Returns the ending of a path that looks like a file's type: a dot, and up to 8 letters and digits with a
/// letter among them. Empty for a folder that is there, and for a path that ends with a slash.
std::string file_type(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) return "";
    const std::string name = std::filesystem::path(path).filename().string();
    const std::size_t dot = name.rfind('.');
    constexpr std::size_t longest = 8;
    if (dot == std::string::npos || dot == 0 || name.size() - dot - 1 > longest) return "";
    const auto is_letter = [](char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); };
    const auto is_word = [&](char c) { return is_letter(c) || ('0' <= c && c <= '9'); };
    const std::string type = name.substr(dot + 1);
    return std::ranges::all_of(type, is_word) && std::ranges::any_of(type, is_letter) ? name.substr(dot) : "";
}

std::string known_endings() {
    std::string list;
    for (const BackendInfo& backend : backends()) {
        for (const std::string& ending : output_endings(backend)) {
            if (list.find(ending + ",") == std::string::npos) list += ending + ", ";
        }
    }
    return list;
}

/// Lets the ending of an output choose the back-end. Throws InputError for the ending of another kind of
/// file, and for a machine that makes another kind of layers.
void choose_by_ending(Output& output, const std::string& named, const std::string& machine) {
    const std::string chosen = backend_of_ending(output.path, output.printer.backend);
    if (chosen.empty()) {
        const std::string type = file_type(output.path);
        if (type.empty() || type == default_folder_ending) return;
        throw InputError(
            fmt::format("--output {}: no format has the ending {}; accepted: {}or a / at the end for a "
                        "folder of that name",
                        named, type, known_endings()));
    }
    const LayerContent wanted = find_backend(chosen).content,
                       made = find_backend(output.printer.backend).content;
    const bool clash = (wanted == LayerContent::beads && made == LayerContent::pixels) ||
                       (wanted == LayerContent::pixels && made == LayerContent::beads);
    if (clash && !machine.empty()) {
        throw InputError(
            fmt::format("--output {}: {} files hold {}, and {} makes {}; accepted: the ending of its own "
                        "files, or PATH@PROFILE with another machine",
                        named, file_type(output.path), wanted == LayerContent::beads ? "beads" : "masks",
                        machine, made == LayerContent::beads ? "beads" : "masks"));
    }
    output.printer.backend = chosen;
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
    std::string machine = recipe.machine;
    if (mark != std::string::npos) {
        machine = named.substr(mark + 1);
        const std::optional<MachineProfile> profile = profiles.find(machine);
        if (!profile) {
            throw InputError("--output " + named + ": " + profiles.unknown(machine) +
                             " (if the file name itself contains an @, give it an ending such as .sl1)");
        }
        output.printer = profile->printer;
    }
    choose_by_ending(output, named, machine);
    // A folder for files that may be many: one a layer.
    if (output.path.ends_with('/') &&
        find_backend(output.printer.backend).output == OutputKind::file_or_folder)
        output.printer.vector.one_file = false;
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
