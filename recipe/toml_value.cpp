// Converts between TOML and the values of settings, both ways.
#include "recipe/toml_value.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"
#include "recipe/toml_depth.h"

namespace lamella {

namespace {

std::optional<double> number(const toml::node& node) {
    if (const auto* floating = node.as_floating_point()) return floating->get();
    if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
    return std::nullopt;
}

std::optional<Value> triple(const toml::node& node) {
    const auto* array = node.as_array();
    if (!array || array->size() != 3) return std::nullopt;
    dvec3 v{0};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto part = number((*array)[i]);
        if (!part) return std::nullopt;
        v[static_cast<glm::length_t>(i)] = *part;
    }
    return v;
}

std::optional<Value> graded(const toml::node& node) {
    if (const auto v = number(node)) return GradedNumber{*v, ""};
    if (const auto* v = node.as_string()) return GradedNumber{v->get(), ""};
    return std::nullopt;
}

std::optional<Value> graded_triple(const toml::node& node) {
    const auto* array = node.as_array();
    GradedTriple triple;
    if (!array || array->size() != triple.size()) return std::nullopt;
    for (std::size_t i = 0; i < triple.size(); ++i) {
        const auto part = graded((*array)[i]);
        if (!part) return std::nullopt;
        triple[i] = std::get<GradedNumber>(*part);
    }
    return triple;
}

/// Appends the numbers of an array and of nested arrays. Returns true if it contains nothing else.
bool flatten(const toml::node& node, std::vector<double>& out, int depth = 0) {
    if (const auto one = number(node)) {
        out.push_back(*one);
        return depth > 0;
    }
    const auto* array = node.as_array();
    if (!array || depth > 1) return false;
    return std::all_of(array->begin(), array->end(),
                       [&](const toml::node& part) { return flatten(part, out, depth + 1); });
}

std::optional<Value> rows(const toml::node& node, const RowShape& shape) {
    const auto* array = node.as_array();
    if (!array) return std::nullopt;
    NumberRows rows;
    if (shape.rows == 1) {  // a single row needs no inner brackets
        if (!flatten(node, rows.emplace_back())) return std::nullopt;
        return rows;
    }
    for (const toml::node& part : *array) {
        if (!flatten(part, rows.emplace_back())) return std::nullopt;
    }
    return rows;
}

/// Joins lines by line feeds, whatever line ending the recipe uses.
std::optional<Value> lines(const toml::node& node) {
    std::string text;
    if (const auto* whole = node.as_string()) {
        text = whole->get();
        std::erase(text, '\r');
        while (text.ends_with('\n')) text.pop_back();
        return text;
    }
    const auto* array = node.as_array();
    if (!array) return std::nullopt;
    for (const toml::node& part : *array) {
        const auto* line = part.as_string();
        if (!line) return std::nullopt;
        if (&part != &array->front()) text += '\n';
        text += line->get();
    }
    return text;
}

/// Returns a text as an array of its lines.
std::string quoted_lines(std::string_view text) {
    std::string out;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        out += (at > 0 ? ", " : "") + toml_quoted(text.substr(at, end - at));
        at = end + 1;
    }
    return "[" + out + "]";
}

std::string literal_of(const GradedNumber& number) {
    return number.is_formula() ? toml_quoted(number.formula()) : fmt::format("{}", number.number());
}

template <typename List, typename Literal>
std::string array_of(const List& list, const Literal& literal) {
    std::string out;
    for (const auto& one : list) out += (out.empty() ? "" : ", ") + literal(one);
    return "[" + out + "]";
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& path) {
    require_shallow_toml(text, path);
    try {
        return toml::parse(text, path);
    } catch (const toml::parse_error& error) {
        const auto begin = error.source().begin;
        throw InputError(
            fmt::format("{}:{}:{}: not valid TOML: {}", path, begin.line, begin.column, error.description()));
    }
}

std::optional<Value> value_of(const Setting& setting, const toml::node& node) {
    switch (setting.type) {
        case ValueType::boolean:
            if (const auto* v = node.as_boolean()) return v->get();
            break;
        case ValueType::integer:
            if (const auto* v = node.as_integer()) return v->get();
            break;
        case ValueType::number:
            if (const auto v = number(node)) return *v;
            break;
        case ValueType::text:
        case ValueType::path:
        case ValueType::choice:
            if (const auto* v = node.as_string()) return v->get();
            break;
        case ValueType::lines:
            return lines(node);
        case ValueType::triple:
            return triple(node);
        case ValueType::graded:
            return graded(node);
        case ValueType::graded_triple:
            return graded_triple(node);
        case ValueType::formula:
            if (const auto* v = node.as_string()) return GradedNumber{v->get(), ""};
            break;
        case ValueType::rows:
            return rows(node, setting.shape);
    }
    return std::nullopt;
}

std::string toml_quoted(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
        } else {
            out += c;
        }
    }
    return out + "\"";
}

std::string toml_literal(const Setting& setting, const Value& value) {
    struct Format {
        bool has_lines;
        std::string operator()(bool v) const { return v ? "true" : "false"; }
        std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
        std::string operator()(double v) const { return fmt::format("{}", v); }
        std::string operator()(const std::string& v) const {
            return has_lines && !v.empty() ? quoted_lines(v) : toml_quoted(v);
        }
        std::string operator()(const dvec3& v) const { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }
        std::string operator()(const GradedNumber& v) const { return literal_of(v); }
        std::string operator()(const GradedTriple& v) const {
            return array_of(v, [](const GradedNumber& one) { return literal_of(one); });
        }
        std::string operator()(const NumberRows& v) const {
            return array_of(v, [](const auto& row) {
                return array_of(row, [](double one) { return fmt::format("{}", one); });
            });
        }
    };
    return std::visit(Format{setting.type == ValueType::lines}, value);
}

}  // namespace lamella
