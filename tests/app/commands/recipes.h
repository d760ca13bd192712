// Recipes as text, for tests of what becomes of them.
#pragma once

#include <string>

#include "engine/base/error.h"
#include "recipe/build/build_job.h"
#include "recipe/recipe_draft.h"
#include "tests/app/commands/mentions.h"

namespace lamella {

/// The recipe that the text writes down, as if it stood in the file `path`.
inline Recipe recipe_of(const std::string& text, const std::string& path = "test.toml") {
    RecipeDraft draft;
    draft.read_text(text, path);
    return draft.finish();
}

/// What is wrong with the recipe or the job that it makes; empty when nothing is.
inline std::string complaint_about(const std::string& text, const std::string& path = "test.toml") {
    try {
        build_job(recipe_of(text, path));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace lamella
