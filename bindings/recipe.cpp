// Recipes: read, set and extended by calls.
#include <fmt/format.h>

#include "bindings/handles.h"
#include "bindings/host_field.h"
#include "recipe/read_recipe.h"
#include "recipe/settings.h"

using namespace lamella;

namespace {

std::string name_of(const char* name) {
    std::string text = &wanted(name, "name");
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    if (text.empty() || !std::ranges::all_of(text, fits) || (text[0] >= '0' && text[0] <= '9'))
        throw BadCall("name \"" + text + "\": must be of letters, digits and _, no digit first");
    return text;
}

/// Returns the setting of a key that has a flag of its own. Throws InputError when there is none.
const Setting& setting_of(const std::string& key) {
    const std::size_t dot = std::min(key.find('.'), key.size());
    const Setting* setting = find_setting(key.substr(0, dot), key.substr(std::min(dot + 1, key.size())));
    if (setting != nullptr && !setting->flag.empty()) return *setting;
    std::string wrong = "stands in a section that there may be several of";
    if (setting == nullptr) {
        std::vector<std::string> known;
        for (const Setting& one : settings()) {
            if (!one.flag.empty()) known.push_back(one.name());
        }
        const std::string near = nearest(key, known);
        wrong = "there is no such key" + (near.empty() ? "" : ", did you mean `" + near + "`?");
    }
    throw InputError(fmt::format(
        "{}: {}; accepted: section.key of what the command has a flag for, as foam.cell", key, wrong));
}

}  // namespace

std::int32_t lamella_recipe_create(lamella_context* context, lamella_recipe** recipe) {
    return guarded(context, [&] {
        lamella_recipe*& made = wanted(recipe, "recipe");
        made = new lamella_recipe;
    });
}

void lamella_recipe_destroy(lamella_recipe* recipe) { delete recipe; }

std::int32_t lamella_recipe_read(lamella_context* context, const char* path, lamella_recipe** recipe) {
    return guarded(context, [&] {
        wanted(recipe, "recipe");
        auto made = std::make_unique<lamella_recipe>();
        read_input(made->draft, &wanted(path, "path"));
        *recipe = made.release();
    });
}

std::int32_t lamella_recipe_add_text(lamella_context* context, lamella_recipe* recipe, const char* text,
                                     std::size_t size, const char* name) {
    return guarded(context, [&] {
        wanted(recipe, "recipe");
        if (text == nullptr && size > 0) throw BadCall("text is a null pointer");
        RecipeDraft draft = recipe->draft;  // the recipe stays unchanged if this is not TOML
        draft.read_text({text, size}, &wanted(name, "name"));
        recipe->draft = std::move(draft);
    });
}

std::int32_t lamella_recipe_set(lamella_context* context, lamella_recipe* recipe, const char* key,
                                const char* value) {
    return guarded(context, [&] {
        wanted(recipe, "recipe");
        const std::string name = &wanted(key, "key"), text = &wanted(value, "value");
        recipe->set.emplace_back(&setting_of(name), text);
    });
}

std::int32_t lamella_recipe_add_printers(lamella_context* context, lamella_recipe* recipe,
                                         const char* folder) {
    return guarded(context, [&] {
        wanted(recipe, "recipe");
        const std::string users = user_profile_folder();
        if (folder != nullptr) {
            recipe->profiles.add_folder(folder, true);
        } else if (!users.empty()) {
            recipe->profiles.add_folder(users, false);
        }
    });
}

std::int32_t lamella_recipe_add_field(lamella_context* context, lamella_recipe* recipe, const char* name,
                                      const lamella_field* field) {
    return guarded(context, [&] {
        const std::string called = name_of(name);
        wanted(recipe, "recipe").draft.give_field(called, host_field(taken(field, "field"), called));
    });
}

std::int32_t lamella_recipe_add_mesh(lamella_context* context, lamella_recipe* recipe, const char* name,
                                     const lamella_mesh* mesh) {
    return guarded(context, [&] {
        const std::string called = name_of(name);
        wanted(recipe, "recipe").draft.give_field(called, host_mesh(taken(mesh, "mesh"), called));
    });
}

std::int32_t lamella_recipe_add_grading(lamella_context* context, lamella_recipe* recipe, const char* name,
                                        const lamella_grading* grading) {
    return guarded(context, [&] {
        const std::string called = name_of(name);
        wanted(recipe, "recipe").draft.give_grading(called, host_grading(taken(grading, "grading"), called));
    });
}
