// Applies [process] and [repair] to a designed part: scaling and in-plane offsets.
#pragma once

#include "engine/layers/layer.h"
#include "recipe/recipe.h"

namespace lamella {

/// Returns the layers of the designed part from those of the print, without its lift.
LayerPlan designed_layers(const Recipe& recipe, const LayerPlan& printed);

/// Scales a solid by [process], about the same point as the designed job's part.
FieldPtr make_scaled(const Recipe& recipe, const Job& designed, const FieldPtr& solid);

/// Returns the designed job with its scale only, in its layers as printed: no repairs, no offsets.
Job make_scaled(const Recipe& recipe, const Job& designed, const LayerPlan& printed);

/// Returns the job to print: the designed one with the recipe's [process] and [repair] applied. Its layers
/// are cut at the same places as those of the designed job.
///
/// The scale is about the middle of the bounds in x and y and about their lowest z, so the part stays where
/// it stood; foam, skin and everything else scale with it. Then thin walls of each layer are thickened,
/// narrow gaps are filled, and last its outline is offset, all in mm as printed.
Job make_processed(const Recipe& recipe, const Job& designed, const LayerPlan& printed);

}  // namespace lamella
