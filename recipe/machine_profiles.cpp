// Searches folders and built-in texts in order; resolves profiles that are based on others.
#include "recipe/machine_profiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/base/user_config.h"
#include "printers/common/profile_texts.h"
#include "printers/registry.h"
#include "recipe/printer_choice.h"
#include "recipe/recipe_draft.h"

namespace lamella {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t max_files = 10'000;
constexpr std::size_t longest_chain = 16;
constexpr std::string_view ending = ".toml";

/// A back-end's plain profile: default settings, no machine.
MachineProfile plain(const std::string& backend) {
    MachineProfile profile;
    profile.printer.name = backend;
    profile.printer.backend = backend;
    const BackendInfo& info = find_backend(backend);
    profile.printer.support = info.default_supports();
    profile.description = info.description;
    profile.source = "back-end";
    return profile;
}

std::string shown(const std::string& name) { return name.substr(0, 64); }

/// Returns the names that contain a word of three letters and more, in any case, at most five of them, as
/// "a` or `b"; empty for none.
std::string join_alike(const std::string& word, const std::vector<std::string>& names) {
    constexpr std::size_t shortest = 3;
    constexpr int most = 5;
    std::string list;
    int count = 0;
    for (const std::string& name : names) {
        if (word.size() < shortest || name.find(lower_case(word)) == std::string::npos || ++count > most)
            continue;
        list += (list.empty() ? "" : "` or `") + name;
    }
    return list;
}

}  // namespace

bool names_profile_file(std::string_view text) { return text.ends_with(ending); }

std::string user_profile_folder() {
    const std::string folder = user_config_folder();
    return folder.empty() ? "" : folder + "/printers";
}

MachineProfiles::MachineProfiles() {
    for (const ProfileText& profile : profile_texts())
        places_.push_back({std::string(profile.name), "", profile.text});
}

void MachineProfiles::add_folder(const std::string& folder, bool must_exist) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) {
        if (!must_exist) return;
        throw InputError(folder + ": is not a folder; accepted: a folder of machine profiles (.toml)");
    }
    std::vector<Place> found;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const fs::path& path = entry.path();
        if (path.extension() != ending || path.stem().empty() || entry.is_directory(error)) continue;
        found.push_back({path.stem().string(), path.string(), {}});
        if (found.size() > max_files) {
            throw InputError(fmt::format("{}: has more than {} profiles", folder, max_files));
        }
    }
    if (error) throw InputError(folder + ": cannot be read: " + error.message());
    std::sort(found.begin(), found.end(), [](const Place& a, const Place& b) { return a.name < b.name; });
    places_.insert(places_.begin(), found.begin(), found.end());
}

std::vector<std::string> MachineProfiles::names() const {
    std::vector<std::string> names;
    for (const Place& place : places_) names.push_back(place.name);
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    for (const std::string& backend : backend_words()) {
        if (std::find(names.begin(), names.end(), backend) == names.end()) names.push_back(backend);
    }
    return names;
}

std::optional<MachineProfile> MachineProfiles::find(const std::string& name) const {
    return find(name, 0, {});
}

std::string MachineProfiles::unknown(const std::string& name) const {
    const std::vector<std::string> known = names();
    std::string listing;
    for (const std::string& word : known) listing += (listing.empty() ? "" : ", ") + word;
    std::string near = nearest(name, known);
    if (near.empty()) near = join_alike(name, known);
    return fmt::format("\"{}\" is unknown{}; accepted: one of {}, or the path of a profile's .toml file",
                       shown(name), near.empty() ? "" : ", did you mean `" + near + "`?", listing);
}

/// Finds a profile in the places from `from` on.
std::optional<MachineProfile> MachineProfiles::find(const std::string& name, std::size_t from,
                                                    const Chain& chain) const {
    if (names_profile_file(name)) return load({fs::path(name).stem().string(), name, {}}, 0, chain);
    for (std::size_t i = from; i < places_.size(); ++i) {
        if (places_[i].name == name) return load(places_[i], i + 1, chain);
    }
    const std::vector<std::string> words = backend_words();
    if (std::find(words.begin(), words.end(), name) != words.end()) return plain(name);
    return std::nullopt;
}

/// `next`: the first place to search for a base with this profile's own name.
MachineProfile MachineProfiles::load(const Place& place, std::size_t next, Chain chain) const {
    const bool built_in = place.path.empty();
    const std::string path = built_in ? fmt::format("built-in {}{}", place.name, ending) : place.path;
    RecipeDraft draft;
    const ProfileHead head = built_in ? draft.read_profile(place.text, path) : draft.read_profile_file(path);
    MachineProfile profile;
    if (head.based_on.empty()) {
        profile = plain(draft.profile_kind(path));
    } else {
        chain.push_back(path);
        if (chain.size() > longest_chain) {
            throw InputError(
                fmt::format("{}: is based on itself, or on more than {} others; accepted: a "
                            "profile that leads to one without based_on",
                            head.based_on_where, longest_chain));
        }
        std::string name = head.based_on;
        if (names_profile_file(name))
            name = (fs::path(path).parent_path() / name).lexically_normal().string();
        auto base = find(name, name == place.name ? next : 0, chain);
        if (!base) throw InputError(fmt::format("{}: {}", head.based_on_where, unknown(name)));
        profile = *std::move(base);
    }
    profile.printer.name = place.name;
    profile.printer = draft.finish_profile(profile.printer);
    profile.description = head.description;
    profile.source = built_in ? "built in" : place.path;
    return profile;
}

}  // namespace lamella
