// One option for each row of the settings table, with its recipe key in the help.
#include "app/commands/recipe_options.h"

#include <fmt/format.h>

#include <cstdio>

#include "recipe/read_recipe.h"
#include "recipe/recipe_formulas.h"
#include "recipe/settings.h"

namespace lamella {

namespace {

std::string value_hint(const Setting& setting) {
    switch (setting.type) {
        case ValueType::boolean:
            return "";
        case ValueType::integer:
            return "N";
        case ValueType::number:
            return setting.unit == "mm" ? "MM" : "X";
        case ValueType::graded:
            return setting.unit == "mm" ? "MM|FORMULA" : "X|FORMULA";
        case ValueType::graded_triple:
            return "X,Y,Z";
        case ValueType::formula:
            return "FORMULA";
        case ValueType::path:
            return "FILE";
        case ValueType::rows:
            return "X,...;X,...";
        case ValueType::lines:
            return "LINES";
        case ValueType::text:
            return "TEXT";
        case ValueType::choice:
            return "WORD";
        case ValueType::triple:
            return "X,Y,Z";
    }
    return "";
}

std::string option_help(const Setting& setting) {
    return fmt::format("{} Accepts {}; default: {}. Recipe key: {}", setting.help, accepted(setting),
                       setting.fallback, setting.name());
}

}  // namespace

void RecipeOptions::add_to(CLI::App& command) {
    command.add_option("INPUT", input_, "Recipe (.toml) or model (.stl, .obj, .ply, .3mf)")->type_name("");
    add_profile_folder_option(command, profile_folder_);
    texts_.resize(settings().size());
    for (std::size_t i = 0; i < texts_.size(); ++i) {
        const Setting& setting = settings()[i];
        CLI::Option*& option = options_.emplace_back(nullptr);
        if (setting.flag.empty()) continue;
        if (setting.type == ValueType::boolean) {
            const std::string names =
                fmt::format("{}{{true}},--no-{}{{false}}", setting.flag, setting.flag.substr(2));
            option = command.add_flag(names, texts_[i], option_help(setting));
        } else {
            option = command.add_option(setting.flag, texts_[i], option_help(setting));
            option->type_name(value_hint(setting));
        }
        option->group("Recipe [" + setting.section + "]");
        option->take_last();
    }
}

Recipe RecipeOptions::read(bool needs_body) const {
    RecipeDraft draft;
    draft.require_body(needs_body);
    draft.use_profiles(profiles());
    read_input(draft, input_);
    for (std::size_t i = 0; i < options_.size(); ++i) {
        if (options_[i] && options_[i]->count() > 0) draft.assign_flag(settings()[i], texts_[i]);
    }
    return draft.finish();
}

std::string RecipeOptions::given(const std::string& flag) const {
    std::string text;
    for (std::size_t i = 0; i < options_.size(); ++i) {
        if (settings()[i].flag == flag && options_[i]->count() > 0) text = texts_[i];
    }
    return text;
}

MachineProfiles RecipeOptions::profiles() const { return machine_profiles(profile_folder_); }

void add_profile_folder_option(CLI::App& command, std::string& folder) {
    command
        .add_option("--printers", folder,
                    "Folder of machine profiles (.toml), in addition to the built-in ones and those in "
                    "~/.config/lamella/printers")
        ->type_name("DIR");
}

void note_unused(const RecipeOptions& options, const Recipe& recipe) {
    const std::string unused = unused_entries(recipe);
    if (!unused.empty()) std::fputs(fmt::format("{}: {}\n", options.input(), unused).c_str(), stderr);
}

void finish_command(CLI::App& command, const std::string& examples) {
    command.set_version_flag("--version", "lamella " LAMELLA_VERSION);
    command.footer("Examples:\n" + examples);
}

}  // namespace lamella
