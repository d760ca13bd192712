// The standard problems of topology optimisation that tests and papers share.
#pragma once

#include <cmath>

#include "procedural/optimization/topology_optimizer.h"

namespace lamella {

/// A box of free elements with one load case without forces, held nowhere: modified SIMP with exponent 3.
template <std::size_t Dim>
TopologyProblem<Dim> free_box(glm::ivec3 size, double volume, double least_modulus) {
    const auto make_element = [] {
        if constexpr (Dim == 2) {
            return make_plane_stress_element({1, 0.3});
        } else {
            return make_solid_element({1, 0.3});
        }
    };
    TopologyProblem<Dim> problem{.body = ElasticBody<Dim>(NodeGrid<Dim>(size), make_element())};
    problem.use.assign(element_numbers(problem.body.grid).size(), ElementUse::free);
    problem.cases.push_back({"1", 1, NodalVector<Dim, double>(problem.body.grid.size())});
    problem.law = make_penalty_law({.exponent = 3, .least = least_modulus});
    problem.volume = volume;
    return problem;
}

/// Half of a beam on two supports with a load in the middle (Messerschmitt-Boelkow-Blohm): node (0, 0) is
/// loaded, the edge x = 0 is the plane of symmetry, and the opposite corner is the support.
inline TopologyProblem<2> half_mbb_beam(int nx, int ny, double volume) {
    TopologyProblem<2> problem = free_box<2>({nx, ny, 1}, volume, 1e-9);
    const NodeGrid<2>& grid = problem.body.grid;
    for (int y = 0; y <= ny; ++y) problem.body.fixed[grid.number(0, y, 0)] |= 1;
    problem.body.fixed[grid.number(nx, ny, 0)] |= 2;
    problem.cases[0].forces.along[1][grid.number(0, 0, 0)] = 1;
    return problem;
}

/// The edge x = 0 is held; node (nx, at_y) is loaded across.
inline TopologyProblem<2> plane_cantilever(int nx, int ny, double volume, int at_y) {
    TopologyProblem<2> problem = free_box<2>({nx, ny, 1}, volume, 1e-9);
    const NodeGrid<2>& grid = problem.body.grid;
    for (int y = 0; y <= ny; ++y) problem.body.fixed[grid.number(0, y, 0)] = 3;
    problem.cases[0].forces.along[1][grid.number(nx, at_y, 0)] = -1;
    return problem;
}

/// The edge x = 0 is held; one case pulls the upper free corner up, the other the lower one down.
inline TopologyProblem<2> cantilever_of_two_cases(int nx, int ny, double volume) {
    TopologyProblem<2> problem = plane_cantilever(nx, ny, volume, 0);
    problem.cases.push_back({"2", 1, NodalVector<2, double>(problem.body.grid.size())});
    problem.cases[1].forces.along[1][problem.body.grid.number(nx, ny, 0)] = 1;
    return problem;
}

/// The face x = 0 is held; the edge (nx, y, 0) is loaded along -z by half a sine (Ferrari and Sigmund 2020).
inline TopologyProblem<3> solid_cantilever(int nx, int ny, int nz, double volume, double least_modulus) {
    TopologyProblem<3> problem = free_box<3>({nx, ny, nz}, volume, least_modulus);
    const NodeGrid<3>& grid = problem.body.grid;
    for (int z = 0; z <= nz; ++z) {
        for (int y = 0; y <= ny; ++y) problem.body.fixed[grid.number(0, y, z)] = 7;
    }
    for (int y = 0; y <= ny; ++y)
        problem.cases[0].forces.along[2][grid.number(nx, y, 0)] = -std::sin(3.14159265358979323846 * y / ny);
    return problem;
}

}  // namespace lamella
