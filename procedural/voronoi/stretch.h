// Stretch: the linear map from the space in which seeds are drawn to the space of the part.
#pragma once

#include "engine/base/geometry.h"

namespace lamella {

/// Makes a foam orthotropic: its cells are round in the space of the seeds and stretched in the part's. Beams
/// stay round: only their ends are mapped.
class Stretch {
  public:
    Stretch() = default;
    /// Stretches by factors along three axes at right angles, the columns of `axes`. InputError unless the
    /// factors are positive and finite.
    Stretch(const glm::dmat3& axes, dvec3 factors);

    bool identity() const { return identity_; }
    dvec3 to_part(dvec3 seed_space) const { return identity_ ? seed_space : forward_ * seed_space; }
    dvec3 to_seeds(dvec3 part_space) const { return identity_ ? part_space : inverse_ * part_space; }
    /// The box about the box's image.
    Box to_part(const Box& box) const { return identity_ ? box : image(forward_, box); }
    /// The box about the box's preimage.
    Box to_seeds(const Box& box) const { return identity_ ? box : image(inverse_, box); }
    /// How much longer a length can be among the seeds than in the part.
    double seeds_per_part() const { return seeds_per_part_; }

  private:
    static Box image(const glm::dmat3& map, const Box& box);

    glm::dmat3 forward_{1}, inverse_{1};
    double seeds_per_part_ = 1;
    bool identity_ = true;
};

/// Axes turned by angles about x, then y, then z, degrees.
glm::dmat3 turned_axes(dvec3 degrees);

}  // namespace lamella
