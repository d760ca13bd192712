// A chart of a foam's stiffness: modulus over density with theoretical bounds, and its anisotropy.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "recipe/structure/foam_stiffness.h"

namespace lamella {

struct StiffnessPlot {
    std::string title;
    std::vector<FoamLawPoint> law;  ///< by rising density, relative to the material's modulus; may be empty
    IsotropicMaterial material;     ///< MPa
    /// A homogenised foam: density, modulus of the closest isotropic stiffness, stiffness.
    struct Sample {
        double density = 0;
        double young = 0;
        ElasticTensor stiffness{};
    };
    std::optional<Sample> sample;
};

/// Returns the chart as SVG: modulus over density on logarithmic axes with the Voigt and Hashin-Shtrikman
/// bounds; with a sample, also the surface whose distance from its centre is Young's modulus in that
/// direction.
std::string stiffness_svg(const StiffnessPlot& plot);

}  // namespace lamella
