#pragma once

#include <guiding/result.h>

#include "allocation/technique_sample.h"

namespace pt {

/// Who decides how many samples BSDF sampling and light sampling get. All but Fixed decide pixel by pixel, from what
/// earlier camera rays of the pixel found.
enum class Allocation {
  Fixed,                ///< DirectSettings::share
  SecondOrder,          ///< [Lu et al. 2013]
  Convex,               ///< the least variance of the pilot's samples [He & Owen 2014]
  ConvexControl,        ///< the same with the densities as control variates, for DirectEstimator::Optimal
  InverseVariance,      ///< 1 / (cost * variance) of each technique by itself [Sbert et al. 2016]
  EqualCountDeviation,  ///< deviation under equal counts over root of cost [Havran & Sbert 2014]
  EqualCountMoment,     ///< root of second moment over root of cost [Sbert et al. 2016]
  Representativity,     ///< likeness of density and integrand [Pajot et al. 2011]
  Population            ///< expectation maximisation, population Monte Carlo [Cappe et al. 2008]
};

/// How the samples become an estimate.
enum class DirectEstimator {
  MultiSample,   ///< whole counts of both techniques, weighted by RenderSettings::heuristic
  OneSample,     ///< each sample chooses its technique by chance
  Optimal,       ///< whole counts, optimal weights found from earlier camera rays (progressive) [Kondapaneni et al.
                 ///< 2019]
  OptimalDirect  ///< the same paper's direct estimator: consistent, but biased for few samples
};

inline bool usesOptimalWeights(DirectEstimator estimator) noexcept {
  return estimator == DirectEstimator::Optimal || estimator == DirectEstimator::OptimalDirect;
}

/// Light that reaches the camera over at most one surface point, sampled in earnest: each camera ray's point takes
/// several samples, shared between BSDF and light sampling.
struct DirectSettings {
  Allocation allocation = Allocation::Fixed;
  DirectEstimator estimator = DirectEstimator::MultiSample;
  int samples = 16;    ///< per camera ray; in [2, 4096]
  double share = 0.5;  ///< of BSDF sampling where it is fixed; in (0, 1). Counts have at least one sample of each.
  int pilot = 4;       ///< camera rays that meet a surface before the first decision; the next follow each time
                       ///< their number has doubled; in [1, 4096]
  ShareLimits limits;  ///< of decided shares

  guiding::Status validate() const;
};

}  // namespace pt
