// Text as the typesetter of manual pages wants it (roff with the man macros).
#pragma once

#include <string>
#include <string_view>

namespace lamella {

/// Returns text to be shown letter by letter, such as a command line: hyphens, quotes and backslashes stay
/// what they are, and a dot that begins a line begins no request.
std::string roff_literal(std::string_view text);

/// Returns prose: what stands between `back quotes` is literal and bold, and so are the hyphens of options.
/// Line breaks become spaces.
std::string roff_prose(std::string_view text);

}  // namespace lamella
