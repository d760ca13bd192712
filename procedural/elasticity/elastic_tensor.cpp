// Projections and norms, in Mandel notation where tensor norms are matrix norms.
#include "procedural/elasticity/elastic_tensor.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/error.h"

namespace lamella {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

Matrix6 matrix_of(const ElasticTensor& tensor) {
    Matrix6 m;
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j)
            m(i, j) = tensor[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
    return m;
}

/// The Frobenius norm of the fourth-order tensor. Each shear index pair counts twice.
double norm(const ElasticTensor& stiffness) {
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
            sum += stiffness[i][j] * stiffness[i][j] * (i < 3 ? 1 : 2) * (j < 3 ? 1 : 2);
    }
    return std::sqrt(sum);
}

}  // namespace

IsotropicMaterial material_of(double bulk, double shear) {
    return {9 * bulk * shear / (3 * bulk + shear), (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))};
}

void check_material(const IsotropicMaterial& material) {
    if (!(material.young > 0) || !std::isfinite(material.young))
        throw InputError("a material's Young modulus is " + std::to_string(material.young) +
                         "; accepted: numbers above 0");
    if (!(-1 < material.poisson && material.poisson < 0.5))
        throw InputError("a material's Poisson ratio is " + std::to_string(material.poisson) +
                         "; accepted: numbers above -1 and below 0.5");
}

ElasticTensor stiffness_of(const IsotropicMaterial& material) {
    const double shear = material.shear(), lame = material.bulk() - 2.0 / 3 * shear;
    ElasticTensor c{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) c[i][j] = lame;
        c[i][i] += 2 * shear;
        c[i + 3][i + 3] = shear;
    }
    return c;
}

IsotropicMaterial closest_isotropic(const ElasticTensor& c) {
    double straight = 0, shears = 0, sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        straight += c[i][i];
        shears += c[i + 3][i + 3];
        for (std::size_t j = 0; j < 3; ++j) sum += c[i][j];
    }
    const double bulk = sum / 9;
    return material_of(bulk, (straight + 2 * shears - 3 * bulk) / 10);
}

double anisotropy(const ElasticTensor& stiffness) {
    const ElasticTensor isotropic = stiffness_of(closest_isotropic(stiffness));
    ElasticTensor rest = stiffness;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) rest[i][j] -= isotropic[i][j];
    }
    return norm(rest) / norm(isotropic);
}

ElasticTensor compliance_of(const ElasticTensor& stiffness) {
    const Eigen::FullPivLU<Matrix6> factors(matrix_of(stiffness));
    if (!factors.isInvertible())
        throw FaultError("the structure does not resist every strain; it has no compliance");
    const Matrix6 inverse = factors.inverse();
    ElasticTensor s{};
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j)
            s[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = inverse(i, j);
    }
    return s;
}

double directional_modulus(const ElasticTensor& compliance, dvec3 n) {
    const std::array<double, 6> v{n.x * n.x, n.y * n.y, n.z * n.z, n.x * n.y, n.y * n.z, n.z * n.x};
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) sum += compliance[i][j] * v[i] * v[j];
    }
    return 1 / sum;
}

Interval directional_moduli(const ElasticTensor& compliance) {
    constexpr int count = 4096;
    constexpr double golden_angle = 2.399963229728653;
    Interval found{infinity, -infinity};
    const auto look = [&](dvec3 n) {
        const double e = directional_modulus(compliance, glm::normalize(n));
        found = {std::min(found.lo, e), std::max(found.hi, e)};
    };
    for (int i = 0; i < count; ++i) {  // evenly over a hemisphere
        const double z = (i + 0.5) / count, r = std::sqrt(1 - z * z), a = golden_angle * i;
        look({r * std::cos(a), r * std::sin(a), z});
    }
    for (int k = 1; k < 27; ++k) {  // symmetry axes of cubic structures, where extremes often are
        const dvec3 n(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        if (n != dvec3(0)) look(n);
    }
    return found;
}

IsotropicMaterial hashin_shtrikman(const IsotropicMaterial& material, double share) {
    const double k = material.bulk(), g = material.shear();
    const double bulk = 4 * g * k * share / (4 * g + 3 * k * (1 - share)),
                 shear = share * g * (9 * k + 8 * g) / (15 * k + 20 * g - 6 * share * (k + 2 * g));
    return material_of(bulk, shear);
}

}  // namespace lamella
