// Colours for a foam's predicted modulus and its deviation from the request.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "recipe/build/build_job.h"

namespace lamella {

/// Returns a colour map (linear light) of a part: dark blue to yellow from the least predicted modulus to the
/// greatest, on a logarithmic scale; red where the foam is softer than requested, white where it is stiffer.
/// Throws InputError, which begins with `who`, where the modulus of the foam is unknown.
std::function<dvec3(dvec3)> modulus_paint(const BuiltJob& built, const std::string& who);

/// How a byte says a modulus.
struct ModulusCode {
    static constexpr std::uint8_t softer = 1, stiffer = 2;  ///< than asked
    static constexpr std::uint8_t least = 3, most = 255;    ///< ends of the logarithmic scale
};

/// Returns the code of each place of a part, of which modulus_paint() has the colours. Throws as that does.
std::function<std::uint8_t(dvec3)> modulus_codes(const BuiltJob& built, const std::string& who);

/// Returns the legend of the colours, one line.
std::string modulus_legend(const ModulusReport& report);

}  // namespace lamella
