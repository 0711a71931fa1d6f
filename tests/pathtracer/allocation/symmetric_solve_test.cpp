#include "allocation/symmetric_solve.h"

#include "catch.h"
#include "statistics/random.h"

namespace {

using Matrix = pt::SquareMatrix<3>;
using Vector = std::array<double, 3>;

/// Sum of outer products of `rank` random vectors.
Matrix randomMatrix(test::Random& random, int rank) {
  Matrix a{};
  for (int k = 0; k < rank; ++k) {
    Vector v{};
    for (double& x : v) x = random.next1D() - 0.5;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) a[i][j] += v[i] * v[j];
  }
  return a;
}

Vector times(const Matrix& a, const Vector& x) {
  Vector y{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) y[i] += a[i][j] * x[j];
  return y;
}

}  // namespace

TEST_CASE("symmetric systems of every rank are solved") {
  test::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Matrix a = randomMatrix(random, i % 5);
    const Vector b = times(a, {random.next1D(), random.next1D(), random.next1D()});  // in the range of a
    const Vector found = times(a, pt::solveSymmetric<3>(a, b, 1e-12));
    for (std::size_t j = 0; j < 3; ++j) CHECK(found[j] == Approx(b[j]).margin(1e-9));
  }
}

TEST_CASE("directions below the cut are left at zero") {
  const Matrix a{{{4, 0, 0}, {0, 1e-8, 0}, {0, 0, 1}}};
  const Vector x = pt::solveSymmetric<3>(a, {8, 1, 3}, 1e-6);
  CHECK(x[0] == 2);
  CHECK(x[1] == 0);
  CHECK(x[2] == 3);
}
