// Tensors against what closed forms say of them.
#include "procedural/elasticity/elastic_tensor.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"

namespace elastic_tensor_test {

using namespace lamella;

TEST_CASE("an isotropic tensor is its own closest one", "[elasticity]") {
    for (const IsotropicMaterial m : {IsotropicMaterial{1, 0.3}, {2000, 0.45}, {7, -0.4}, {1, 0}}) {
        const ElasticTensor c = stiffness_of(m);
        CHECK(c[0][0] == Approx(m.young * (1 - m.poisson) / ((1 + m.poisson) * (1 - 2 * m.poisson))));
        const IsotropicMaterial same = closest_isotropic(c);
        CHECK(same.young == Approx(m.young));
        CHECK(same.poisson == Approx(m.poisson).margin(1e-12));
        CHECK(anisotropy(c) < 1e-12);
        const ElasticTensor s = compliance_of(c);
        CHECK(s[0][0] == Approx(1 / m.young));
        CHECK(s[0][1] == Approx(-m.poisson / m.young).margin(1e-15));
        CHECK(s[3][3] == Approx(1 / m.shear()));
        const Interval e = directional_moduli(s);
        CHECK(e.lo == Approx(m.young));
        CHECK(e.hi == Approx(m.young));
        CHECK(material_of(m.bulk(), m.shear()).young == Approx(m.young));
    }
}

TEST_CASE("the closest isotropic tensor is the mean over all ways to turn one", "[elasticity]") {
    // An octet truss of share p: C11 = p/6, C12 = C44 = p/12; E along an axis p/9, nu 1/3 (Deshpande, Fleck,
    // Ashby 2001). Its mean over rotations keeps the bulk modulus and has G = (C11 - C12 + 3 C44) / 5.
    ElasticTensor octet{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) octet[i][j] = i == j ? 1.0 / 6 : 1.0 / 12;
        octet[i + 3][i + 3] = 1.0 / 12;
    }
    const IsotropicMaterial mean = closest_isotropic(octet);
    CHECK(mean.bulk() == Approx(1.0 / 9));
    CHECK(mean.shear() == Approx((1.0 / 12 + 3.0 / 12) / 5));
    CHECK(directional_modulus(compliance_of(octet), {1, 0, 0}) == Approx(1.0 / 9));
    const Interval e = directional_moduli(compliance_of(octet));
    CHECK(e.lo == Approx(1.0 / 9));
    CHECK(e.hi == Approx(1.0 / 5));  // along a diagonal: 1 / E = 1 / (9 K) + 1 / (3 C44)
    CHECK(anisotropy(octet) > 0.1);
}

TEST_CASE("bounds of Hashin and Shtrikman have their limits", "[elasticity]") {
    const IsotropicMaterial solid{1, 1.0 / 3};
    CHECK(hashin_shtrikman(solid, 1).young == Approx(1));
    CHECK(hashin_shtrikman(solid, 1).poisson == Approx(1.0 / 3));
    const double little = 1e-6;
    const IsotropicMaterial thin = hashin_shtrikman(solid, little);
    CHECK(thin.bulk() == Approx(little / 3).epsilon(1e-5));
    CHECK(thin.shear() == Approx(little / 5).epsilon(1e-5));
    CHECK(thin.young == Approx(little / 2).epsilon(1e-5));
    CHECK(hashin_shtrikman(solid, 0.1415).young == Approx(0.0761).margin(0.00005));
}

TEST_CASE("what gives way for nothing has no compliance", "[elasticity]") {
    CHECK_THROWS_AS(compliance_of(ElasticTensor{}), FaultError);
    CHECK_THROWS_AS(check_material({-1, 0.3}), InputError);
}

}  // namespace elastic_tensor_test
