// Stresses at the centres of elements.
#pragma once

#include <vector>

#include "procedural/elasticity/elastic_body.h"

namespace lamella {

/// Returns the von Mises stress at the centre of each element of a body, by element number, for displacements
/// of its nodes and a solid of modulus 1, in the unit of the elements' edges: in the plane under plane
/// stress. Times the modulus over that unit it is a stress. Voxels round off notches and roughen slopes:
/// peaks are no better than a factor of two near a staircase, and right where stress varies little across an
/// element.
template <std::size_t Dim>
std::vector<double> von_mises(const ElasticBody<Dim>& body, double poisson,
                              const NodalVector<Dim, double>& displacements);

/// A principal stress and its direction, a unit vector.
struct PrincipalStress {
    double stress = 0;
    dvec3 way{1, 0, 0};
};

/// Returns the principal stress of greatest magnitude at the centre of each element, by element number, in
/// the unit of von_mises().
template <std::size_t Dim>
std::vector<PrincipalStress> greatest_principal_stresses(const ElasticBody<Dim>& body, double poisson,
                                                         const NodalVector<Dim, double>& displacements);

}  // namespace lamella
