// Reads TOML into a RecipeDraft; every mistake is reported with its line.
#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "engine/base/error.h"
#include "recipe/recipe_draft.h"
#include "recipe/toml_value.h"

namespace lamella {

namespace {

constexpr std::size_t largest_file = 1 << 20;

/// `kind`: "recipe" or "machine profile".
std::string read_whole(const std::string& path, const char* kind) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        throw InputError(fmt::format("{}: is a folder; a {} file (TOML) is needed", path, kind));
    }
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        throw InputError(
            fmt::format("{}: cannot be opened; a readable {} file (TOML) is needed", path, kind));
    }
    std::string text(largest_file + 1, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (file.bad()) throw InputError(path + ": cannot be read");
    text.resize(static_cast<std::size_t>(file.gcount()));
    if (text.size() > largest_file) {
        throw InputError(
            fmt::format("{}: has more than {} bytes, the limit for a {}", path, largest_file, kind));
    }
    return text;
}

std::string found_type(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::table:
            return "a table was found";
        case toml::node_type::array:
            return fmt::format("an array of {} was found", node.as_array()->size());
        case toml::node_type::string:
            return "a text was found";
        case toml::node_type::integer:
            return "a whole number was found";
        case toml::node_type::floating_point:
            return "a number with a fraction was found";
        case toml::node_type::boolean:
            return "true or false was found";
        default:
            return "a date or time was found";
    }
}

/// Keys are user input: truncated for messages.
std::string shown(std::string_view key) {
    std::string text;
    for (const char c : key.substr(0, 64))
        text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    return text;
}

}  // namespace

/// Walks a parsed recipe and passes assignments to a draft.
class TomlRecipe {
  public:
    TomlRecipe(RecipeDraft& draft, const std::string& path) : draft_(draft), path_(path) {}

    void read(const toml::table& root) {
        std::vector<std::string> known;
        for (const Section& section : sections()) known.push_back(section.name);
        for (const auto& [key, node] : root) {
            const std::string name(key.str());
            const int line = static_cast<int>(key.source().begin.line);
            if (const Section* section = find_section(name)) {
                section->is_list() ? read_list(*section, line, node) : read_section(*section, line, node);
            } else if (node.is_table() || node.is_array_of_tables()) {
                const std::string near = nearest(name, known);
                const std::string hint =
                    near.empty() ? "" : fmt::format(", did you mean `{}`?", find_section(near)->title());
                refuse(line, fmt::format("[{}]", shown(name)), "unknown section" + hint, section_titles());
            } else {
                refuse(line, shown(name), "stands outside a section" + belongs(name),
                       "keys below one of " + section_titles());
            }
        }
    }

    ProfileHead read_profile(const toml::table& root) {
        ProfileHead head;
        for (const auto& [key, node] : root) {
            const std::string name(key.str());
            const int line = static_cast<int>(key.source().begin.line);
            if (name == "description") {
                read_text(line, name, node, head.description);
            } else if (name == "based_on") {
                read_text(line, name, node, head.based_on);
                head.based_on_where = at(line, name);
            } else if (std::ranges::find(profile_sections, name) != profile_sections.end()) {
                in_profile_ = true;
                read_section(*find_section(name), line, node);
            } else {
                refuse(line, shown(name), misplaced_in_profile(name),
                       "description, based_on, [printer], [support], [check] and [host]");
            }
        }
        return head;
    }

  private:
    /// Describes the mistake of a key that stands outside the sections of a profile.
    static std::string misplaced_in_profile(const std::string& name) {
        for (const char* section : profile_sections) {
            if (find_setting(section, name))
                return fmt::format("stands outside a section, it belongs to [{}]", section);
        }
        std::vector<std::string> known{"description", "based_on"};
        known.insert(known.end(), profile_sections.begin(), profile_sections.end());
        const std::string near = nearest(name, known);
        return "is not a key of a machine profile" +
               (near.empty() ? "" : fmt::format(", did you mean `{}`?", near));
    }

    /// Reads a text key above the sections of a profile.
    void read_text(int line, const std::string& key, const toml::node& node, std::string& text) {
        const auto* given = node.as_string();
        const bool fine = given && !given->get().empty() && given->get().size() <= 1024 &&
                          std::all_of(given->get().begin(), given->get().end(), [](char c) {
                              return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
                          });
        if (fine) {
            text = given->get();
        } else {
            refuse(line, key, given ? "the text is empty, too long or of several lines" : found_type(node),
                   "a text of one line, at most 1024 bytes");
        }
    }

    std::string at(int line, const std::string& what) const {
        return fmt::format("{}:{}: {}", path_, line, what);
    }

    void refuse(int line, const std::string& what, const std::string& wrong, const std::string& right) {
        draft_.refuse(line, fmt::format("{}: {}; accepted: {}", at(line, what), wrong, right));
    }

    /// Returns ", it belongs to [foam]" when another section has the key.
    static std::string belongs(const std::string& key) {
        for (const Setting& setting : settings()) {
            if (setting.key == key) {
                return fmt::format(", `{}` belongs to {}", key, find_section(setting.section)->title());
            }
        }
        return "";
    }

    /// Returns ", it is `height` of [layers]" when the key is written like an option of the command.
    static std::string is_option(const std::string& key) {
        std::string flag = "--" + key;
        std::ranges::replace(flag, '_', '-');
        const auto meant = std::ranges::find(settings(), flag, &Setting::flag);
        if (meant == settings().end() || meant->key == key) return "";
        return fmt::format(", it is `{}` of {}", meant->key, find_section(meant->section)->title());
    }

    void read_section(const Section& section, int line, const toml::node& node) {
        const auto* table = node.as_table();
        if (!table) {
            refuse(line, section.name, found_type(node),
                   fmt::format("a section {} with keys", section.title()));
            return;
        }
        read_table(section.name, 0, line, *table);
    }

    void read_list(const Section& section, int line, const toml::node& node) {
        const auto* list = node.as_array();
        if (!list) {
            refuse(line, section.name, found_type(node),
                   fmt::format("a section {} with keys, as often as wanted", section.title()));
            return;
        }
        std::size_t number = draft_.count(section);
        for (const toml::node& part : *list) {
            const int begin = static_cast<int>(part.source().begin.line);
            if (const auto* table = part.as_table()) {
                read_table(section.name, number++, begin, *table);
            } else {
                refuse(begin, section.name, found_type(part),
                       fmt::format("sections {} with keys", section.title()));
            }
        }
    }

    /// Reads the keys of a section, or of one entry of a list section.
    void read_table(const std::string& section, std::size_t number, int line, const toml::table& table) {
        draft_.sections_[{section, number}] = at(line, section);
        for (const auto& [key, child] : table) {
            read_key(section, number, std::string(key.str()), static_cast<int>(key.source().begin.line),
                     child);
        }
    }

    void read_key(const std::string& section, std::size_t number, const std::string& key, int line,
                  const toml::node& node) {
        const Setting* setting = find_setting(section, key);
        if (!setting) return refuse_key(section, number, key, line);
        if (in_profile_ && setting->name() == "printer.profile") {
            return refuse(line, setting->name(), "belongs in a recipe, not in a profile",
                          "based_on, above the sections");
        }
        if (in_profile_ && belongs_in_recipe(*setting)) {
            return refuse(line, setting->name(),
                          "belongs in a recipe: a profile only sets dimensions of supports",
                          "the other keys of [support]");
        }
        const std::string where = at(line, setting->name());
        const auto value = value_of(*setting, node);
        std::optional<std::string> wrong = value ? objection(*setting, *value) : found_type(node);
        if (!wrong) return draft_.set(*setting, number, located(*setting, *value), where, false);
        refuse(line, setting->name(), *wrong, accepted(*setting));
        draft_.entries_[{section, number, key}] = {std::nullopt, where, false};
    }

    void refuse_key(const std::string& section, std::size_t number, const std::string& key, int line) {
        std::vector<std::string> known;
        std::string listing;
        for (const Setting& setting : settings()) {
            if (setting.section != section) continue;
            known.push_back(setting.key);
            listing += (listing.empty() ? "" : ", ") + setting.key;
        }
        const std::string option = is_option(key), near = option.empty() ? nearest(key, known) : "";
        const std::string hint = !option.empty() ? option
                                 : near.empty()  ? belongs(key)
                                                 : fmt::format(", did you mean `{}`?", near);
        refuse(line, section + "." + shown(key), "unknown key" + hint, listing);
        // The intended key is not also reported as missing: one mistake, one message.
        if (!near.empty()) draft_.entries_.try_emplace({section, number, near});
    }

    /// Resolves a path relative to the recipe's folder.
    Value located(const Setting& setting, const Value& value) const {
        const bool is_file =
            setting.name() == "printer.profile" && names_profile_file(std::get<std::string>(value));
        if (setting.type != ValueType::path && !is_file) return value;
        const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
        return (folder / std::get<std::string>(value)).lexically_normal().string();
    }

    RecipeDraft& draft_;
    const std::string& path_;
    bool in_profile_ = false;
};

void RecipeDraft::read_file(const std::string& path) { read_text(read_whole(path, "recipe"), path); }

void RecipeDraft::read_text(std::string_view text, const std::string& path) {
    const toml::table root = parse_toml(text, path);
    TomlRecipe(*this, path).read(root);
}

ProfileHead RecipeDraft::read_profile_file(const std::string& path) {
    return read_profile(read_whole(path, "machine profile"), path);
}

ProfileHead RecipeDraft::read_profile(std::string_view text, const std::string& path) {
    const toml::table root = parse_toml(text, path);
    return TomlRecipe(*this, path).read_profile(root);
}

}  // namespace lamella
