// Filter radius and thresholds that keep members and gaps from being thinner than wanted, for the robust
// formulation with three projected fields.
//
// The filtered field v is projected at three thresholds: dilated d <= intermediate i <= eroded e. A member of
// the intermediate design that is still there in the eroded one has a least thickness; a gap that is still
// there in the dilated one likewise (Wang, Lazarov, Sigmund 2011, "On projection methods, convergence and
// robust formulations in topology optimization"; Qian and Sigmund 2013, "Topological design of
// electromechanical actuators with robustness toward over- and under-etching", who get the relation from a
// strip in one dimension; Trillet, Duysinx, Fernandez 2021, "Analytical relationships for topology
// optimization based on uniform manufacturing uncertainties", arXiv 2101.08605).
//
// Derivation, with lengths in units of the radius. The cone filter of a straight strip of design variables
// |t| <= s is one-dimensional: the cone, integrated along the strip, is a density of mass 1 on [-1, 1]. Let
// G(t) be its mass in [0, t] (odd; 1/2 from t = 1 on):
//     one dimension    G = t - t^2 / 2
//     two dimensions   G = (2 t c + arcsin t - t^3 ln((1 + c) / t)) / pi,   c = sqrt(1 - t^2)
//     three            G = t - t^3 + t^4 / 2
// Then v(z) = G(s + z) + G(s - z) across the strip. The thinnest strip that survives erosion has its largest
// value v(0) = 2 G(s) = e, and its member in the intermediate design the thickness 2 z, where v(z) = i. In
// one dimension and for i = 1/2, e <= 3/4 this is 2 sqrt(e - 1/2): with e = 3/4 exactly the radius. Gaps are
// the same with 1 - v in place of v: e -> 1 - d, i -> 1 - i.
//
// Strips are the thinnest members. In one dimension that is exact (by the lemma of Neyman and Pearson no
// variables in [0, 1] have v(0) = e and a smaller mean of v(-z) and v(z)); rods and balls are thicker (two
// dimensions, e = 3/4: strip 0.943, disc 1.04; three: plate 0.882, rod 0.970, ball 1.01). Over all fields
// whatsoever in two dimensions, the same lemma gives 0.933 in place of 0.943 for two opposite points around
// a point that survives. In three dimensions only plates, rods and balls were compared.
//
// Near borders of the grid or the mask the filter's weights are cut, and the relation holds only with open
// borders (DensityFilter::open_border), or for members that go on beyond the border as in a mirror, with
// mirrored padding. Corners are rounded by a radius, not kept: the thickness is that of members.
#pragma once

namespace lamella {

/// What is wanted. Sizes of 0: any.
struct LengthScaleWish {
    double member = 0;          ///< mm, least thickness of members
    double gap = 0;             ///< mm, least width of gaps
    double element = 1;         ///< mm, edge of an element
    int dimensions = 3;         ///< 2 or 3, as the grid; 1 for bars
    double farthest = 0.75;     ///< the eroded threshold of the larger of both sizes, in (0.5, 1)
    double least_radius = 1.5;  ///< elements; a smaller filter allows checkerboards
};

/// Radius in elements and thresholds of the three fields. The intermediate threshold is 1/2.
struct LengthScale {
    double radius = 1.5;
    double eroded = 0.75;
    double intermediate = 0.5;
    double dilated = 0.25;
};

/// Returns the settings that keep the wanted sizes: the smallest radius for which neither threshold lies
/// farther from 1/2 than `farthest`, but not below the least radius. Throws InputError if a size is negative
/// or not finite, or another number is outside its bounds.
LengthScale length_scale_for(const LengthScaleWish& wish);

/// Returns the thickness, in units of the filter radius, of the thinnest member at threshold `design` that
/// survives at the threshold `survives` (0 if survives <= design). For gaps give 1 - threshold for both.
/// Throws InputError unless both lie in (0, 1) and dimensions is 1, 2 or 3.
double least_thickness(double survives, double design, int dimensions);

/// Returns the distance, in units of the filter radius, between the contours at two thresholds along a
/// straight edge of the design variables; positive if `inner` is the larger one. What is solid at `inner`
/// is, everywhere in the design, at least this far within what is solid at `outer`: exactly so in one
/// dimension, and to 1 % of it in two. Bounds as above.
double contour_distance(double inner, double outer, int dimensions);

}  // namespace lamella
