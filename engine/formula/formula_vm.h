// Reader of formulas as flat `.vm` text, the exchange format of Fidget and relatives of libfive.
#pragma once

#include <string_view>

#include "engine/formula/formula.h"

namespace lamella {

/// Reads `.vm` text: a line is `_label op arguments`, arguments are earlier labels (a number for `const`),
/// `#` starts a comment line, and the last line is the result. Inputs x, y, z are 0, 1, 2.
///
/// Operations: var-x var-y var-z const; neg abs square sqrt recip floor ceil round not sin cos tan asin acos
/// atan exp ln; add sub mul div mod min max atan2 pow compare and or. Their meaning is that of FormulaOp:
/// `mod` is the least non-negative remainder, `round` takes halves away from zero, `compare` is -1, 0 or 1,
/// `and` is the first argument where that is zero, else the second, `or` the first where that is not zero,
/// else the second. Throws InputError "name:line: ..." for malformed text.
Formula read_vm(std::string_view text, std::string_view name);

}  // namespace lamella
