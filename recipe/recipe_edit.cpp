// Finds where keys and sections stand by the parser's positions, and replaces that text alone.
#include "recipe/recipe_edit.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"
#include "recipe/toml_value.h"

namespace lamella {

namespace {

constexpr const char* source_name = "recipe";

/// The text of a recipe and the beginnings of its lines, which count from 1.
class LinedText {
  public:
    explicit LinedText(const std::string& text) : text_(text) {
        for (std::size_t at = 0; at < text.size(); ++at)
            if (text[at] == '\n') begins_.push_back(at + 1);
    }

    std::size_t lines() const { return begins_.size(); }
    std::size_t begin(std::size_t line) const {
        return line <= begins_.size() ? begins_[line - 1] : text_.size();
    }
    std::string_view line(std::size_t line) const {
        return std::string_view(text_).substr(begin(line), begin(line + 1) - begin(line));
    }
    /// Returns the byte of a position. Columns count characters, not bytes.
    std::size_t offset(const toml::source_position& position) const {
        std::size_t at = begin(position.line);
        for (std::size_t column = 1; column < position.column && at < text_.size(); ++column) {
            ++at;
            while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xC0U) == 0x80U) ++at;
        }
        return at;
    }

  private:
    const std::string& text_;
    std::vector<std::size_t> begins_{0};
};

/// Returns the line of the next section's header after a line, or of the comments above it; one line past
/// the end where none follows.
std::size_t next_section(const toml::table& root, const LinedText& text, std::size_t after) {
    std::size_t next = text.lines() + 1;
    const auto consider = [&](const toml::node& node) {
        if (node.source().begin.line > after) next = std::min<std::size_t>(next, node.source().begin.line);
    };
    for (const auto& [key, node] : root) {
        if (const auto* list = node.as_array()) {
            for (const toml::node& entry : *list) consider(entry);
        } else {
            consider(node);
        }
    }
    while (next <= text.lines() && next > after + 1 && text.line(next - 1).starts_with('#')) --next;
    return next;
}

/// Returns the table of a section or an entry; null where it is missing.
const toml::table* find_table(const toml::table& root, const Section& section, std::size_t entry) {
    const toml::node* node = root.get(section.name);
    if (node == nullptr) return nullptr;
    if (section.is_list()) {
        const auto* list = node->as_array();
        node = list != nullptr && entry < list->size() ? list->get(entry) : nullptr;
        if (node == nullptr) return nullptr;
    }
    const auto* table = node->as_table();
    if (table == nullptr || table->is_inline()) {
        throw InputError(fmt::format("{}: is written in one line; accepted: {} with a line for each key",
                                     section.name, section.title()));
    }
    return table;
}

std::size_t entry_count(const toml::table& root, const Section& section) {
    const toml::node* node = root.get(section.name);
    const auto* list = node != nullptr ? node->as_array() : nullptr;
    return list != nullptr ? list->size() : 0;
}

const Section& known_section(const std::string& name) {
    const Section* section = find_section(name);
    if (section == nullptr)
        throw InputError(fmt::format("{}: unknown section; accepted: {}", name, section_titles()));
    return *section;
}

std::string literal_of(const RecipeChange& change) {
    const Setting* setting = find_setting(change.section, change.key);
    if (setting == nullptr)
        throw InputError(
            fmt::format("{}.{}: unknown key; accepted: a key of the reference", change.section, change.key));
    std::string wrong;
    const auto value = parse_value(*setting, *change.value, wrong);
    if (!value)
        throw InputError(fmt::format("{}: {}; accepted: {}", setting->name(), wrong, accepted(*setting)));
    return toml_literal(*setting, *value);
}

/// Inserts whole lines before a line.
void insert_lines(std::string& text, const LinedText& lines, std::size_t before, std::string added) {
    const std::size_t at = lines.begin(before);
    if (at > 0 && text[at - 1] != '\n') added = "\n" + added;
    text.insert(at, added);
}

void erase_lines(std::string& text, const LinedText& lines, std::size_t first, std::size_t last) {
    text.erase(lines.begin(first), lines.begin(last + 1) - lines.begin(first));
}

/// Adds a section at the end, a line apart from what stands there.
void append_section(std::string& text, const std::string& content) {
    if (!text.empty() && text.back() != '\n') text += '\n';
    if (!text.empty() && !text.ends_with("\n\n")) text += '\n';
    text += content;
}

void remove_section(std::string& text, const toml::table& root, const toml::table& table) {
    const LinedText lines(text);
    const std::size_t first = table.source().begin.line;
    erase_lines(text, lines, first, next_section(root, lines, first) - 1);
}

void set_key(std::string& text, const toml::table& table, const RecipeChange& change) {
    const LinedText lines(text);
    const toml::node* old = table.get(change.key);
    if (old != nullptr && change.value) {
        const std::size_t begin = lines.offset(old->source().begin), end = lines.offset(old->source().end);
        text.replace(begin, end - begin, literal_of(change));
    } else if (old != nullptr) {
        const auto key =
            std::ranges::find_if(table, [&](const auto& item) { return item.first.str() == change.key; });
        erase_lines(text, lines, key->first.source().begin.line, old->source().end.line);
    } else if (change.value) {
        std::size_t last = table.source().begin.line;
        for (const auto& [key, node] : table)
            last = std::max<std::size_t>({last, key.source().begin.line, node.source().end.line});
        insert_lines(text, lines, last + 1, change.key + " = " + literal_of(change) + "\n");
    }
}

void apply(std::string& text, const RecipeChange& change) {
    const toml::table root = parse_toml(text, source_name);
    const Section& section = known_section(change.section);
    const toml::table* table = find_table(root, section, change.entry);
    if (table != nullptr && change.key.empty()) {
        if (!change.value) remove_section(text, root, *table);
    } else if (table != nullptr) {
        set_key(text, *table, change);
    } else if (section.is_list() && change.entry > entry_count(root, section)) {
        throw InputError(fmt::format("{}: entry {} does not exist; accepted: 0 to {}", section.title(),
                                     change.entry, entry_count(root, section)));
    } else if (change.key.empty() && change.value) {
        append_section(text, section.title() + "\n");
    } else if (change.value) {
        append_section(text, section.title() + "\n" + change.key + " = " + literal_of(change) + "\n");
    }
}

void add_keys(const toml::table& table, const Section& section, std::size_t entry,
              std::vector<GivenKey>& found) {
    for (const auto& [key, node] : table) {
        const Setting* setting = find_setting(section.name, key.str());
        if (setting == nullptr) continue;
        const auto value = value_of(*setting, node);
        found.push_back({section.name, entry, std::string(key.str()), value ? format_value(*value) : "",
                         static_cast<int>(key.source().begin.line)});
    }
}

}  // namespace

std::string edited_recipe(std::string text, std::span<const RecipeChange> changes) {
    for (const RecipeChange& change : changes) apply(text, change);
    return text;
}

std::vector<GivenKey> given_keys(std::string_view text) {
    const toml::table root = parse_toml(text, source_name);
    std::vector<GivenKey> found;
    for (const Section& section : sections()) {
        const toml::node* node = root.get(section.name);
        if (node == nullptr) continue;
        if (const auto* table = node->as_table()) add_keys(*table, section, 0, found);
        const auto* list = node->as_array();
        for (std::size_t i = 0; list != nullptr && i < list->size(); ++i)
            if (const auto* table = list->get(i)->as_table()) add_keys(*table, section, i, found);
    }
    std::ranges::stable_sort(found, {}, &GivenKey::line);
    return found;
}

}  // namespace lamella
