// Mended outlines: thickens thin walls and fills narrow gaps, layer by layer.
#pragma once

#include "engine/field/field.h"

namespace lamella {

/// Returns the solid with walls thinner than `thickness` (mm) within a layer widened to about that thickness:
/// at least to it, but for the sampling by `pitch`, and to a quarter more at most. Where nothing is too thin,
/// nothing changes.
///
/// Each section is sampled on lines `pitch` (mm) apart. The thin parts are found as in a thickness check
/// (thin_features.h), so sharp edges stay sharp. In them, discs of several radii are tried. Where a disc of
/// one radius fits and none of the next larger radius does, a disc of half the thickness takes its place.
/// Throws InputError when the solid is missing, or when `pitch` is not positive or exceeds a fourth of the
/// thickness.
FieldPtr make_thickened(FieldPtr solid, double thickness, double pitch);

/// Returns the solid with gaps narrower than `gap` (mm) within a layer filled. Where no gap is too narrow,
/// nothing changes. The filling is exact to a `pitch` (mm), inside the solid and at the mouth of a gap.
/// Throws InputError when the solid is missing, or when `pitch` is not positive or exceeds a fourth of `gap`.
FieldPtr make_gaps_filled(FieldPtr solid, double gap, double pitch);

}  // namespace lamella
