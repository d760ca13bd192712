// FoamModulus: the absolute modulus of a foam (MPa), from its law and material or fitted to tests of printed
// samples.
#pragma once

#include <span>

#include "procedural/elasticity/foam_law.h"

namespace lamella {

/// A compression test of a foam.
struct StiffnessTest {
    double ratio = 0;  ///< member size over cell size
    double young = 0;  ///< measured, MPa
};

/// A law fitted to tests: modulus = scale * law^exponent.
struct LawFit {
    double scale = 1;  ///< MPa
    double exponent = 1;
    /// 19 of 20 further samples lie within a factor of 1 + band of the fit, judged by the scatter of the
    /// tests; 0 if there are too few tests to tell.
    double band = 0;
    std::size_t tests = 0;
};

/// The modulus of a foam as a function of its member-to-cell ratio, and the inverse.
class FoamModulus {
  public:
    /// Takes the law as it is, for a material of modulus `young`, MPa.
    FoamModulus(FoamLaw law, double young);
    /// Fits the law to tests, by least squares of the logarithms. Fits the scale, and also the exponent if
    /// there are at least three tests whose ratios differ by more than a factor of 1.2. Throws InputError for
    /// a test outside the law's ratios or without a positive modulus, and for tests that do not stiffen with
    /// the ratio.
    FoamModulus(FoamLaw law, double young, std::span<const StiffnessTest> tests);

    const FoamLaw& law() const { return law_; }
    const LawFit& fit() const { return fit_; }
    /// The moduli at the ends of the law, MPa.
    Interval moduli() const;
    /// Returns the ratio that gives a modulus (MPa). Outside moduli() returns the ratio of the nearest end;
    /// NaN for NaN.
    double ratio_of(double modulus) const;
    /// Returns the modulus of a ratio, MPa; outside the law's ratios that of the nearest end.
    double modulus_of(double ratio) const;
    /// Returns the relative uncertainty of a modulus. For a fit: its band. Else the root of the summed
    /// squares of twice the spread of the law's samples (19 of 20 pieces of 64 cells differ less from the
    /// mean) and the discretisation error of the elements.
    double band() const;

  private:
    FoamLaw law_;
    LawFit fit_;
};

}  // namespace lamella
