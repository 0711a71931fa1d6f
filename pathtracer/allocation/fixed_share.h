#pragma once

#include "allocation/share_rule.h"

namespace pt {

/// The same share always.
class FixedShare {
 public:
  explicit FixedShare(double share = 0.5) noexcept : m_share(share) {}

  void add(const TechniqueSample&) noexcept {}
  void endDraw() noexcept {}
  void update(const ShareLimits&) noexcept {}
  double share() const noexcept { return m_share; }

 private:
  double m_share;
};

}  // namespace pt
