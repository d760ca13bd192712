// Numbers as text: fixed decimals, no exponent, no locale, no minus zero. All text outputs use this one.
#pragma once

#include <string>

namespace lamella {

/// Appends `value` rounded to `decimals` places (0 to 9), halves away from zero, without trailing zeros:
/// "-0.5", "12", "0". The largest magnitude is 1e9. Throws FaultError for what is larger or not finite.
void append_number(std::string& out, double value, int decimals);

/// The same as a string of its own.
std::string format_number(double value, int decimals);

}  // namespace lamella
