// Columns are subtracted one after the other, so that loops over rows become vectors of any width without
// another result.
#include "procedural/elasticity/dense_symmetric.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lamella {
namespace {

/// The sum of products in a fixed order: four partial sums keep the processor busy.
double dot(const double* a, const double* b, std::size_t n) {
    double sum[4] = {};
    std::size_t i = 0;
    for (; i + 4 <= n; i += 4) {
        for (std::size_t k = 0; k < 4; ++k) sum[k] += a[i + k] * b[i + k];
    }
    for (; i < n; ++i) sum[0] += a[i] * b[i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// Turns rows and columns p and q so that the entry (p, q) vanishes.
void rotate(std::vector<double>& matrix, std::size_t n, std::size_t p, std::size_t q) {
    const auto at = [&](std::size_t row, std::size_t column) -> double& { return matrix[column * n + row]; };
    const double off = at(p, q);
    if (off == 0) return;
    const double half = 0.5 * (at(q, q) - at(p, p)) / off;
    const double tangent = (half < 0 ? -1.0 : 1.0) / (std::abs(half) + std::sqrt(half * half + 1));
    const double cosine = 1 / std::sqrt(tangent * tangent + 1), sine = tangent * cosine;
    for (std::size_t k = 0; k < n; ++k) {
        const double a = at(k, p), b = at(k, q);
        at(k, p) = cosine * a - sine * b;
        at(k, q) = sine * a + cosine * b;
    }
    for (std::size_t k = 0; k < n; ++k) {
        const double a = at(p, k), b = at(q, k);
        at(p, k) = cosine * a - sine * b;
        at(q, k) = sine * a + cosine * b;
    }
}

/// The sum of squares off the diagonal, and that of all.
std::pair<double, double> squares(const std::vector<double>& matrix, std::size_t n) {
    double off = 0, all = 0;
    for (std::size_t i = 0; i < n * n; ++i) {
        all += matrix[i] * matrix[i];
        if (i % (n + 1) != 0) off += matrix[i] * matrix[i];
    }
    return {off, all};
}

}  // namespace

bool DenseCholesky::factorise(std::vector<double> matrix, std::size_t n) {
    lower_ = std::move(matrix);
    n_ = n;
    for (std::size_t column = 0; column < n; ++column) {
        double* to = lower_.data() + column * n;
        for (std::size_t before = 0; before < column; ++before) {
            const double* from = lower_.data() + before * n;
            const double factor = from[column];
            for (std::size_t row = column; row < n; ++row) to[row] -= factor * from[row];
        }
        if (!(to[column] > 0)) return false;
        const double root = std::sqrt(to[column]);
        to[column] = root;
        for (std::size_t row = column + 1; row < n; ++row) to[row] /= root;
    }
    return true;
}

void DenseCholesky::solve(std::span<double> right) const {
    for (std::size_t column = 0; column < n_; ++column) {
        const double* from = lower_.data() + column * n_;
        right[column] /= from[column];
        for (std::size_t row = column + 1; row < n_; ++row) right[row] -= right[column] * from[row];
    }
    for (std::size_t column = n_; column-- > 0;) {
        const double* from = lower_.data() + column * n_;
        const std::size_t next = column + 1;
        const double known = next < n_ ? dot(from + next, right.data() + next, n_ - next) : 0;
        right[column] = (right[column] - known) / from[column];
    }
}

double greatest_eigenvalue(std::vector<double> matrix, std::size_t n) {
    constexpr int most_sweeps = 50;
    constexpr double noise = 1e-30;  // of the squares: entries of 1e-15 of the matrix
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        const auto [off, all] = squares(matrix, n);
        if (!(off > noise * all)) break;
        for (std::size_t p = 0; p + 1 < n; ++p) {
            for (std::size_t q = p + 1; q < n; ++q) rotate(matrix, n, p, q);
        }
    }
    double greatest = matrix.empty() ? 0 : matrix.front();
    for (std::size_t i = 0; i < n; ++i) greatest = std::max(greatest, matrix[i * n + i]);
    return greatest;
}

}  // namespace lamella
