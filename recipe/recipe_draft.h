// RecipeDraft: what a recipe file and the flags assign, before it becomes a Recipe, with every mistake found
// on the way.
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "recipe/machine_profiles.h"
#include "recipe/recipe_kinds.h"
#include "recipe/settings.h"

namespace lamella {

/// What stands above the sections of a machine profile.
struct ProfileHead {
    std::string description;
    std::string based_on;        ///< name or file of another profile; empty for none
    std::string based_on_where;  ///< "mine.toml:2: based_on"
};

/// Collects assignments from a recipe file and from flags (later ones win) and all their mistakes.
class RecipeDraft {
  public:
    /// Reads a recipe file. Throws InputError at once when it cannot be read or is no TOML; other mistakes
    /// are collected.
    void read_file(const std::string& path);
    /// The same for a recipe's text; `path` is for messages, and its folder is where relative paths start.
    void read_text(std::string_view text, const std::string& path);
    /// Takes the text of a flag; `where` stands for it in messages.
    void assign_flag(const Setting& setting, const std::string& text) {
        assign_flag(setting, text, setting.flag);
    }
    void assign_flag(const Setting& setting, const std::string& text, const std::string& where);

    /// Puts a solid, or a number that varies in space, of the embedding program into the recipe: as a
    /// [[field]] or [[grading]] of kind host, which is added where there is none of this name.
    void give_field(const std::string& name, HostGiven<FieldPtr> field);
    void give_grading(const std::string& name, HostGiven<GradingPtr> grading);

    /// Where printer.profile is looked up; without this among the built-in profiles.
    void use_profiles(MachineProfiles profiles) { profiles_ = std::move(profiles); }

    /// Whether the part needs a body: false for commands that look at the foam alone.
    void require_body(bool required) { body_required_ = required; }

    /// The recipe. Throws one InputError with every mistake, a line each, when there is any.
    Recipe finish();

    /// Reads a machine profile instead of a recipe: `description`, `based_on` and profile_sections.
    ProfileHead read_profile_file(const std::string& path);
    ProfileHead read_profile(std::string_view text, const std::string& path);
    /// The back-end that the profile names. Throws InputError with every mistake when it names none.
    std::string profile_kind(const std::string& path);
    /// `base` with the profile's values. Throws one InputError with every mistake, as `finish` does.
    PrinterProfile finish_profile(const PrinterProfile& base);

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

    /// A key of a section; of a list section, of one of its entries.
    struct Place {
        std::string section;
        std::size_t entry = 0;
        std::string key;
        auto operator<=>(const Place&) const = default;  // NOLINT(modernize-use-nullptr): misread by the tool
    };
    /// A section or one entry of a list section.
    struct Part {
        std::string section;
        std::size_t entry = 0;
        auto operator<=>(const Part&) const = default;  // NOLINT(modernize-use-nullptr): misread by the tool
    };

    void set(const Setting& setting, std::size_t entry, Value value, const std::string& where,
             bool from_flag);
    void refuse(int line, std::string text) { mistakes_.push_back({line, std::move(text)}); }
    const Entry* entry(std::string_view section, std::string_view key, std::size_t number = 0) const;
    std::string where(std::string_view section, std::string_view key, std::size_t number = 0) const;
    std::string where_begins(const std::string& section, std::size_t number) const;
    /// How many entries of a list section were found; of a plain section, whether it is used.
    std::size_t count(const Section& section) const;

    void declare_host(const std::string& section, const std::string& name);
    template <typename Entries, typename Given>
    void hand_over(const std::string& section, Entries& entries, const Given& given);

    void drop_overridden_body();
    bool check_bodies();
    void check_kind(const KindSection& section, std::size_t number);
    bool is_chosen_for_modulus(const KindSection& section, const std::string& need) const;
    void check_need(const Part& part, const std::string& need, const std::string& why);
    void check_structure();
    void check_printer();
    void check_pixels();
    void throw_mistakes();
    Recipe assemble();
    template <typename Sizes>
    void check_shape(const Part& of, const std::string& shape, const Sizes& sizes);
    void check_numbers(const Recipe& recipe);
    void check_cut_skin(const Recipe& recipe);
    void check_drains(const Recipe& recipe);
    void check_enclosures(const Recipe& recipe);
    void check_frame(const Recipe& recipe);
    void check_output(const OutputRecipe& output);
    void check_scripts(const GcodeProfile& gcode);
    void check_support(const PrinterProfile& printer);
    void check_limits(const std::string& section, const std::string& key, const GradedNumber& number,
                      double least, double most);
    void check_stretch(const FoamRecipe& foam);
    void check_foam(const FoamRecipe& foam);
    void check_modulus(const Recipe& recipe);
    void check_material(const Recipe& recipe);

    std::map<Place, Entry> entries_;
    std::map<Part, std::string> sections_;  ///< those present in the file: where they begin
    std::map<std::string, HostGiven<FieldPtr>> host_fields_;
    std::map<std::string, HostGiven<GradingPtr>> host_gradings_;
    std::vector<Mistake> mistakes_;
    bool body_required_ = true;
    MachineProfiles profiles_;
    PrinterProfile machine_;  ///< what printer.profile names
};

}  // namespace lamella
