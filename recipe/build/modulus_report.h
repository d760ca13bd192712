// How stiff the foam of a part gets, beside what was asked for.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "recipe/build/foam_modulus.h"

namespace lamella {

/// A modulus is as asked within this share of it.
inline constexpr double modulus_tolerance = 0.01;

/// Over the body, by a lattice of points. Moduli in MPa.
struct ModulusReport {
    bool is_asked = false;
    Interval asked;      ///< the least and the greatest; empty where none is
    Interval predicted;  ///< likewise
    double softer = 0;   ///< share of the volume that gets less than 99 % of what is asked
    double stiffer = 0;  ///< ... more than 101 %
    double band = 0;     ///< how far off a prediction may be, over it
    /// Whether some foam that is given by its sizes lies beyond the law, whose end is told of it.
    bool leaves_law = false;
    std::string material;
    LawFit fit;
};

ModulusReport modulus_report(const BuiltModulus& modulus, const Field& body);

/// What is predicted, and what cannot be had: a sentence each.
std::vector<std::string> modulus_lines(const ModulusReport& report);
nlohmann::ordered_json modulus_json(const ModulusReport& report);

}  // namespace lamella
