// A foam's law in MPa: that of its material, or fitted to tests of printed samples.
#pragma once

#include <span>

#include "procedural/elasticity/foam_law.h"

namespace lamella {

/// A compression test of a foam.
struct StiffnessTest {
    double ratio = 0;  ///< of members to cells
    double young = 0;  ///< measured, MPa
};

/// What tests make of a law: the modulus is scale * law^exponent.
struct LawFit {
    double scale = 1;  ///< MPa
    double exponent = 1;
    /// 19 of 20 further samples lie within a factor of 1 + band of the fit, by the scatter of the tests; 0
    /// where these are too few to tell.
    double band = 0;
    std::size_t tests = 0;
};

/// The modulus of a foam by the ratio of its members to its cells, and back.
class FoamModulus {
  public:
    /// As the law has it, for a material of this modulus, MPa.
    FoamModulus(FoamLaw law, double young);
    /// Fitted to tests, by least squares of logarithms: the scale, and the exponent as well where there are
    /// three tests or more over ratios that differ by a fifth or more. Throws InputError for a test out of
    /// the law's ratios, or without a positive modulus, and for tests that do not stiffen with the ratio.
    FoamModulus(FoamLaw law, double young, std::span<const StiffnessTest> tests);

    const FoamLaw& law() const { return law_; }
    const LawFit& fit() const { return fit_; }
    /// The moduli of the law's ends, MPa.
    Interval moduli() const;
    /// The ratio for a modulus, MPa: the nearest end's outside moduli(); NaN for NaN.
    double ratio_of(double modulus) const;
    /// MPa; of the nearest end outside the law's ratios.
    double modulus_of(double ratio) const;
    /// How far off a modulus may be, over it: the fit's band, or what is known of the law: twice the spread
    /// of its samples (19 of 20 pieces of 64 cells differ less from the mean) and what elements leave wrong.
    double band() const;

  private:
    FoamLaw law_;
    LawFit fit_;
};

}  // namespace lamella
