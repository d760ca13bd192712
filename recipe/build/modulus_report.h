// Report on the modulus of a part's foam: predicted against requested.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "recipe/build/foam_modulus.h"

namespace lamella {

/// A predicted modulus within this relative deviation counts as the requested one.
inline constexpr double modulus_tolerance = 0.01;

/// Statistics over the body, sampled on a lattice of points. Moduli in MPa.
struct ModulusReport {
    bool is_asked = false;
    Interval asked;      ///< minimum and maximum; empty when none is requested
    Interval predicted;  ///< minimum and maximum
    double softer = 0;   ///< share of the volume with less than 99 % of the requested modulus
    double stiffer = 0;  ///< share with more than 101 % of it
    double band = 0;     ///< relative uncertainty of a prediction
    /// True if some foam given by its sizes lies outside the law's range, whose end is then used.
    bool leaves_law = false;
    std::string material;
    LawFit fit;
};

ModulusReport modulus_report(const BuiltModulus& modulus, const Field& body);

/// Returns sentences about the predicted modulus, and about requests that cannot be met.
std::vector<std::string> modulus_lines(const ModulusReport& report);
nlohmann::ordered_json modulus_json(const ModulusReport& report);

}  // namespace lamella
