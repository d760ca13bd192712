// Parses, checks and describes values by the settings table.
#include "recipe/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "engine/base/error.h"

namespace lamella {

namespace {

constexpr std::size_t longest_text = 4096;
constexpr std::size_t longest_formula = 1 << 16;
constexpr std::size_t longest_script = 1 << 16;
constexpr std::size_t max_rows = 1 << 16;

std::string with_unit(const Setting& setting) { return setting.unit.empty() ? "" : " " + setting.unit; }

std::string range_text(const Setting& setting) {
    if (setting.limits.lo == -infinity && setting.limits.hi == infinity) return "";
    return fmt::format(" from {} to {}", setting.limits.lo, setting.limits.hi);
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

std::optional<std::string> range_objection(const Setting& setting, double v) {
    if (!std::isfinite(v)) return fmt::format("{} is not a finite number", v);
    if (v < setting.limits.lo) return fmt::format("{} is too small", v);
    if (v > setting.limits.hi) return fmt::format("{} is too large", v);
    return std::nullopt;
}

std::optional<std::string> text_objection(const std::string& text, std::size_t longest = longest_text) {
    if (text.empty()) return "the text is empty";
    if (text.size() > longest) return fmt::format("the text has more than {} bytes", longest);
    const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    if (std::any_of(text.begin(), text.end(), control)) return "the text holds control characters";
    return std::nullopt;
}

/// Lines are printable ASCII: machines take no other bytes.
std::optional<std::string> lines_objection(const std::string& text) {
    if (text.find_first_not_of('\n') == std::string::npos) return "it has no line";
    if (text.size() > longest_script) return fmt::format("it has more than {} bytes", longest_script);
    int line = 1;
    for (const char c : text) {
        if (c == '\n') {
            ++line;
        } else if (c < ' ' || c > '~') {
            return fmt::format("line {} holds a character that is not printable ASCII", line);
        }
    }
    return std::nullopt;
}

/// Formulas may span several lines.
std::optional<std::string> formula_objection(std::string text) {
    const auto white = [](char c) { return c == '\n' || c == '\r' || c == '\t'; };
    std::replace_if(text.begin(), text.end(), white, ' ');
    if (text.find_first_not_of(' ') == std::string::npos) return "the formula is empty";
    return text_objection(text, longest_formula);
}

std::optional<std::string> graded_objection(const Setting& setting, const GradedNumber& graded) {
    return graded.is_formula() ? formula_objection(graded.formula())
                               : range_objection(setting, graded.number());
}

std::optional<std::string> rows_objection(const Setting& setting, const NumberRows& rows) {
    const RowShape& shape = setting.shape;
    if (rows.empty()) return "it is empty";
    if (rows.size() > max_rows) return fmt::format("it has more than {} rows", max_rows);
    if (shape.rows != 0 && rows.size() != shape.rows) {
        return fmt::format("the number of rows is {} instead of {}", rows.size(), shape.rows);
    }
    for (const auto& row : rows) {
        if (row.size() != shape.columns) {
            return fmt::format("the number of values in a row is {} instead of {}", row.size(),
                               shape.columns);
        }
        for (const double v : row) {
            if (auto wrong = range_objection(setting, v)) return wrong;
        }
    }
    return std::nullopt;
}

std::string rows_text(const NumberRows& rows) {
    std::string text;
    for (const auto& row : rows) text += fmt::format("{}{}", text.empty() ? "" : ";", fmt::join(row, ","));
    return text;
}

template <typename T>
std::optional<T> entire(std::string_view text) {
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    T number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

/// Returns a number if the text is one, otherwise a formula.
GradedNumber parse_graded(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(' ');
    const std::size_t end = text.find_last_not_of(' ');
    if (begin != std::string_view::npos) {
        if (const auto number = entire<double>(text.substr(begin, end - begin + 1))) return {*number, ""};
    }
    return {std::string(text), ""};
}

/// Parses three separated by commas; commas within brackets belong to a formula.
std::optional<GradedTriple> parse_graded_triple(std::string_view text) {
    GradedTriple triple;
    std::size_t count = 0, begin = 0;
    int depth = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size()) depth += (text[i] == '(') - (text[i] == ')');
        if (i < text.size() && !(text[i] == ',' && depth <= 0)) continue;
        if (count == triple.size()) return std::nullopt;
        triple[count++] = parse_graded(text.substr(begin, i - begin));
        begin = i + 1;
    }
    if (count != triple.size()) return std::nullopt;
    return triple;
}

/// Parses rows separated by semicolons.
std::optional<NumberRows> parse_rows(std::string_view text, std::size_t columns) {
    NumberRows rows;
    while (rows.size() <= max_rows) {
        const std::size_t end = text.find(';');
        auto row = parse_numbers(text.substr(0, end), columns);
        if (!row) return std::nullopt;
        rows.push_back(std::move(*row));
        if (end == std::string_view::npos) return rows;
        text.remove_prefix(end + 1);
    }
    return std::nullopt;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
        }
    }
    return row[b.size()];
}

}  // namespace

bool belongs_in_recipe(const Setting& setting) {
    constexpr std::array<std::string_view, 5> keys{"printer.profile", "support.kind", "support.tool",
                                                   "support.interface_tool", "support.interface"};
    return std::ranges::find(keys, setting.name()) != keys.end();
}

const Section* find_section(std::string_view name) {
    for (const Section& section : sections()) {
        if (section.name == name) return &section;
    }
    return nullptr;
}

std::string section_titles() {
    std::string text;
    for (const Section& section : sections()) text += (text.empty() ? "" : ", ") + section.title();
    return text;
}

const Setting* find_setting(std::string_view section, std::string_view key) {
    for (const Setting& setting : settings()) {
        if (setting.section == section && setting.key == key) return &setting;
    }
    return nullptr;
}

std::string accepted(const Setting& setting) {
    switch (setting.type) {
        case ValueType::boolean:
            return "true or false";
        case ValueType::integer: {
            if (setting.limits.hi > 1e15) return "a whole number from 0 to 9223372036854775807";
            return "a whole number" + range_text(setting) + with_unit(setting);
        }
        case ValueType::number:
            return "a number" + range_text(setting) + with_unit(setting);
        case ValueType::text:
            return "a text";
        case ValueType::lines:
            return "a list of lines, or a text of several lines";
        case ValueType::path:
            return "a path";
        case ValueType::choice:
            return "one of " + joined(setting.choices);
        case ValueType::triple:
            return "three numbers" + range_text(setting) + with_unit(setting);
        case ValueType::graded:
            return "a number" + range_text(setting) + with_unit(setting) + " or a formula";
        case ValueType::graded_triple:
            return "three numbers" + range_text(setting) + with_unit(setting) + " or formulas";
        case ValueType::formula:
            return "a formula";
        case ValueType::rows:
            return setting.shape.form + range_text(setting) + with_unit(setting);
    }
    return {};
}

std::optional<std::string> objection(const Setting& setting, const Value& value) {
    switch (setting.type) {
        case ValueType::boolean:
            return std::nullopt;
        case ValueType::integer: {
            const std::int64_t v = std::get<std::int64_t>(value);
            if (static_cast<double>(v) < setting.limits.lo) return fmt::format("{} is too small", v);
            if (static_cast<double>(v) > setting.limits.hi) return fmt::format("{} is too large", v);
            return std::nullopt;
        }
        case ValueType::number:
            return range_objection(setting, std::get<double>(value));
        case ValueType::text:
        case ValueType::path:
            return text_objection(std::get<std::string>(value));
        case ValueType::lines:
            return lines_objection(std::get<std::string>(value));
        case ValueType::choice: {
            const auto& word = std::get<std::string>(value);
            const auto& list = setting.choices;
            if (std::find(list.begin(), list.end(), word) != list.end()) return std::nullopt;
            const std::string near = nearest(word, list);
            return fmt::format("\"{}\" is unknown", word.substr(0, 64)) +
                   (near.empty() ? "" : fmt::format(", did you mean `{}`?", near));
        }
        case ValueType::triple: {
            const dvec3 v = std::get<dvec3>(value);
            for (int i = 0; i < 3; ++i) {
                if (auto wrong = range_objection(setting, v[i])) return wrong;
            }
            return std::nullopt;
        }
        case ValueType::graded:
        case ValueType::formula:
            return graded_objection(setting, std::get<GradedNumber>(value));
        case ValueType::graded_triple: {
            for (const GradedNumber& graded : std::get<GradedTriple>(value)) {
                if (auto wrong = graded_objection(setting, graded)) return wrong;
            }
            return std::nullopt;
        }
        case ValueType::rows:
            return rows_objection(setting, std::get<NumberRows>(value));
    }
    return std::nullopt;
}

std::optional<Value> parse_value(const Setting& setting, const std::string& text, std::string& wrong) {
    std::optional<Value> value;
    switch (setting.type) {
        case ValueType::boolean:
            if (text == "true" || text == "false") value = text == "true";
            break;
        case ValueType::integer:
            if (const auto number = entire<std::int64_t>(text)) value = *number;
            break;
        case ValueType::number:
            if (const auto number = entire<double>(text)) value = *number;
            break;
        case ValueType::text:
        case ValueType::lines:
        case ValueType::path:
        case ValueType::choice:
            value = text;
            break;
        case ValueType::graded:
            value = parse_graded(text);
            break;
        case ValueType::graded_triple:
            if (const auto triple = parse_graded_triple(text)) value = *triple;
            break;
        case ValueType::formula:
            value = GradedNumber{text, ""};
            break;
        case ValueType::rows:
            if (const auto rows = parse_rows(text, setting.shape.columns)) value = *rows;
            break;
        case ValueType::triple:
            if (const auto three = parse_numbers(text, 3))
                value = dvec3((*three)[0], (*three)[1], (*three)[2]);
            break;
    }
    if (!value) {
        wrong = fmt::format("\"{}\" cannot be read", text.substr(0, 64));
        return std::nullopt;
    }
    if (const auto found = objection(setting, *value)) {
        wrong = *found;
        return std::nullopt;
    }
    return value;
}

std::string format_value(const Value& value) {
    struct Format {
        std::string operator()(bool v) const { return v ? "true" : "false"; }
        std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
        std::string operator()(double v) const { return fmt::format("{}", v); }
        std::string operator()(const std::string& v) const { return v; }
        std::string operator()(const dvec3& v) const { return fmt::format("{},{},{}", v.x, v.y, v.z); }
        std::string operator()(const GradedNumber& v) const {
            return v.is_formula() ? v.formula() : fmt::format("{}", v.number());
        }
        std::string operator()(const GradedTriple& v) const {
            return (*this)(v[0]) + "," + (*this)(v[1]) + "," + (*this)(v[2]);
        }
        std::string operator()(const NumberRows& v) const { return rows_text(v); }
    };
    return std::visit(Format{}, value);
}

std::optional<std::vector<double>> parse_numbers(std::string_view text, std::size_t count) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t comma = text.find(',');
        const bool last = comma == std::string_view::npos;
        if (last != (i + 1 == count)) return std::nullopt;
        const auto number = entire<double>(text.substr(0, comma));
        if (!number) return std::nullopt;
        numbers.push_back(*number);
        text = last ? std::string_view() : text.substr(comma + 1);
    }
    return numbers;
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
    if (word.size() > 64) return {};
    std::string best;
    std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        const std::size_t d = edit_distance(word, candidate);
        if (d < least && d < candidate.size()) {
            least = d;
            best = candidate;
        }
    }
    return best;
}

namespace {

/// Escapes text for a cell of a Markdown table.
std::string table_cell(const std::string& text) {
    std::string cell;
    for (const char c : text) {
        if (c == '|' || c == '<') cell += '\\';
        cell += c;
    }
    return cell;
}

}  // namespace

std::string settings_reference(std::string_view only_section) {
    std::string text, known;
    for (const Section& section : sections()) {
        known += (known.empty() ? "" : ", ") + section.name;
        if (!only_section.empty() && section.name != only_section) continue;
        text += fmt::format("{}{}  {}\n", text.empty() ? "" : "\n", section.title(), section.help);
        for (const Setting& s : settings()) {
            if (s.section != section.name) continue;
            text += fmt::format("  {:<20}{}\n", s.key, s.help);
            text += fmt::format("  {:<20}{}; default: {}{}\n", "", accepted(s), s.fallback,
                                s.flag.empty() ? "" : "; flag: " + s.flag);
        }
    }
    if (text.empty())
        throw InputError(fmt::format("a recipe has no section `{}`; its sections: {}", only_section, known));
    return text;
}

std::string settings_markdown() {
    std::string text =
        "# Keys of a recipe\n"
        "\n"
        "Made by `lamella keys --markdown`. A flag stands for its key on the command line.\n";
    for (const Section& section : sections()) {
        text += fmt::format(
            "\n"
            "## {}\n"
            "\n"
            "{}\n"
            "\n"
            "| key | what it is | accepts | default | flag |\n"
            "|---|---|---|---|---|\n",
            section.title(), section.help);
        for (const Setting& s : settings()) {
            if (s.section != section.name) continue;
            text += fmt::format("| `{}` | {} | {} | {} | {} |\n", s.key, table_cell(s.help),
                                table_cell(accepted(s)), table_cell(s.fallback),
                                s.flag.empty() ? "" : "`" + s.flag + "`");
        }
    }
    return text;
}

}  // namespace lamella
