#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace pt {

/// Draws an index with probability proportional to its weight in constant time [Walker 1974; Vose 1991].
class AliasTable {
 public:
  struct Pick {
    std::uint32_t index;
    double remainder;  ///< in [0,1), uniform and independent of the index
  };

  AliasTable() = default;
  /// Weights finite and not negative, their sum positive.
  explicit AliasTable(std::span<const double> weights);

  bool empty() const noexcept { return m_bins.empty(); }

  /// u in [0,1), with more bits than a float's 24 where the table is large or its weights differ much.
  Pick sample(double u) const noexcept {
    const double scaled = u * double(m_bins.size());
    const auto i = std::min(std::uint32_t(scaled), std::uint32_t(m_bins.size() - 1));
    const double within = scaled - i;
    const Bin bin = m_bins[i];
    if (bin.threshold >= 1) return {i, within};
    constexpr double kBelowOne = 0x1.fffffffffffffp-1;
    if (within < bin.threshold) return {i, std::min(within / bin.threshold, kBelowOne)};
    return {bin.alias, std::min((within - bin.threshold) / (1 - double(bin.threshold)), kBelowOne)};
  }

 private:
  struct Bin {
    float threshold;  ///< share of the bin that is its own index
    std::uint32_t alias;
  };
  std::vector<Bin> m_bins;
};

}  // namespace pt
