// A drawing of how stiff a foam is: by its density beside the bounds that hold for all, and to all sides.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "recipe/build/foam_stiffness.h"

namespace lamella {

struct StiffnessPlot {
    std::string title;
    std::vector<FoamLawPoint> law;  ///< by rising density, over the material's modulus; may be empty
    IsotropicMaterial material;     ///< MPa
    /// Of a foam that was homogenised: density, modulus of the closest isotropic stiffness, stiffness.
    struct Sample {
        double density = 0;
        double young = 0;
        ElasticTensor stiffness{};
    };
    std::optional<Sample> sample;
};

/// The drawing as SVG: modulus over density on logarithmic axes with the bounds of Voigt and of Hashin and
/// Shtrikman, and where there is a sample the surface whose distance from its middle is Young's modulus in
/// that direction.
std::string stiffness_svg(const StiffnessPlot& plot);

}  // namespace lamella
