// Stretch: the linear map from the space in which seeds are drawn to the space of the part.
#pragma once

#include "engine/base/geometry.h"

namespace lamella {

/// Makes a foam orthotropic: cells are isotropic in seed space and stretched in part space. Beams stay round,
/// because only their ends are mapped.
class Stretch {
  public:
    Stretch() = default;
    /// Stretches by `factors` along three orthonormal axes, the columns of `axes`. Throws InputError unless
    /// the factors are positive and finite.
    Stretch(const glm::dmat3& axes, dvec3 factors);

    /// Returns the stretch followed by a rotation or mirror by orthogonal `axes`.
    Stretch turned(const glm::dmat3& axes) const;

    bool identity() const { return identity_; }
    dvec3 to_part(dvec3 seed_space) const { return identity_ ? seed_space : forward_ * seed_space; }
    dvec3 to_seeds(dvec3 part_space) const { return identity_ ? part_space : inverse_ * part_space; }
    /// Returns the bounding box of the box's image.
    Box to_part(const Box& box) const { return identity_ ? box : image(forward_, box); }
    /// Returns the bounding box of the box's preimage.
    Box to_seeds(const Box& box) const { return identity_ ? box : image(inverse_, box); }
    /// Returns the largest ratio of a length in seed space to its length in part space.
    double seeds_per_part() const { return seeds_per_part_; }
    /// Returns the largest ratio of a length in part space to its length in seed space.
    double part_per_seeds() const { return part_per_seeds_; }

  private:
    static Box image(const glm::dmat3& map, const Box& box);

    glm::dmat3 forward_{1}, inverse_{1};
    double seeds_per_part_ = 1, part_per_seeds_ = 1;
    bool identity_ = true;
};

/// Returns axes rotated about x, then y, then z, by angles in degrees.
glm::dmat3 turned_axes(dvec3 degrees);

}  // namespace lamella
