#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "allocation/share_rule.h"

namespace pt {

/// What the variance of a mixture is minimised over.
enum class ConvexVariables {
  Share,           ///< of sampling alone
  ShareAndControl  ///< and the coefficients of the two densities as control variates
};

/// The minimum of convexShare().
struct ConvexOptimum {
  double share = 0.5;
  std::array<double, 2> control{0, 0};  ///< in units of the integrand; zero without control variates
};

/// Minimises the sum of weight (f - c.p)^2 / (a p0 + (1 - a) p1) over the share a within its limits and, if asked, the
/// coefficients c: a convex problem, solved by damped Newton steps with a logarithmic barrier [He & Owen 2014, Sec. 5].
ConvexOptimum convexShare(std::span<const TechniqueSample> samples, ConvexVariables variables,
                          const ShareLimits& limits) noexcept;

/// The share that is optimal for the first samples, up to a capacity. They are kept, and later ones ignored.
template <ConvexVariables kVariables>
class ConvexShare {
 public:
  explicit ConvexShare(std::size_t capacity) { m_samples.reserve(capacity); }
  ConvexShare(ConvexShare&&) noexcept = default;  // a copy would lose the capacity

  void add(const TechniqueSample& sample) noexcept {
    if (m_samples.size() == m_samples.capacity()) return;
    if (sample.value > 0 || kVariables == ConvexVariables::ShareAndControl) {
      m_samples.push_back(sample);
      m_isDecided = false;
    }
  }
  void endDraw() noexcept {}
  void update(const ShareLimits& limits) noexcept {
    if (!m_isDecided) m_share = convexShare(m_samples, kVariables, limits).share;
    m_isDecided = true;
  }
  double share() const noexcept { return m_share; }

 private:
  std::vector<TechniqueSample> m_samples;
  double m_share = 0.5;
  bool m_isDecided = false;
};

}  // namespace pt
