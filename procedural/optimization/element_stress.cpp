// Strains from the differences of corner displacements.
#include "procedural/optimization/element_stress.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "engine/base/parallel.h"

namespace lamella {

namespace {

/// Returns the gradient of the displacements at the centre of an element with these edges: entry (i, j) is
/// du_i/dx_j.
template <std::size_t Dim>
std::array<std::array<double, Dim>, Dim> gradient_at(
    const std::array<std::ptrdiff_t, (std::size_t{1} << Dim)>& corners,
    const NodalVector<Dim, double>& displacements, dvec3 edges, std::size_t element) {
    std::array<std::array<double, Dim>, Dim> gradient{};
    constexpr double share = 2.0 / static_cast<double>(std::size_t{1} << Dim);
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const auto node = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(element) + corners[c]);
        for (std::size_t i = 0; i < Dim; ++i) {
            for (std::size_t j = 0; j < Dim; ++j)
                gradient[i][j] += ((c >> j & 1) != 0 ? share : -share) / edges[static_cast<int>(j)] *
                                  displacements.along[i][node];
        }
    }
    return gradient;
}

double plane_stress(const std::array<std::array<double, 2>, 2>& g, double nu) {
    const double factor = 1 / (1 - nu * nu), x = factor * (g[0][0] + nu * g[1][1]),
                 y = factor * (g[1][1] + nu * g[0][0]), xy = factor * (1 - nu) / 2 * (g[0][1] + g[1][0]);
    return std::sqrt(x * x - x * y + y * y + 3 * xy * xy);
}

double solid_stress(const std::array<std::array<double, 3>, 3>& g, double nu) {
    const double shear = 0.5 / (1 + nu);
    const double a = g[0][0] - g[1][1], b = g[1][1] - g[2][2], c = g[2][2] - g[0][0];
    const double xy = g[0][1] + g[1][0], yz = g[1][2] + g[2][1], zx = g[2][0] + g[0][2];
    return shear * std::sqrt(2 * (a * a + b * b + c * c) + 3 * (xy * xy + yz * yz + zx * zx));
}

double stress_of(const std::array<std::array<double, 2>, 2>& g, double nu) { return plane_stress(g, nu); }
double stress_of(const std::array<std::array<double, 3>, 3>& g, double nu) { return solid_stress(g, nu); }

PrincipalStress principal_of(const std::array<std::array<double, 2>, 2>& g, double nu) {
    const double factor = 1 / (1 - nu * nu), x = factor * (g[0][0] + nu * g[1][1]),
                 y = factor * (g[1][1] + nu * g[0][0]), xy = factor * (1 - nu) / 2 * (g[0][1] + g[1][0]);
    const double mean = 0.5 * (x + y), half = 0.5 * (x - y), radius = std::sqrt(half * half + xy * xy);
    // Both are along the greater principal stress; the longer one has no cancellation.
    dvec2 way = half > 0 ? dvec2(half + radius, xy) : dvec2(xy, radius - half);
    if (squared_length(way) == 0) way = {1, 0};
    if (mean < 0) way = left_of(way);
    return {mean < 0 ? mean - radius : mean + radius, dvec3(way / length(way), 0)};
}

PrincipalStress principal_of(const std::array<std::array<double, 3>, 3>& g, double nu) {
    const double shear = 1 / (1 + nu), share = nu / (1 - 2 * nu);
    const double trace = g[0][0] + g[1][1] + g[2][2];
    Eigen::Matrix3d stress;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
            stress(i, j) = shear * (0.5 * (g[a][b] + g[b][a]) + (i == j ? share * trace : 0));
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(stress);
    const Eigen::Vector3d& values = solver.eigenvalues();  // ascending
    const int greatest = std::abs(values[0]) > std::abs(values[2]) ? 0 : 2;
    const Eigen::Vector3d way = solver.eigenvectors().col(greatest);
    return {values[greatest], {way[0], way[1], way[2]}};
}

/// Calls visit(element, gradient of its displacements) for all elements of the body.
template <std::size_t Dim, typename Visit>
void for_gradients(const ElasticBody<Dim>& body, const NodalVector<Dim, double>& displacements,
                   const Visit& visit) {
    const auto corners = body.grid.corner_steps();
    const glm::ivec3 n = body.grid.elements();
    parallel_for(n.y * n.z, [&](int row) {
        const std::size_t first = body.grid.number(0, row % n.y, row / n.y);
        for (std::size_t e = first; e < first + static_cast<std::size_t>(n.x); ++e) {
            if (body.present[e] != 0)
                visit(e, gradient_at<Dim>(corners, displacements, body.element.edges, e));
        }
    });
}

}  // namespace

template <std::size_t Dim>
std::vector<PrincipalStress> greatest_principal_stresses(const ElasticBody<Dim>& body, double poisson,
                                                         const NodalVector<Dim, double>& displacements) {
    std::vector<PrincipalStress> stresses(body.grid.size());
    for_gradients(body, displacements, [&](std::size_t e, const auto& gradient) {
        stresses[e] = principal_of(gradient, poisson);
    });
    return stresses;
}

template <std::size_t Dim>
std::vector<double> von_mises(const ElasticBody<Dim>& body, double poisson,
                              const NodalVector<Dim, double>& displacements) {
    std::vector<double> stress(body.grid.size());
    for_gradients(body, displacements,
                  [&](std::size_t e, const auto& gradient) { stress[e] = stress_of(gradient, poisson); });
    return stress;
}

template std::vector<PrincipalStress> greatest_principal_stresses(const ElasticBody<2>&, double,
                                                                  const NodalVector<2, double>&);
template std::vector<PrincipalStress> greatest_principal_stresses(const ElasticBody<3>&, double,
                                                                  const NodalVector<3, double>&);
template std::vector<double> von_mises(const ElasticBody<2>&, double, const NodalVector<2, double>&);
template std::vector<double> von_mises(const ElasticBody<3>&, double, const NodalVector<3, double>&);

}  // namespace lamella
