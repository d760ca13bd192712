// RecipeDraft: the assignments of a recipe file and flags before they become a Recipe, with every mistake
// found so far.
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

/// The keys above the sections of a machine profile.
struct ProfileHead {
    std::string description;
    std::string based_on;        ///< name or file of another profile; empty for none
    std::string based_on_where;  ///< "mine.toml:2: based_on"
};

/// Collects assignments from a recipe file and from flags (later ones win) and all their mistakes.
class RecipeDraft {
  public:
    /// Reads a recipe file. Throws InputError at once when it cannot be read or is not valid TOML; other
    /// mistakes are collected.
    void read_file(const std::string& path);
    /// Reads a recipe from text. `path` names it in messages, and its folder is the base of relative paths.
    void read_text(std::string_view text, const std::string& path);
    /// Assigns the text of a flag's value; `where` names its place in messages.
    void assign_flag(const Setting& setting, const std::string& text) {
        assign_flag(setting, text, setting.flag);
    }
    void assign_flag(const Setting& setting, const std::string& text, const std::string& where);

    /// Adds an object of the embedding program: sets the [[field]] or [[grading]] of kind host with this
    /// name, or appends one.
    void give_field(const std::string& name, HostGiven<FieldPtr> field);
    void give_grading(const std::string& name, HostGiven<GradingPtr> grading);

    /// Sets the profiles in which printer.profile is looked up; by default the built-in ones.
    void use_profiles(MachineProfiles profiles) { profiles_ = std::move(profiles); }

    /// Sets whether the part needs a body: false for commands that use the foam alone.
    void require_body(bool required) { body_required_ = required; }

    /// Checks all assignments and returns the recipe. Throws one InputError that lists every mistake, a line
    /// each.
    Recipe finish();

    /// Reads a machine profile instead of a recipe: `description`, `based_on` and profile_sections.
    ProfileHead read_profile_file(const std::string& path);
    ProfileHead read_profile(std::string_view text, const std::string& path);
    /// Returns the back-end that the profile names. Throws InputError with every mistake when it names none.
    std::string profile_kind(const std::string& path);
    /// Returns `base` with the profile's values over it. Throws one InputError that lists every mistake.
    PrinterProfile finish_profile(const PrinterProfile& base);

  private:
    struct Entry {
        std::optional<Value> value;  ///< empty when the assignment was wrong
        std::string where;           ///< "foam.toml:7: foam.cell" or "--cell"
        bool from_flag = false;
    };
    struct Mistake {
        int line;  ///< 0 if it has none
        std::string text;
    };
    friend class TomlRecipe;

    /// A key of a section, or of one entry of a list section.
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
    /// Returns the number of entries of a list section; of a plain section 1 if it is used, 0 if not.
    std::size_t count(const Section& section) const;

    void declare_host(const std::string& section, const std::string& name);
    template <typename Entries, typename Given>
    void hand_over(const std::string& section, Entries& entries, const Given& given);

    void drop_overridden_body();
    bool check_bodies();
    void check_kind(const KindSection& section, std::size_t number);
    bool is_chosen_for_modulus(const KindSection& section, const std::string& need) const;
    void check_need(const Part& part, const std::string& need, const std::string& why);
    /// Refuses all but the first of the keys that are given.
    void check_at_most_one(const Part& part, const std::vector<std::string>& keys);
    void check_structure();
    void check_printer();
    bool knows_all_gradings() const;
    void check_pixels();
    void throw_mistakes();
    Recipe assemble();
    template <typename Sizes>
    void check_shape(const Part& of, const std::string& shape, const Sizes& sizes);
    void check_numbers(const Recipe& recipe);
    void check_second_image();
    void check_cut_skin(const Recipe& recipe);
    void check_drains(const Recipe& recipe);
    void check_layers(const LayersRecipe& layers);
    void check_enclosures(const Recipe& recipe);
    void check_frame(const Recipe& recipe);
    void check_output(const OutputRecipe& output);
    void check_scripts(const GcodeProfile& gcode);
    void check_tools(const Recipe& recipe);  ///< recipe_tools.cpp
    void check_cuts(const Recipe& recipe);
    void check_support(const PrinterProfile& printer);
    void check_limits(const std::string& section, const std::string& key, const GradedNumber& number,
                      double least, double most);
    void check_stretch(const FoamRecipe& foam);
    void check_foam(const FoamRecipe& foam);
    void check_modulus(const Recipe& recipe);
    void check_material(const Recipe& recipe);

    // Loads, anchors and what is optimised: recipe_optimize.cpp.
    void check_problem_keys();
    void check_place_keys(const std::string& section, std::size_t number);
    void check_axes(const std::string& section, const std::string& key, std::size_t number);
    void check_problem(const Recipe& recipe);
    void check_place(const Recipe& recipe, const std::string& section, std::size_t number,
                     const PlaceRecipe& place);
    void check_weights(const Recipe& recipe);
    void check_appearance(const Recipe& recipe);
    void check_held(const Recipe& recipe);
    void check_two_dimensions(const Recipe& recipe);
    void check_density(const Recipe& recipe);
    void check_optimize(const Recipe& recipe);
    void check_result_entries(const Recipe& recipe);
    void check_driven_foam(const Recipe& recipe);

    // Discrete elements: recipe_elements.cpp.
    void check_elements(const Recipe& recipe);
    void check_element(const Recipe& recipe, std::size_t number);

    std::map<Place, Entry> entries_;
    std::map<Part, std::string> sections_;  ///< sections in the file, with the places where they begin
    std::map<std::string, HostGiven<FieldPtr>> host_fields_;
    std::map<std::string, HostGiven<GradingPtr>> host_gradings_;
    std::vector<Mistake> mistakes_;
    bool body_required_ = true;
    MachineProfiles profiles_;
    PrinterProfile machine_;  ///< the machine of printer.profile
};

}  // namespace lamella
