// Text that holds a table: rows of cells, as spreadsheets and people write them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// A row, with the number of its line, from 1. The cells are views of the text.
struct TextRow {
    std::size_t number = 0;
    std::vector<std::string_view> cells;
};

/// The rows of a text: cells parted by a comma, semicolon or white space. Empty lines and what follows a # do
/// not count, nor does the byte order mark of spreadsheets.
std::vector<TextRow> text_rows(std::string_view text);

/// The numbers of a row. Throws InputError with `where` before it for what is none.
std::vector<double> numbers_of(const std::vector<std::string_view>& cells, const std::string& where);

}  // namespace lamella
