// Reads line by line: label, operation, arguments; FormulaBuilder does the rest.
#include "engine/formula/formula_vm.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/formula/formula_builder.h"

namespace lamella {
namespace {

using Node = FormulaBuilder::Node;

struct Operation {
    std::string_view name;
    FormulaOp op;
};

constexpr std::array operations{
    Operation{"neg", FormulaOp::neg},         Operation{"abs", FormulaOp::abs},
    Operation{"square", FormulaOp::square},   Operation{"sqrt", FormulaOp::sqrt},
    Operation{"recip", FormulaOp::recip},     Operation{"floor", FormulaOp::floor},
    Operation{"ceil", FormulaOp::ceil},       Operation{"round", FormulaOp::round},
    Operation{"not", FormulaOp::logic_not},   Operation{"sin", FormulaOp::sin},
    Operation{"cos", FormulaOp::cos},         Operation{"tan", FormulaOp::tan},
    Operation{"asin", FormulaOp::asin},       Operation{"acos", FormulaOp::acos},
    Operation{"atan", FormulaOp::atan},       Operation{"exp", FormulaOp::exp},
    Operation{"ln", FormulaOp::ln},           Operation{"add", FormulaOp::add},
    Operation{"sub", FormulaOp::sub},         Operation{"mul", FormulaOp::mul},
    Operation{"div", FormulaOp::div},         Operation{"mod", FormulaOp::mod},
    Operation{"min", FormulaOp::min},         Operation{"max", FormulaOp::max},
    Operation{"atan2", FormulaOp::atan2},     Operation{"pow", FormulaOp::pow},
    Operation{"compare", FormulaOp::compare}, Operation{"and", FormulaOp::logic_and},
    Operation{"or", FormulaOp::logic_or},
};

/// Quotes a possibly hostile word for a message.
std::string printable(std::string_view word) {
    constexpr std::size_t longest = 60;
    std::string text = "`";
    for (const char c : word.substr(0, longest)) text += c > ' ' && c < 127 ? c : '?';
    return text + (word.size() > longest ? "...`" : "`");
}

class Reader {
  public:
    explicit Reader(std::string_view name) : name_(name) {}

    void read_line(std::string_view line) {
        ++line_;
        split(line);
        if (words_.empty() || words_[0].front() == '#') return;
        if (words_.size() < 2)
            fail("expected `_label operation arguments`, found " + printable(words_[0]) + " alone");
        const Node node = make(words_[1]);
        if (!nodes_.try_emplace(words_[0], node).second)
            fail("the label " + printable(words_[0]) + " is taken");
        last_ = node;
    }

    Formula finish() const {
        if (last_ < 0) throw InputError(std::string(name_) + ": there is no operation in it");
        return builder_.finish(last_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(std::string(name_) + ":" + std::to_string(line_) + ": " + message);
    }

    void split(std::string_view line) {
        constexpr std::string_view blanks = " \t\r";
        words_.clear();
        std::size_t at = line.find_first_not_of(blanks);
        while (at != std::string_view::npos) {
            const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
            words_.push_back(line.substr(at, end - at));
            at = line.find_first_not_of(blanks, end);
        }
    }

    void expect_arguments(std::size_t count) const {
        if (words_.size() == count + 2) return;
        fail(printable(words_[1]) + " takes " + std::to_string(count) +
             (count == 1 ? " argument" : " arguments") + ", got " + std::to_string(words_.size() - 2));
    }

    Node argument(std::size_t i) const {
        const auto found = nodes_.find(words_[i]);
        if (found == nodes_.end()) fail("no line above has the label " + printable(words_[i]));
        return found->second;
    }

    Node constant() {
        expect_arguments(1);
        const std::string_view word = words_[2];
        double value = 0;
        const char* const begin = word.data() + (word.front() == '+' ? 1 : 0);
        const auto [stop, error] = std::from_chars(begin, word.data() + word.size(), value);
        if (error != std::errc() || stop != word.data() + word.size())
            fail("expected a number, found " + printable(word));
        return builder_.constant(value);
    }

    Node make(std::string_view word) {
        if (word == "const") return constant();
        if (word == "var-x" || word == "var-y" || word == "var-z") {
            expect_arguments(0);
            return builder_.input(word.back() - 'x');
        }
        const auto found = std::find_if(operations.begin(), operations.end(),
                                        [&](const Operation& o) { return o.name == word; });
        if (found == operations.end()) fail("unknown operation " + printable(word));
        const auto arguments = static_cast<std::size_t>(arity(found->op));
        expect_arguments(arguments);
        const Node a = argument(2);
        return arguments == 1 ? builder_.unary(found->op, a) : builder_.binary(found->op, a, argument(3));
    }

    std::string_view name_;
    FormulaBuilder builder_;
    std::unordered_map<std::string_view, Node> nodes_;
    std::vector<std::string_view> words_;
    int line_ = 0;
    Node last_ = -1;
};

}  // namespace

Formula read_vm(std::string_view text, std::string_view name) {
    Reader reader(name);
    text = without_byte_order_mark(text);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        reader.read_line(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return reader.finish();
}

}  // namespace lamella
