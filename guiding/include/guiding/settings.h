#pragma once

#include <cstddef>

#include "guiding/result.h"

namespace guiding {

/// How the unit square of a directional quadtree is laid over the sphere. Both maps preserve area.
enum class DirectionMap {
  Cylinder,    ///< (cos theta + 1)/2 and phi/(2 pi) about z [Müller et al. 2017, Sec. 3.2]
  Octahedral,  ///< equal-area octahedron [Clarberg 2008]
};

/// How the sampled density is sharpened against the BSDF before it is sampled [Karlík et al. 2019].
enum class CompensationForm {
  None,          ///< the learned density as it is
  WaterFilling,  ///< exact optimum max(alpha b, t/lambda); b is uniform, or learned or given by lobes with the product
  ClipRenormalise,  ///< published form: clip t/T - alpha b at zero and renormalise
};

struct CompensationSettings {
  CompensationForm form = CompensationForm::None;
  /// Factor on the BSDF share that is assumed, in [0, 1]. 0 leaves the density as it is.
  float strength = 1.0f;
};

/// What the quadtrees learn, and so what the guide's density is proportional to.
enum class LearningTarget {
  Radiance,  ///< incident radiance [Müller et al. 2017]
  /// Radiance * BSDF * cos, averaged over the surfaces of a spatial leaf. Compensated against the mean of the BSDFs'
  /// densities, which is learned beside it, instead of a uniform density.
  Product,
};

/// Where in space a sample is learned.
enum class SpatialFilter {
  Nearest,        ///< in the leaf that contains it
  StochasticBox,  ///< in the leaf that contains a random point of a box around it, as large as its own leaf [Müller
                  ///< 2019]
};

/// Where on the sphere a sample is learned.
enum class DirectionalFilter {
  Nearest,  ///< in the cell that contains its direction
  Box,      ///< spread over a square around it, as large as that cell; wraps around the sphere [Müller 2019]
};

/// How the bsdfSamplingFraction of a spatial leaf comes about.
enum class FractionMode {
  Fixed,  ///< FieldSettings::bsdfSamplingFraction everywhere
  Adam,   ///< stochastic gradient descent over the samples in their order [Müller 2019]
  Fit,    ///< the minimum of the loss over all samples of the iteration, which is convex in the fraction
};

/// What a learned bsdfSamplingFraction minimises.
enum class FractionLoss {
  KullbackLeibler,
  Variance,
};

/// Settings of the SD-tree and of the density that is sampled from it.
struct FieldSettings {
  DirectionMap directionMap = DirectionMap::Cylinder;
  LearningTarget target = LearningTarget::Radiance;

  /// After an iteration of n samples per pixel, a spatial leaf is halved until its share of that iteration's samples is
  /// at most sTreeThreshold * sqrt(2 n / 4): the coming iteration has twice the samples [Müller et al. 2017, Sec. 3.3].
  /// Range: >= 1.
  double sTreeThreshold = 12000.0;
  /// The spatial tree is not refined (and stats() says so) where that would take the field above this many bytes, as
  /// far as can be foreseen. The quadtrees are not held back. 0: no cap.
  std::size_t maxMemoryBytes = 0;

  /// A quadtree cell is subdivided when it holds more than this share of the leaf's flux, so that no quadtree has more
  /// than maxDTreeDepth over this many nodes. Range: [1e-4, 1).
  float dTreeThreshold = 0.01f;
  /// Depth cap of the quadtrees. Range: [1, 20].
  int maxDTreeDepth = 20;

  SpatialFilter spatialFilter = SpatialFilter::Nearest;
  DirectionalFilter directionalFilter = DirectionalFilter::Nearest;

  /// What a spatial leaf learned is joined by what the leaves beside its six faces learned, each with this weight
  /// beside 1 of its own, and less where it has fewer samples. Their shapes over the directions are joined, not their
  /// levels. Range: >= 0, finite; 0: each leaf for itself.
  float neighbourWeight = 0;

  /// Probability of sampling the BSDF rather than the guide. Range: (0, 1]; 1: no guide. Where it is learned, what
  /// learning starts from (but within [0.05, 0.95], as what it learns).
  float bsdfSamplingFraction = 0.5f;
  FractionMode fractionMode = FractionMode::Fixed;
  FractionLoss fractionLoss = FractionLoss::KullbackLeibler;

  /// A spatial leaf offers no guide as long as the loss that its fraction minimises falls by less than this against
  /// sampling the BSDF alone: nats, or a share of the second moment for FractionLoss::Variance. Only
  /// FractionMode::Fit can tell; no effect with the others. With `product` a leaf that rests is judged by its density
  /// without the lobes, so that it may rest longer than it needs. Range: >= 0; 0: every leaf that learned something
  /// offers its guide.
  float minimalGain = 0;

  /// A sample is learned with at most this share of all that its spatial leaf learned in the iteration before, so that
  /// a single outlier cannot draw the guide to itself. Only the guide changes by it, never the mean of the picture.
  /// Range: >= 0; 0: no limit.
  float recordClip = 0;

  CompensationSettings compensation;

  /// Multiply the learned radiance with the host's lobes at each shading point (see Field::bind). Compensation then
  /// happens there, against the lobes instead of a uniform density. Takes LearningTarget::Radiance.
  bool product = false;

  /// The algorithm of the paper [Müller et al. 2017]: no compensation, fixed fraction one half.
  static FieldSettings mueller2017() { return {}; }

  /// The improvements of [Müller 2019], with the values its author recommends.
  static FieldSettings production2019();

  /// What our measurements recommend (bench/README.md).
  static FieldSettings recommended();

  /// The density bound to the shading point by the host's lobes, and all that goes with it: of the densities that learn
  /// the radiance the one with the least error for a number of samples, at a price in time (bench/README.md).
  static FieldSettings boundProduct();

  /// Ok, or which field is out of range.
  Status validate() const;
};

}  // namespace guiding
