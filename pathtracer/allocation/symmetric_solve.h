#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace pt {

template <std::size_t N>
using SquareMatrix = std::array<std::array<double, N>, N>;

/// Solves A x = b for a symmetric A without negative eigenvalues by Cholesky's factors with pivoting. Directions whose
/// pivot falls below `cut` times the first are left at 0: a solution of the least squares where A is singular.
template <std::size_t N>
std::array<double, N> solveSymmetric(SquareMatrix<N> a, std::array<double, N> b, double cut) noexcept {
  std::array<std::size_t, N> order{};
  for (std::size_t i = 0; i < N; ++i) order[i] = i;
  double largest = 0;
  std::size_t rank = 0;
  for (; rank < N; ++rank) {
    std::size_t pivot = rank;
    for (std::size_t i = rank + 1; i < N; ++i)
      if (a[i][i] > a[pivot][pivot]) pivot = i;
    if (rank == 0) largest = a[pivot][pivot];
    if (!(a[pivot][pivot] > cut * largest) || !(largest > 0)) break;
    std::swap(order[rank], order[pivot]);
    std::swap(b[rank], b[pivot]);
    std::swap(a[rank], a[pivot]);
    for (auto& row : a) std::swap(row[rank], row[pivot]);
    // Eliminate: what remains below is the Schur complement.
    for (std::size_t i = rank + 1; i < N; ++i) {
      const double factor = a[i][rank] / a[rank][rank];
      for (std::size_t j = rank + 1; j < N; ++j) a[i][j] -= factor * a[rank][j];
      b[i] -= factor * b[rank];
    }
  }

  std::array<double, N> x{};
  for (std::size_t i = rank; i-- > 0;) {
    double rest = b[i];
    for (std::size_t j = i + 1; j < rank; ++j) rest -= a[i][j] * x[order[j]];
    x[order[i]] = rest / a[i][i];
  }
  return x;
}

}  // namespace pt
