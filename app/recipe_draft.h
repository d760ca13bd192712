// RecipeDraft: what a recipe file and the flags assign, before it becomes a Recipe, with every mistake found
// on the way.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/settings.h"

namespace lamella {

/// Collects assignments from a recipe file and from flags (later ones win) and all their mistakes.
class RecipeDraft {
  public:
    /// Reads a recipe file. Throws InputError at once when it cannot be read or is no TOML; other mistakes
    /// are collected.
    void read_file(const std::string& path);
    /// The same for a recipe's text; `path` is for messages, and its folder is where relative paths start.
    void read_text(std::string_view text, const std::string& path);
    /// Takes the text of a flag.
    void assign_flag(const Setting& setting, const std::string& text);

    /// Whether the part needs a body: false for commands that look at the foam alone.
    void require_body(bool required) { body_required_ = required; }

    /// The recipe. Throws one InputError with every mistake, a line each, when there is any.
    Recipe finish();

  private:
    struct Entry {
        std::optional<Value> value;  ///< empty when the assignment was wrong
        std::string where;           ///< "foam.toml:7: foam.cell" or "--cell"
        bool from_flag = false;
    };
    struct Mistake {
        int line;  ///< 0 for what has none
        std::string text;
    };
    friend class TomlRecipe;

    void set(const Setting& setting, Value value, std::string where, bool from_flag);
    void refuse(int line, std::string text) { mistakes_.push_back({line, std::move(text)}); }
    const Entry* entry(std::string_view section, std::string_view key) const;
    bool section_used(const std::string& section) const;
    void drop_overridden_body();
    void check_required(const std::string& section, const std::string& key, const std::string& why);
    void check_body();
    void check_structure();
    void check_printer();
    Recipe assemble() const;
    void check_numbers(const Recipe& recipe);

    std::map<std::string, Entry> entries_;         ///< by "section.key"
    std::map<std::string, std::string> sections_;  ///< sections present in the file: where they begin
    std::vector<Mistake> mistakes_;
    bool body_required_ = true;
};

}  // namespace lamella
