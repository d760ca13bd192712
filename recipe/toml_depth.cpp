// Walks over strings and comments, and counts dots and brackets between them.
#include "recipe/toml_depth.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"

namespace lamella {
namespace {

class DepthScan {
  public:
    DepthScan(std::string_view text, const std::string& path) : text_(text), path_(path) {}

    void run() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '#') {
                at_ = std::min(text_.find('\n', at_), text_.size());
                continue;
            }
            if (c == '"' || c == '\'') {
                skip_string(c);
                continue;
            }
            count(c);
            ++at_;
        }
    }

  private:
    /// Quoted parts belong to a key like plain ones, so strings do not end it.
    void count(char c) {
        if (c == '.') {
            if (++dots_ >= deepest_toml)
                fail(
                    fmt::format("a key has more than {} parts; accepted: keys of one part below their "
                                "[section]",
                                deepest_toml));
        } else if (c == '[' || c == '{') {
            dots_ = 0;
            if (++brackets_ > deepest_toml)
                fail(
                    fmt::format("arrays and tables are nested more than {} deep; accepted: at most lists of "
                                "lists of numbers",
                                deepest_toml));
        } else if (c == ']' || c == '}') {
            dots_ = 0;
            brackets_ = std::max(brackets_ - 1, 0);
        } else if (c == '\n' || c == '=' || c == ',') {
            dots_ = 0;
        }
    }

    /// Three quotes begin a string of several lines, which up to two further quotes may precede the end of.
    void skip_string(char quote) {
        const std::string fence(3, quote);
        const bool escapes = quote == '"';
        if (text_.substr(at_, 3) != fence) {
            for (++at_; at_ < text_.size() && text_[at_] != quote && text_[at_] != '\n'; ++at_) {
                if (escapes && text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
            }
            if (at_ < text_.size() && text_[at_] == quote) ++at_;
            return;
        }
        for (at_ += 3; at_ < text_.size() && text_.substr(at_, 3) != fence; ++at_) {
            if (escapes && text_[at_] == '\\') ++at_;
        }
        at_ = std::min(at_ + 3, text_.size());
        for (int more = 0; more < 2 && at_ < text_.size() && text_[at_] == quote; ++more) ++at_;
    }

    [[noreturn]] void fail(const std::string& what) const {
        const std::string_view before = text_.substr(0, at_);
        const auto line = std::count(before.begin(), before.end(), '\n') + 1;
        const std::size_t begin = before.rfind('\n');
        const std::size_t column = at_ - (begin == before.npos ? 0 : begin + 1) + 1;
        throw InputError(fmt::format("{}:{}:{}: {}", path_, line, column, what));
    }

    std::string_view text_;
    const std::string& path_;
    std::size_t at_ = 0;
    int dots_ = 0;
    int brackets_ = 0;
};

}  // namespace

void require_shallow_toml(std::string_view text, const std::string& path) { DepthScan(text, path).run(); }

}  // namespace lamella
