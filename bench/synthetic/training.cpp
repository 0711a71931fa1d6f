#include "synthetic/training.h"

#include <new>
#include <stdexcept>

namespace bench {

guiding::SampleBuffer recordSamples(const LightField& light, const guiding::Field& field, std::size_t count,
                                    Random& random) {
  guiding::SampleBuffer buffer;
  buffer.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    guiding::RadianceSample sample;
    sample.position = random.next3D();
    const guiding::GuidingDistribution guide = field.bind(sample.position);
    const float alpha = guide ? guide.bsdfSamplingFraction() : 1.0f;
    sample.direction = random.next1D() < alpha ? random.nextDirection() : guide.sample(random.next2D()).wi;
    sample.bsdfPdf = kUniformSpherePdf;
    sample.guidePdf = guide ? guide.pdf(sample.direction) : 0.0f;
    sample.pdf = alpha * sample.bsdfPdf + (1 - alpha) * sample.guidePdf;
    sample.radiance = float(light.radiance(sample.position, sample.direction));
    sample.product = sample.radiance;
    sample.distance = float(light.distance(sample.position, sample.direction));
    buffer.add(sample);
  }
  return buffer;
}

guiding::Field trainField(const LightField& light, const guiding::FieldSettings& settings, const TrainingPlan& plan,
                          std::uint64_t seed) {
  auto created = guiding::Field::create(Imath::Box3f({0, 0, 0}, {1, 1, 1}), settings);
  if (!created) throw std::invalid_argument(created.error().text);
  guiding::Field field = std::move(created).value();
  Random random(seed);
  for (int k = 0; k < plan.iterations; ++k) {
    if (!field.accumulate(recordSamples(light, field, plan.firstSamples << k, random)) ||
        !field.endIteration(4.0 * (1 << k)))
      throw std::bad_alloc();
  }
  return field;
}

}  // namespace bench
