// Helpers that make rows of the settings table: they bind a key to a place in the recipe.
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "recipe/settings.h"

namespace lamella {

/// Returns the words of a choice, in the order of the enumerators; one overload for every enumeration that a
/// row uses.
const std::vector<std::string>& choice_names(Shape);
const std::vector<std::string>& choice_names(LengthUnit);
const std::vector<std::string>& choice_names(Mirror);
const std::vector<std::string>& choice_names(FoamFrame);
const std::vector<std::string>& choice_names(Falloff);
const std::vector<std::string>& choice_names(SkinSide);
const std::vector<std::string>& choice_names(Reinforcement);
const std::vector<std::string>& choice_names(SupportKind);
const std::vector<std::string>& choice_names(RegionMake);
const std::vector<std::string>& choice_names(CutJoint);
const std::vector<std::string>& choice_names(OptimizeKind);
const std::vector<std::string>& choice_names(OptimizeResult);
const std::vector<std::string>& choice_names(OptimizeMethod);
const std::vector<std::string>& choice_names(ElementKind);
const std::vector<std::string>& choice_names(ImageFormat);
const std::vector<std::string>& choice_names(Antialiasing);
const std::vector<std::string>& choice_names(CliFormat);
const std::vector<std::string>& choice_names(InfillPattern);
const std::vector<std::string>& choice_names(Seam);
const std::vector<std::string>& choice_names(PanelPixels);
const std::vector<std::string>& choice_names(Laser);
const std::vector<std::string>& choice_names(Ties);
const std::vector<std::string>& choice_names(SvgDialect);
const std::vector<std::string>& choice_names(Flavour);
const std::vector<std::string>& choice_names(Process);
const std::vector<std::string>& choice_names(SeverityOverride);

/// The rows of the [[field]] and [[region]] sections.
void add_field_settings(std::vector<Setting>& table);
void add_region_settings(std::vector<Setting>& table);

/// The rows of the [[load]], [[anchor]] and [optimize] sections.
void add_load_settings(std::vector<Setting>& table);
void add_anchor_settings(std::vector<Setting>& table);
void add_optimize_settings(std::vector<Setting>& table);

/// The rows of the [[element]] and [elements] sections.
void add_element_settings(std::vector<Setting>& table);
void add_elements_settings(std::vector<Setting>& table);

/// The rows of the [foam] section about stiffness, and of the [material] section.
void add_stiffness_settings(std::vector<Setting>& table);
void add_material_settings(std::vector<Setting>& table);

/// The rows of the [frame] section.
void add_frame_settings(std::vector<Setting>& table);

/// The rows of the [cavity] and of the [shield] section.
void add_cavity_settings(std::vector<Setting>& table);
void add_shield_settings(std::vector<Setting>& table);

/// The rows of the [process] section.
void add_process_settings(std::vector<Setting>& table);
/// The rows of the [repair] section.
void add_repair_settings(std::vector<Setting>& table);
/// The rows of the [layers] section.
void add_layers_settings(std::vector<Setting>& table);
/// The rows of the [[cut]] section.
void add_cut_settings(std::vector<Setting>& table);
/// The rows of the [plate] section.
void add_plate_settings(std::vector<Setting>& table);
/// The rows of the [support] section.
void add_support_settings(std::vector<Setting>& table);
/// The rows of the [[tool]] and [purge] sections.
void add_tool_settings(std::vector<Setting>& table);
void add_purge_settings(std::vector<Setting>& table);
/// The rows of the [check] section.
void add_check_settings(std::vector<Setting>& table);
/// The rows of the [skin] and [[hole]] sections.
void add_skin_settings(std::vector<Setting>& table);

/// The rows of the [printer] section about archives of masks.
void add_archive_settings(std::vector<Setting>& table);

/// The rows of the [printer] section.
void add_printer_settings(std::vector<Setting>& table);
/// Its rows about the G-code dialect, scripts, speeds and motion, and about lasers.
void add_gcode_settings(std::vector<Setting>& table);
/// Its rows about an extruder's toolpaths.
void add_toolpath_settings(std::vector<Setting>& table);
/// Its rows about files for other programs and for powder-bed machines.
void add_exchange_settings(std::vector<Setting>& table);
/// Its rows about cutting layers out of sheets.
void add_cutting_settings(std::vector<Setting>& table);

inline constexpr Limits length_limits{1e-3, 1e4};  ///< of a positive length, mm
inline constexpr Limits extent_limits{1e-2, 1e5};  ///< of a solid's size, mm
inline constexpr Limits place_limits{-1e6, 1e6};   ///< of a coordinate, mm

/// The properties of a setting other than its key, flag and storage.
struct SettingSpec {
    std::string unit{};
    Limits limits{};
    std::vector<std::string> choices{};
    RowShape shape{};
    std::string fallback{};
    std::string help{};
    bool is_path = false;
    bool is_formula = false;  ///< a graded number that must be a formula
    bool is_lines = false;    ///< a text of several lines
};

template <typename T>
ValueType type_of(const SettingSpec& facts) {
    if constexpr (std::is_same_v<T, bool>) return ValueType::boolean;
    if constexpr (std::is_same_v<T, int> || std::is_same_v<T, std::int64_t>) return ValueType::integer;
    if constexpr (std::is_same_v<T, double>) return ValueType::number;
    if constexpr (std::is_same_v<T, dvec3>) return ValueType::triple;
    if constexpr (std::is_same_v<T, NumberRows>) return ValueType::rows;
    if constexpr (std::is_same_v<T, GradedTriple>) return ValueType::graded_triple;
    if constexpr (std::is_same_v<T, GradedNumber>)
        return facts.is_formula ? ValueType::formula : ValueType::graded;
    if constexpr (std::is_same_v<T, std::string>) {
        if (facts.is_lines) return ValueType::lines;
        if (facts.choices.empty()) return facts.is_path ? ValueType::path : ValueType::text;
    }
    return ValueType::choice;
}

template <typename T>
T from_value(const Value& value) {
    if constexpr (std::is_enum_v<T>) {
        const auto& list = choice_names(T{});
        const auto& word = std::get<std::string>(value);
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (list[i] == word) return static_cast<T>(i);
        }
        return T{};
    } else if constexpr (std::is_same_v<T, int>) {
        return static_cast<int>(std::get<std::int64_t>(value));
    } else {
        return std::get<T>(value);
    }
}

template <typename T>
Value to_value(const T& held) {
    if constexpr (std::is_enum_v<T>) {
        return choice_names(held)[static_cast<std::size_t>(held)];
    } else if constexpr (std::is_same_v<T, int>) {
        return static_cast<std::int64_t>(held);
    } else {
        return held;
    }
}

/// Makes a row without its access functions.
template <typename Held>
Setting described(std::string section, std::string key, std::string flag, SettingSpec facts) {
    Setting s;
    s.section = std::move(section);
    s.key = std::move(key);
    s.flag = std::move(flag);
    s.type = type_of<Held>(facts);
    if constexpr (std::is_enum_v<Held>) facts.choices = choice_names(Held{});
    s.unit = std::move(facts.unit);
    s.limits = facts.limits;
    s.choices = std::move(facts.choices);
    s.shape = facts.shape;
    s.fallback = std::move(facts.fallback);
    s.help = std::move(facts.help);
    return s;
}

/// Makes a row whose value is stored in one or several places of the recipe, and read from the first. A place
/// is a function from the recipe to a reference into it.
template <auto place, auto... others>
Setting row(std::string section, std::string key, std::string flag, SettingSpec facts) {
    using Held = std::remove_reference_t<decltype(place(std::declval<Recipe&>()))>;
    Setting s = described<Held>(std::move(section), std::move(key), std::move(flag), std::move(facts));
    s.store = [](Recipe& r, std::size_t, const Value& value) {
        place(r) = from_value<Held>(value);
        ((others(r) = place(r)), ...);
    };
    s.load = [](const Recipe& r, std::size_t) {
        Recipe copy = r;
        return to_value<Held>(place(copy));
    };
    return s;
}

/// Makes a row of an optional section: a member of the structure that `optional` holds.
template <auto optional, auto member>
Setting optional_row(std::string section, std::string key, std::string flag, SettingSpec facts) {
    using Whole = typename std::remove_reference_t<decltype(std::declval<Recipe&>().*optional)>::value_type;
    using Held = std::remove_reference_t<decltype(std::declval<Whole&>().*member)>;
    Setting s = described<Held>(std::move(section), std::move(key), std::move(flag), std::move(facts));
    s.store = [](Recipe& r, std::size_t, const Value& value) {
        auto& whole = r.*optional;
        // Not one expression with ?:, because g++ 12 then stores into a copy of plain structures.
        if (!whole) whole.emplace();
        (*whole).*member = from_value<Held>(value);
    };
    s.load = [](const Recipe& r, std::size_t) {
        const Whole absent;
        return to_value<Held>(r.*optional ? (*(r.*optional)).*member : absent.*member);
    };
    return s;
}

/// Makes a row of a list section: a member of each entry of `list`.
template <auto list, auto member>
Setting list_row(std::string section, std::string key, SettingSpec facts) {
    using Entry = typename std::remove_reference_t<decltype(std::declval<Recipe&>().*list)>::value_type;
    using Held = std::remove_reference_t<decltype(std::declval<Entry&>().*member)>;
    Setting s = described<Held>(std::move(section), std::move(key), "", std::move(facts));
    s.store = [](Recipe& r, std::size_t entry, const Value& value) {
        if ((r.*list).size() <= entry) (r.*list).resize(entry + 1);
        (r.*list)[entry].*member = from_value<Held>(value);
    };
    s.load = [](const Recipe& r, std::size_t entry) {
        return to_value<Held>(entry < (r.*list).size() ? (r.*list)[entry].*member : Entry{}.*member);
    };
    return s;
}

}  // namespace lamella
