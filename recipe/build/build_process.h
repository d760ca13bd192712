// From a designed part to the part as it is printed: scaled, and its outlines moved.
#pragma once

#include "engine/layers/layer.h"
#include "recipe/recipe.h"

namespace lamella {

/// The height in the designed part of a layer of the printed one, mm.
double designed_layer_height(const Recipe& recipe);

/// A solid under the scale of [process], as the designed job's part is.
FieldPtr make_scaled(const Recipe& recipe, const Job& designed, const FieldPtr& solid);

/// The designed job scaled alone: neither mended nor with its outlines moved.
Job make_scaled(const Recipe& recipe, const Job& designed);

/// The job to print: the designed one under the recipe's [process], its outlines mended as [repair] says.
/// Layers are cut where those of the designed job are.
///
/// The scale is about the middle of the bounds in x and y and about their lowest z, so the part stays where
/// it stood; foam, skin and everything else scale with it. Then thin walls of each layer are made thicker and
/// narrow gaps filled, and at last its outline is moved, all in mm as printed.
Job make_processed(const Recipe& recipe, const Job& designed);

}  // namespace lamella
