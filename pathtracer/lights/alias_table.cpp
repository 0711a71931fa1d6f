#include "lights/alias_table.h"

#include <algorithm>

namespace pt {

AliasTable::AliasTable(std::span<const double> weights) : m_bins(weights.size()) {
  const double largest = *std::max_element(weights.begin(), weights.end());  // sums of large weights must not overflow
  double sum = 0;
  for (double w : weights) sum += w / largest;

  std::vector<double> share(weights.size());
  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    share[i] = weights[i] / largest / sum * double(weights.size());
    (share[i] < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::uint32_t s = small.back(), l = large.back();
    small.pop_back();
    m_bins[s] = {float(share[s]), l};
    share[l] -= 1 - share[s];
    if (share[l] < 1) {
      large.pop_back();
      small.push_back(l);
    }
  }
  for (std::uint32_t i : large) m_bins[i] = {1, i};
  for (std::uint32_t i : small) m_bins[i] = {1, i};  // 1 but for rounding
}

}  // namespace pt
