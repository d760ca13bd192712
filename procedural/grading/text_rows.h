// Parses text into rows of cells, as written by spreadsheets and by hand.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// A row and its line number, from 1. The cells are views into the text.
struct TextRow {
    std::size_t number = 0;
    std::vector<std::string_view> cells;
};

/// Returns the rows of a text. Cells are separated by a comma, semicolon or white space. Ignores empty lines,
/// everything after a #, and the byte order mark of spreadsheets.
std::vector<TextRow> text_rows(std::string_view text);

/// Returns the numbers of a row. Throws InputError, with `where` in front, for a cell that is not a number.
std::vector<double> numbers_of(const std::vector<std::string_view>& cells, const std::string& where);

}  // namespace lamella
