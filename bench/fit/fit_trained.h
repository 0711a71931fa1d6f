#pragma once

#include <guiding/sample.h>

#include "fit/fit.h"
#include "fit/fit_quality.h"
#include "synthetic/surface.h"

namespace bench {

/// Something that learns incident radiance in rounds and offers a guide: what fit() asks of the guiding library's field
/// and of its peers.
template <class L>
concept Learner = requires(L& learner, const guiding::SampleBuffer& buffer, const Imath::V3f& position,
                           const guiding::LobeSet& lobes, Random& random) {
  learner.learnRound(buffer);
  /// Bound to a surface's lobes, or alone; valid until the next call.
  requires guiding::Guide<decltype(learner.bind(position, lobes, random))>;
  requires guiding::Guide<decltype(learner.bind(position, random))>;
  { learner.leaves() } -> std::convertible_to<std::size_t>;
  { learner.bytes() } -> std::convertible_to<std::size_t>;
};

inline Surface randomSurface(Random& random) {
  return random.next1D() < 0.5f ? Surface::diffuse(random) : Surface::glossy(random);
}

/// One scattering as a guided renderer would record it; the radiance is noisy, with a relative variance of 1.
template <Learner L>
guiding::RadianceSample recordScattering(const LightField& light, L& learner, Random& random) {
  guiding::RadianceSample sample;
  sample.position = random.next3D();
  const Surface surface = randomSurface(random);
  const auto guide = learner.bind(sample.position, surface.lobes(), random);
  const double alpha = guide ? guide.bsdfSamplingFraction() : 1;
  sample.direction = random.next1D() < alpha ? surface.sample(random) : guide.sample(random.next2D()).wi;
  sample.bsdfPdf = float(surface.pdf(sample.direction));
  sample.guidePdf = guide ? guide.pdf(sample.direction) : 0.0f;
  sample.pdf = float(alpha * sample.bsdfPdf + (1 - alpha) * sample.guidePdf);
  const double noise = -std::log1p(-double(random.next1D()));
  sample.radiance = float(noise * light.radiance(sample.position, sample.direction));
  sample.product = float(sample.radiance * surface.bsdfCos(sample.direction));
  sample.distance = float(light.distance(sample.position, sample.direction));
  return sample;
}

/// Trains the learner on the light and measures it; see fit().
template <Learner L>
FitQuality fitTrained(const LightField& light, L& learner, const FitPlan& plan) {
  Random random(plan.seed);
  guiding::SampleBuffer buffer;
  for (int round = 0; round < plan.rounds; ++round) {
    buffer.clear();
    for (std::size_t i = 0; i < plan.samplesPerRound; ++i) buffer.add(recordScattering(light, learner, random));
    learner.learnRound(buffer);
  }

  FitQuality quality;
  quality.leaves = learner.leaves();
  quality.bytes = learner.bytes();
  MixtureMoments diffuseSum, glossySum;
  for (int i = 0; i < plan.places; ++i) {
    const Imath::V3f p = random.next3D();
    const GuideQuality guide = measureGuide(light, p, learner.bind(p, random), plan.samplesPerPlace, random);
    quality.divergence += guide.divergence / plan.places;
    quality.guideVariance += guide.variance / plan.places;
    const auto mixtureOf = [&](const Surface& surface) {
      return measureMixture(light, p, surface, learner.bind(p, surface.lobes(), random), plan.samplesPerPlace, random);
    };
    diffuseSum += mixtureOf(Surface::diffuse(random));
    glossySum += mixtureOf(Surface::glossy(random));
  }
  quality.diffuse = qualityOf(diffuseSum);
  quality.glossy = qualityOf(glossySum);
  return quality;
}

}  // namespace bench
