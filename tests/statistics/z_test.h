#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace test {

/// Mean and variance of independent values, in one pass [Welford 1962].
class RunningMean {
 public:
  void add(double value);

  std::size_t count() const { return m_count; }
  double mean() const { return m_mean; }
  double variance() const;        ///< unbiased, of one value; 0 for fewer than 2
  double varianceOfMean() const;  ///< 0 for fewer than 2

 private:
  std::size_t m_count = 0;
  double m_mean = 0, m_sumOfSquares = 0;
};

struct ZResult {
  bool passed = false;
  double z = 0;       ///< difference in standard errors (of the worst tile)
  double pValue = 0;  ///< probability of such a difference, or of one such tile among all, between equal means
  double level = 0;
  std::size_t worst = 0;  ///< index of the tile with the smallest p-value
  std::string message;

  explicit operator bool() const { return passed; }
};

/// Whether the mean is `reference`. The variance is estimated, so the difference follows Student's t; many values make
/// it a z-test.
ZResult zTest(const RunningMean& values, double reference, double significance = 0.01);

/// Whether two means agree, variances unknown and unequal [Welch 1947].
ZResult zTest(const RunningMean& a, const RunningMean& b, double significance = 0.01);

/// Whether the means agree in all tiles; `significance` is that of the whole family [Sidak 1967].
ZResult zTestTiles(std::span<const RunningMean> a, std::span<const RunningMean> b, double significance = 0.01);
ZResult zTestTiles(std::span<const RunningMean> values, std::span<const double> references, double significance = 0.01);

}  // namespace test
