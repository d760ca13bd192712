// Numbers as text: fixed decimals, no exponent, no locale, no negative zero. All text outputs use these.
#pragma once

#include <string>

namespace lamella {

/// Appends `value` rounded to `decimals` places (0 to 9), halves away from zero, without trailing zeros:
/// "-0.5", "12", "0". The largest magnitude is 1e9. Throws FaultError for greater or non-finite values.
void append_number(std::string& out, double value, int decimals);

/// Returns the text that append_number appends.
std::string format_number(double value, int decimals);

}  // namespace lamella
