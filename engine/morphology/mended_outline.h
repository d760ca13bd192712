// Outlines mended layer by layer: walls that are too thin made thicker, gaps that are too narrow filled.
#pragma once

#include "engine/field/field.h"

namespace lamella {

/// The solid with what is thinner than `thickness` (mm) within a layer made about as thick: nowhere less but
/// for what `pitch` takes, and by a quarter too much at most. Where nothing is too thin nothing changes.
///
/// Each section is looked at along lines `pitch` (mm) apart, by balls of growing radius as for a check of
/// thickness (layer_thinness.h): sharp edges stay sharp. Where a disc of a radius fits and no larger one
/// does, discs of half the thickness are put in its place. InputError for a missing solid and for a pitch
/// that is not positive, or more than a fourth of the thickness.
FieldPtr make_thickened(FieldPtr solid, double thickness, double pitch);

/// The solid with void narrower than `gap` (mm) within a layer filled. Where none is too narrow nothing
/// changes; what is filled ends within a pitch of where it should, inside the solid or at the mouth of a gap.
FieldPtr make_gaps_filled(FieldPtr solid, double gap, double pitch);

}  // namespace lamella
