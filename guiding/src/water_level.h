#pragma once

#include <limits>

#include "eight.h"

namespace guiding {

/// Solves sum_j max(alpha b_j, t_j/lambda) = alpha sum_j b_j + (1 - alpha) for lambda [KKT conditions of the smallest
/// second moment].
///
/// `forEachCells(visit)` calls visit(t, b) with eight cells at a time; Sum adds up eights. Dropping every cell with
/// t <= lambda alpha b raises lambda, so dropped cells never return and the loop ends. Rounding can bring a cell back
/// that lies on the very level; then the level is found as well.
template <class Eight, class Sum, class Real, class ForEachCells>
Real waterLevel(ForEachCells&& forEachCells, Real alpha) noexcept {
  Real lambda = 0, activeBefore = std::numeric_limits<Real>::max();
  for (;;) {
    Sum activeT, activeB;
    Eight active{};
    const Real level = lambda * alpha;
    forEachCells([&](const Eight& t, const Eight& b) {
      const auto isActive = t > b * level;
      activeT.add(isActive ? t : Eight{});
      activeB.add(isActive ? b : Eight{});
      active += isActive ? Eight{} + 1 : Eight{};
    });
    const Real count = sumOfLanes(active);
    if (!(count < activeBefore) || count == 0) return lambda;
    activeBefore = count;
    lambda = Real(activeT.total()) / ((1 - alpha) + alpha * Real(activeB.total()));
  }
}

}  // namespace guiding
