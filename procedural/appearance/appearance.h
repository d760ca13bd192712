// Appearance: how much a density grid looks like an exemplar, and the derivative of that by the densities.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "procedural/appearance/patch_match.h"

namespace lamella {

/// The appearance energy of structure and appearance optimisation (Martinez, Dumas, Lefebvre, Wei 2015,
/// Structure and appearance optimization for controllable shape design; as the authors' program has it):
///
///     A = w / (windows N^2)  sum over windows t, pixels k  ((T[t + k] - S[m(t) + k])^2 + 1e-4)^(q / 2)
///
/// with w = 100, T the densities and S the exemplar in steps of 1/255. The matches m are found by PatchMatch
/// and stay as they are between calls of match(): energy and gradient are those of fixed matches, so A is a
/// smooth function of T. Its terms are evaluated as a piecewise cubic with 1020 pieces in [0, 1], continuous
/// with its first derivative and within 1e-8 of the formula for q >= 1; the gradient is the exact derivative
/// of the energy so evaluated.
class Appearance {
  public:
    /// Throws InputError as PatchMatch does.
    Appearance(const GreyImage& exemplar, int width, int height, const MatchSettings& settings, int level = 0,
               std::span<const std::uint8_t> passive = {});

    /// Improves the matches: by 30 sweeps the first time, then by one.
    void match(std::span<const double> target);
    /// Returns A of a target of width x height values, the lowest row first. Throws FaultError for a
    /// target of another size and for a value outside [0, 1] by more than 1e-3.
    double energy(std::span<const double> target) const { return evaluate(target, nullptr); }
    /// Returns A and writes its derivative by each value.
    double energy(std::span<const double> target, std::span<double> gradient) const {
        return evaluate(target, gradient.data());
    }

    const PatchMatch& matches() const { return matches_; }
    /// Goes on with the matches of another object, see PatchMatch::set_state().
    void set_matches(MatchState state) { matches_.set_state(std::move(state)); }

  private:
    using Cubic = std::array<double, 4>;
    double evaluate(std::span<const double> target, double* gradient) const;
    Cubic sum_at(int x, int y, int cell, const std::vector<std::int32_t>& begins) const;

    PatchMatch matches_;
    std::vector<Cubic> cubics_;  // of the term, by difference, from -1
};

}  // namespace lamella
