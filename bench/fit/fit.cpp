#include "fit/fit.h"

#include <guiding/field.h>

#include <new>
#include <stdexcept>

#include "fit/fit_quality.h"
#include "synthetic/surface.h"

namespace bench {

namespace {

Surface randomSurface(Random& random) {
  return random.next1D() < 0.5f ? Surface::diffuse(random) : Surface::glossy(random);
}

/// One scattering as a guided renderer would record it; the radiance is noisy, with a relative variance of 1.
guiding::RadianceSample record(const LightField& light, const guiding::Field& field, Random& random) {
  guiding::RadianceSample sample;
  sample.position = random.next3D();
  const Surface surface = randomSurface(random);
  const guiding::GuidingDistribution guide = field.bind(sample.position, surface.lobes());
  const double alpha = guide ? guide.bsdfSamplingFraction() : 1;
  sample.direction = random.next1D() < alpha ? surface.sample(random) : guide.sample(random.next2D()).wi;
  sample.bsdfPdf = float(surface.pdf(sample.direction));
  sample.guidePdf = guide ? guide.pdf(sample.direction) : 0.0f;
  sample.pdf = float(alpha * sample.bsdfPdf + (1 - alpha) * sample.guidePdf);
  const double noise = -std::log1p(-double(random.next1D()));
  sample.radiance = float(noise * light.radiance(sample.position, sample.direction));
  sample.product = float(sample.radiance * surface.bsdfCos(sample.direction));
  sample.distance = 1;
  return sample;
}

guiding::Field train(const LightField& light, const guiding::FieldSettings& settings, const FitPlan& plan,
                     Random& random) {
  auto created = guiding::Field::create(Imath::Box3f({0, 0, 0}, {1, 1, 1}), settings);
  if (!created) throw std::invalid_argument(created.error().text);
  guiding::Field field = std::move(created).value();
  guiding::SampleBuffer buffer;
  for (int round = 0; round < plan.rounds; ++round) {
    buffer.clear();
    for (std::size_t i = 0; i < plan.samplesPerRound; ++i) buffer.add(record(light, field, random));
    // 2 samples per pixel make the rule c sqrt(2 n / 4) a constant: leaves of sTreeThreshold samples.
    if (!field.accumulate(buffer) || !field.endIteration(2)) throw std::bad_alloc();
  }
  return field;
}

void add(MixtureMoments& sum, const MixtureMoments& m) {
  sum.mixture += m.mixture;
  sum.optimum += m.optimum;
  sum.reflectedSquared += m.reflectedSquared;
}

MixtureQuality qualityOf(const MixtureMoments& sum) {
  return {sum.mixture / sum.reflectedSquared - 1, sum.optimum / sum.reflectedSquared - 1};
}

}  // namespace

FitQuality fit(const LightField& light, const guiding::FieldSettings& settings, const FitPlan& plan) {
  Random random(plan.seed);
  const guiding::Field field = train(light, settings, plan, random);
  FitQuality quality;
  quality.leaves = field.stats().spatialLeaves;
  quality.bytes = field.stats().memoryBytes;
  MixtureMoments diffuseSum, glossySum;
  for (int i = 0; i < plan.places; ++i) {
    const Imath::V3f p = random.next3D();
    const GuideQuality guide = measureGuide(light, p, field.bind(p), plan.samplesPerPlace, random);
    quality.divergence += guide.divergence / plan.places;
    quality.guideVariance += guide.variance / plan.places;
    const auto mixtureOf = [&](const Surface& surface) {
      return measureMixture(light, p, surface, field.bind(p, surface.lobes()), plan.samplesPerPlace, random);
    };
    add(diffuseSum, mixtureOf(Surface::diffuse(random)));
    add(glossySum, mixtureOf(Surface::glossy(random)));
  }
  quality.diffuse = qualityOf(diffuseSum);
  quality.glossy = qualityOf(glossySum);
  return quality;
}

}  // namespace bench
