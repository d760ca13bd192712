// Recursive-descent parser: one function per level of precedence; tokens are read on demand.
#include "engine/formula/formula_parser.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>

#include "engine/base/error.h"
#include "engine/formula/formula_builder.h"
#include "engine/formula/formula_functions.h"

namespace lamella {
namespace {

using Node = FormulaBuilder::Node;

constexpr std::size_t max_text = 1 << 20;
constexpr int deepest = 200;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Returns the edit distance between two words.
std::size_t edits(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t swap = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({swap, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

/// Returns ", did you mean `sqrt`?" if a candidate is within two edits and the word is not changed
/// completely.
template <class Words>
std::string hint(std::string_view word, const Words& candidates) {
    constexpr std::size_t longest = 40;
    if (word.size() > longest) return "";
    std::size_t least = std::min<std::size_t>(3, word.size());
    std::string_view best;
    for (const std::string_view candidate : candidates) {
        if (candidate.size() > longest) continue;
        const std::size_t distance = edits(word, candidate);
        if (distance >= least) continue;
        least = distance;
        best = candidate;
    }
    return best.empty() ? "" : ", did you mean `" + std::string(best) + "`?";
}

std::string shown(std::string_view name) {
    constexpr std::size_t longest = 60;
    return "`" + std::string(name.substr(0, longest)) + (name.size() > longest ? "...`" : "`");
}

class Parser {
  public:
    /// Returns the input of a name, or nothing if the name means a constant. Throws InputError for an unknown
    /// name.
    using Lookup = std::function<std::optional<int>(std::string_view name, std::size_t column)>;

    Parser(std::string_view text, Lookup lookup) : text_(text), lookup_(std::move(lookup)) {}

    Formula parse() {
        if (text_.size() > max_text) throw InputError("a formula has at most 1 MB of text");
        if (peek() == '\0' && at_ == text_.size()) fail(at_, "the formula is empty");
        const Node result = choice();
        skip_blanks();
        if (at_ < text_.size()) fail(at_, "expected an operator or the end of the formula, found " + found());
        return builder_.finish(result);
    }

  private:
    [[noreturn]] static void fail(std::size_t at, const std::string& message) {
        throw InputError("column " + std::to_string(at + 1) + ": " + message);
    }

    /// Limits the recursion: the text may be hostile.
    class Level {
      public:
        explicit Level(Parser& parser) : parser_(parser) {
            if (++parser_.depth_ > deepest)
                fail(parser_.at_, "parts are nested more than " + std::to_string(deepest) + " deep");
        }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;
        ~Level() { --parser_.depth_; }

      private:
        Parser& parser_;
    };

    void skip_blanks() {
        while (at_ < text_.size() &&
               (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
            ++at_;
    }
    char peek() {
        skip_blanks();
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    std::string found() {
        skip_blanks();
        if (at_ >= text_.size()) return "the end";
        const std::string_view name = name_here();
        if (!name.empty()) return shown(name);
        const auto byte = static_cast<unsigned char>(text_[at_]);
        return byte > ' ' && byte < 127 ? "`" + std::string(1, text_[at_]) + "`"
                                        : "a character that has no meaning here";
    }
    bool take(std::string_view sign) {
        skip_blanks();
        if (text_.substr(at_, sign.size()) != sign) return false;
        at_ += sign.size();
        return true;
    }
    /// Returns the name at the current position without consuming it; empty when there is none.
    std::string_view name_here() {
        skip_blanks();
        std::size_t end = at_;
        if (end < text_.size() && is_letter(text_[end])) {
            while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]) || text_[end] == '.'))
                ++end;
        }
        return text_.substr(at_, end - at_);
    }
    bool take_word(std::string_view word) {
        if (name_here() != word) return false;
        at_ += word.size();
        return true;
    }
    void expect(char sign) {
        if (peek() != sign) fail(at_, std::string("expected `") + sign + "`, found " + found());
        ++at_;
    }

    Node choice() {
        const Level level(*this);
        const Node condition = disjunction();
        if (!take("?")) return condition;
        const Node yes = choice();
        expect(':');
        return builder_.select(condition, yes, choice());
    }

    Node disjunction() {
        Node a = conjunction();
        while (take("||") || take_word("or")) a = builder_.binary(FormulaOp::logic_or, a, conjunction());
        return a;
    }

    Node conjunction() {
        Node a = negation();
        while (take("&&") || take_word("and")) a = builder_.binary(FormulaOp::logic_and, a, negation());
        return a;
    }

    Node negation() {
        if (!take_word("not")) return comparison();
        const Level level(*this);
        return builder_.unary(FormulaOp::logic_not, negation());
    }

    /// Consumes and returns the comparison sign at the current position; empty when there is none.
    std::string_view comparison_sign() {
        for (const std::string_view sign : {"<=", ">=", "==", "!=", "<", ">"}) {
            if (take(sign)) return sign;
        }
        return {};
    }

    Node comparison() {
        const Node a = sum();
        const std::string_view sign = comparison_sign();
        if (sign.empty()) return a;
        const Node b = sum();
        skip_blanks();
        const std::size_t second = at_;
        if (!comparison_sign().empty())
            fail(second, "comparisons do not chain: write `a < b and b < c` instead of `a < b < c`");
        if (sign == "<") return builder_.binary(FormulaOp::less, a, b);
        if (sign == "<=") return builder_.binary(FormulaOp::less_equal, a, b);
        if (sign == ">") return builder_.binary(FormulaOp::less, b, a);
        if (sign == ">=") return builder_.binary(FormulaOp::less_equal, b, a);
        const Node equal = builder_.binary(FormulaOp::equal, a, b);
        return sign == "==" ? equal : builder_.unary(FormulaOp::logic_not, equal);
    }

    Node sum() {
        Node a = product();
        for (;;) {
            if (take("+")) {
                a = builder_.binary(FormulaOp::add, a, product());
            } else if (take("-")) {
                a = builder_.binary(FormulaOp::sub, a, product());
            } else {
                return a;
            }
        }
    }

    Node product() {
        Node a = factor();
        for (;;) {
            if (take("*")) {
                a = builder_.binary(FormulaOp::mul, a, factor());
            } else if (take("/")) {
                a = builder_.binary(FormulaOp::div, a, factor());
            } else if (take("%")) {
                a = builder_.binary(FormulaOp::mod, a, factor());
            } else {
                return a;
            }
        }
    }

    Node factor() {
        if (take("-")) return builder_.unary(FormulaOp::neg, operand());
        if (take("+")) return operand();
        if (peek() == '!' && text_.substr(at_, 2) != "!=") {
            ++at_;
            return builder_.unary(FormulaOp::logic_not, operand());
        }
        const Node base = primary();
        if (!take("^")) return base;
        return builder_.binary(FormulaOp::pow, base, operand());
    }

    Node operand() {
        const Level level(*this);
        return factor();
    }

    Node primary() {
        const char c = peek();
        if (c == '(') {
            ++at_;
            const Node inner = choice();
            expect(')');
            return inner;
        }
        if (is_digit(c) || c == '.') return number();
        const std::string_view name = name_here();
        if (name.empty() || name == "and" || name == "or" || name == "not")
            fail(at_, "expected a number, a name or `(`, found " + found());
        const std::size_t start = at_;
        at_ += name.size();
        return peek() == '(' ? call(name, start) : variable(name, start);
    }

    Node number() {
        double value = 0;
        const char* const end = text_.data() + text_.size();
        const auto [stop, error] = std::from_chars(text_.data() + at_, end, value);
        if (error == std::errc::result_out_of_range) fail(at_, "the number is out of range");
        if (error != std::errc()) fail(at_, "expected a number, found " + found());
        const auto next = static_cast<std::size_t>(stop - text_.data());
        if (next < text_.size() && (is_letter(text_[next]) || text_[next] == '.'))
            fail(next, "a number ends here: write `2*x`, not `2x`");
        at_ = next;
        return builder_.constant(value);
    }

    Node variable(std::string_view name, std::size_t start) {
        if (const auto input = lookup_(name, start)) return builder_.input(*input);
        return builder_.constant(*formula_constant(name));
    }

    Node call(std::string_view name, std::size_t start) {
        const FormulaFunction* const function = find_formula_function(name);
        if (function == nullptr) {
            std::vector<std::string_view> known;
            for (const FormulaFunction& f : formula_functions()) known.push_back(f.name);
            fail(start, "unknown function " + shown(name) + hint(name, known));
        }
        expect('(');
        std::vector<Node> arguments;
        if (peek() != ')') {
            do arguments.push_back(choice());
            while (take(","));
        }
        expect(')');
        const auto count = static_cast<int>(arguments.size());
        if (count < function->least || count > function->most) {
            const std::string wanted =
                std::to_string(function->least) + (function->most > function->least ? " or more arguments"
                                                   : function->least == 1           ? " argument"
                                                                                    : " arguments");
            fail(start, shown(name) + " takes " + wanted + ", got " + std::to_string(count));
        }
        return function->make(builder_, arguments);
    }

    std::string_view text_;
    Lookup lookup_;
    FormulaBuilder builder_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

}  // namespace

std::vector<std::string> formula_names(std::string_view text) {
    std::vector<std::string> names;
    std::unordered_map<std::string, int> numbers;
    const auto lookup = [&](std::string_view name, std::size_t /*column*/) -> std::optional<int> {
        if (formula_constant(name)) return std::nullopt;
        const auto [place, added] = numbers.try_emplace(std::string(name), static_cast<int>(names.size()));
        if (added) names.emplace_back(name);
        return place->second;
    };
    Parser(text, lookup).parse();
    return names;
}

Formula parse_formula(std::string_view text, std::span<const std::string> names) {
    const auto lookup = [&](std::string_view name, std::size_t column) -> std::optional<int> {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found != names.end()) return static_cast<int>(found - names.begin());
        if (formula_constant(name)) return std::nullopt;
        std::string known;
        for (const std::string& n : names) known += (known.empty() ? "" : ", ") + n;
        const bool function = find_formula_function(name) != nullptr;
        throw InputError("column " + std::to_string(column + 1) + ": " +
                         (function ? shown(name) + " is a function: write `" + std::string(name) + "(...)`"
                                   : "unknown name " + shown(name) + hint(name, names) +
                                         (known.empty() ? "" : "; known: " + known)));
    };
    return Parser(text, lookup).parse();
}

}  // namespace lamella
