// Small dense symmetric matrices, in one order of operations: libraries choose theirs by the vectors and
// caches of the machine, and what is rounded differently there would make other layers of an optimised part.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lamella {

/// Cholesky's factorisation of a symmetric matrix, for some hundred unknowns.
class DenseCholesky {
  public:
    /// Factorises a matrix of n columns, of which the part from the diagonal down is read: entry (row,
    /// column) is matrix[column * n + row]. Returns false if it is not positive definite.
    bool factorise(std::vector<double> matrix, std::size_t n);
    /// Replaces the right side by the solution. The matrix must have been factorised.
    void solve(std::span<double> right) const;

  private:
    std::vector<double> lower_;  // column by column
    std::size_t n_ = 0;
};

/// Returns the largest eigenvalue of a symmetric matrix of n columns, by Jacobi's rotations.
double greatest_eigenvalue(std::vector<double> matrix, std::size_t n);

}  // namespace lamella
