// Distinguishes recipes from models by their file ending.
#include "recipe/read_recipe.h"

#include <algorithm>
#include <string_view>

#include "recipe/settings.h"

namespace lamella {

namespace {

bool names_recipe(std::string_view path) {
    if (path.size() < 5) return false;
    std::string ending(path.substr(path.size() - 5));
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return ending == ".toml";
}

}  // namespace

void read_input(RecipeDraft& draft, const std::string& input) {
    if (names_recipe(input)) {
        draft.read_file(input);
    } else if (!input.empty()) {
        draft.assign_flag(*find_setting("part", "mesh"), input);
    }
}

Recipe read_recipe(const std::string& input, const MachineProfiles& profiles) {
    RecipeDraft draft;
    draft.use_profiles(profiles);
    read_input(draft, input);
    return draft.finish();
}

MachineProfiles machine_profiles(const std::string& folder) {
    MachineProfiles profiles;
    if (const std::string users = user_profile_folder(); !users.empty()) profiles.add_folder(users, false);
    if (!folder.empty()) profiles.add_folder(folder, true);
    return profiles;
}

}  // namespace lamella
