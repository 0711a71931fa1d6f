// Creates, trains, binds, samples and saves a field with nothing but the installed headers and library.

#include <guiding/field.h>
#include <guiding/serialize.h>
#include <guiding/version.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace {

constexpr float kUniformPdf = 0.0795774715f;  // 1 / (4 pi)

Imath::V3f uniformDirection(std::mt19937& rng) {
  std::uniform_real_distribution<float> uniform(0, 1);
  const float z = 1 - 2 * uniform(rng), phi = 6.2831853f * uniform(rng), r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// All light comes from a cone about +z.
guiding::SampleBuffer recordSamples(std::mt19937& rng, int count) {
  std::uniform_real_distribution<float> uniform(0, 1);
  guiding::SampleBuffer buffer;
  for (int i = 0; i < count; ++i) {
    guiding::RadianceSample sample;
    sample.position = {uniform(rng), uniform(rng), uniform(rng)};
    sample.direction = uniformDirection(rng);
    sample.radiance = sample.direction.z > 0.9f ? 1.0f : 0.0f;
    sample.product = sample.radiance;
    sample.pdf = sample.bsdfPdf = kUniformPdf;
    sample.distance = 1;
    buffer.add(sample);
  }
  return buffer;
}

int fail(const char* what) {
  std::fprintf(stderr, "consumer: %s\n", what);
  return 1;
}

/// Share of the guide's directions that point into the cone; below 0 if sample and pdf disagree.
double shareInCone(const guiding::GuidingDistribution& guide, std::mt19937& rng) {
  std::uniform_real_distribution<float> uniform(0, 1);
  int hits = 0;
  const int count = 10000;
  for (int i = 0; i < count; ++i) {
    const guiding::DirectionSample s = guide.sample({uniform(rng), uniform(rng)});
    if (s.pdf != guide.pdf(s.wi)) return -1;
    hits += s.wi.z > 0.9f;
  }
  return double(hits) / count;
}

}  // namespace

int main() {
  std::mt19937 rng(7);
  auto field = guiding::Field::create(Imath::Box3f({0, 0, 0}, {1, 1, 1}), guiding::FieldSettings::mueller2017());
  if (!field) return fail(field.error().text.c_str());
  for (int iteration = 0; iteration < 4; ++iteration) {
    if (!field.value().accumulate(recordSamples(rng, 20000)) || !field.value().endIteration(4))
      return fail("training failed");
  }
  if (const auto status = field.value().validate(); !status) return fail(status.error().text.c_str());

  const auto guide = field.value().bind({0.5f, 0.5f, 0.5f});
  if (!guide) return fail("nothing was learned");
  const double share = shareInCone(guide, rng);
  if (!(share > 0.8)) return fail("the guide does not follow the light");

  if (const auto status = guiding::save(field.value(), "consumer.field"); !status)
    return fail(status.error().text.c_str());
  const auto loaded = guiding::load("consumer.field");
  if (!loaded) return fail(loaded.error().text.c_str());
  if (loaded.value().bind({0.5f, 0.5f, 0.5f}).pdf({0, 0, 1}) != guide.pdf({0, 0, 1}))
    return fail("the loaded field differs");

  std::printf("guiding %s: %.1f%% of the guided directions meet the light\n", guiding::kVersionText, 100 * share);
  return 0;
}
