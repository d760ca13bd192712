// Dense systems and eigenvalues in one order of operations, beside those of Eigen.
#include "procedural/elasticity/dense_symmetric.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

namespace dense_symmetric_test {

using namespace lamella;

namespace {

/// A symmetric matrix whose eigenvalues lie between 1 and some hundred.
Eigen::MatrixXd random_matrix(Eigen::Index n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    Eigen::MatrixXd a(n, n);
    for (Eigen::Index i = 0; i < n * n; ++i) a.data()[i] = number(random);
    return a * a.transpose() + Eigen::MatrixXd::Identity(n, n);
}

std::vector<double> entries_of(const Eigen::MatrixXd& matrix) {
    return {matrix.data(), matrix.data() + matrix.size()};
}

}  // namespace

TEST_CASE("dense systems are solved as Eigen solves them") {
    for (const int n : {1, 2, 7, 24, 90}) {
        CAPTURE(n);
        const Eigen::MatrixXd matrix = random_matrix(n, static_cast<unsigned>(n));
        DenseCholesky factors;
        REQUIRE(factors.factorise(entries_of(matrix), static_cast<std::size_t>(n)));
        std::vector<double> right(static_cast<std::size_t>(n));
        for (std::size_t i = 0; i < right.size(); ++i) right[i] = 1 / (1.0 + static_cast<double>(i));
        const Eigen::VectorXd expected = matrix.llt().solve(Eigen::Map<Eigen::VectorXd>(right.data(), n));
        factors.solve(right);
        for (int i = 0; i < n; ++i)
            CHECK(right[static_cast<std::size_t>(i)] == Approx(expected[i]).epsilon(1e-9).margin(1e-11));
    }
}

TEST_CASE("a matrix that is not positive definite is refused") {
    DenseCholesky factors;
    CHECK_FALSE(factors.factorise({1, 2, 2, 1}, 2));
    CHECK_FALSE(factors.factorise({0}, 1));
    CHECK_FALSE(factors.factorise({std::nan("")}, 1));
}

TEST_CASE("the greatest eigenvalue is that of Eigen") {
    CHECK(greatest_eigenvalue({-3}, 1) == -3);
    CHECK(greatest_eigenvalue({2, 1, 1, 2}, 2) == Approx(3).epsilon(1e-14));
    for (const int n : {3, 8, 24}) {
        const Eigen::MatrixXd matrix = random_matrix(n, static_cast<unsigned>(100 + n));
        const double expected = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
                                    .eigenvalues()
                                    .maxCoeff();
        CHECK(greatest_eigenvalue(entries_of(matrix), static_cast<std::size_t>(n)) ==
              Approx(expected).epsilon(1e-12));
    }
}

}  // namespace dense_symmetric_test
