// Parser of formulas in text: "min(x^2 + y^2 - 4, z) < 1 ? x : sin(2*pi*y)".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/formula/formula.h"

namespace lamella {

// The language, from the weakest binding to the strongest. Angles are in radians.
//   c ? a : b       a where c is not zero, else b
//   or ||           the left side where it is not zero, else the right one
//   and &&          the left side where it is zero, else the right one
//   not             1 where its argument is zero, else 0; `!` is the same but binds like a unary minus
//   < <= > >= == != 1 or 0; they cannot be chained
//   + -   * / %   unary minus   ^      power, right to left; % is the least non-negative remainder
//   numbers, names, pi, e, tau, parentheses, and the functions
//   sqrt abs square sin cos tan asin acos atan atan2(y,x) exp ln log(=ln) log10 pow floor ceil round sign mod
//   min max (2 or more) hypot length (2 or more) clamp(x,lo,hi) mix(a,b,t) = a + (b-a)*t
//   blend(a,b,t) = mix with t clamped to [0, 1], step(edge,x), smoothstep(lo,hi,x)

/// Returns the names that the text uses as variables, in order of first use (not functions and the constants
/// pi, e, tau). Throws InputError "column 7: ..." on a syntax error.
std::vector<std::string> formula_names(std::string_view text);

/// Parses a formula; names[i] is input i, and hides a constant of the same name. Throws InputError "column 7:
/// unknown name `q`; known: x, y, z" and the like, also for more than 1 MB of text and for parts nested more
/// than 200 deep.
Formula parse_formula(std::string_view text, std::span<const std::string> names);

}  // namespace lamella
