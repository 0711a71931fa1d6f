#pragma once

#include <concepts>

#include "allocation/technique_sample.h"

namespace pt {

/// Learns from samples which share of the next ones the first of two techniques should draw. Samples may have been
/// drawn with any shares. Begins with equal shares.
///
/// An estimator stays unbiased as long as the share it draws with was decided by other samples.
template <class R>
concept ShareRule = requires(R rule, const R& decided, const TechniqueSample& sample, const ShareLimits& limits) {
  rule.add(sample);
  rule.endDraw();       ///< the samples since the last call were one draw
  rule.update(limits);  ///< decides by what was added so far
  { decided.share() } -> std::same_as<double>;
};

}  // namespace pt
