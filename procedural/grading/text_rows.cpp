// Splits text into lines, and lines into cells.
#include "procedural/grading/text_rows.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/text.h"

namespace lamella {
namespace {

bool is_separator(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';'; }

/// Returns the cells of a line. Between two separators other than white space there is an empty cell.
std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells;
    std::size_t at = 0;
    const auto skip_blanks = [&] {
        while (at < line.size() && (line[at] == ' ' || line[at] == '\t')) ++at;
    };
    for (skip_blanks(); at < line.size();) {
        const std::size_t begin = at;
        while (at < line.size() && !is_separator(line[at])) ++at;
        cells.push_back(line.substr(begin, at - begin));
        skip_blanks();
        if (at < line.size() && (line[at] == ',' || line[at] == ';')) {
            ++at;
            skip_blanks();
            if (at == line.size()) cells.emplace_back();
        }
    }
    return cells;
}

/// Removes and returns the next line of a text, without its end and without what follows a #.
std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + (text.substr(end, 2) == "\r\n" ? 2 : 1), text.size()));
    return line.substr(0, line.find('#'));
}

}  // namespace

std::vector<TextRow> text_rows(std::string_view text) {
    std::vector<TextRow> rows;
    text = without_byte_order_mark(text);
    for (std::size_t line = 1; !text.empty(); ++line) {
        std::vector<std::string_view> cells = cells_of(take_line(text));
        if (!cells.empty()) rows.push_back({line, std::move(cells)});
    }
    return rows;
}

std::vector<double> numbers_of(const std::vector<std::string_view>& cells, const std::string& where) {
    std::vector<double> numbers;
    numbers.reserve(cells.size());
    for (const std::string_view cell : cells) {
        const auto number = parse_double(cell);
        if (!number)
            throw InputError(where + excerpt(cell) + " is not a number (such as 12.5, with a point)");
        numbers.push_back(*number);
    }
    return numbers;
}

}  // namespace lamella
