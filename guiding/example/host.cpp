// A host in miniature: a renderer with its own vectors, random numbers and BSDF that learns where the light of a room
// comes from.
//
// The room is a unit cube with grey diffuse walls. A small lamp in the ceiling is the only light, so most of what BSDF
// sampling does is in vain. The program prints the light that leaves a point of the floor, unguided and guided.

#include <guiding/field.h>
#include <guiding/mixture.h>
#include <guiding/path_recorder.h>
#include <guiding/serialize.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

namespace host {

struct Vec {
  float x, y, z;
};
Vec operator+(Vec a, Vec b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec operator*(Vec a, float s) {
  return {a.x * s, a.y * s, a.z * s};
}
float dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// 1. The library speaks Imath; two one-liners translate.
Imath::V3f toGuide(Vec v) {
  return {v.x, v.y, v.z};
}
Vec fromGuide(const Imath::V3f& v) {
  return {v.x, v.y, v.z};
}

struct Random {
  std::mt19937 engine;
  float operator()() { return float(engine() >> 8) * 0x1p-24f; }
};

constexpr float kPi = 3.14159265f, kAlbedo = 0.6f, kLampRadiance = 100, kLampHalfWidth = 0.05f;

struct Hit {
  Vec position, normal;
  float emission, distance;
};

// The wall that a ray from inside meets.
Hit trace(Vec o, Vec d) {
  float nearest = 1e9f;
  Vec normal{};
  const auto wall = [&](float origin, float direction, Vec inward) {
    const float t = direction > 0 ? (1 - origin) / direction : direction < 0 ? -origin / direction : 1e9f;
    if (t >= nearest) return;
    nearest = t;
    normal = inward * (direction > 0 ? -1.0f : 1.0f);
  };
  wall(o.x, d.x, {1, 0, 0});
  wall(o.y, d.y, {0, 1, 0});
  wall(o.z, d.z, {0, 0, 1});
  const Vec p = o + d * (nearest * 0.99999f);
  const bool lamp = normal.z < 0 && std::abs(p.x - 0.5f) < kLampHalfWidth && std::abs(p.y - 0.5f) < kLampHalfWidth;
  return {p, normal, lamp ? kLampRadiance : 0, nearest};
}

// 2. The host's BSDF as the mixture wants it: evaluate() and sample() for one shading point.
struct DiffuseBsdf {
  using Color = float;
  Vec normal;

  guiding::BsdfEvaluation<float> evaluate(const Imath::V3f& wi) const {
    const float cosine = std::max(0.0f, dot(normal, fromGuide(wi)));
    return {kAlbedo * cosine / kPi, cosine / kPi};
  }
  guiding::BsdfDraw<float> sample(float, const Imath::V2f& u) const {
    // A point of the unit sphere added to the normal is cosine-distributed.
    const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * u.y;
    const Vec v = normal + Vec{r * std::cos(phi), r * std::sin(phi), z};
    const float length = std::sqrt(dot(v, v));
    if (!(length > 1e-6f)) return {toGuide(normal), 0, 0, false};  // no weight: a failed sample
    const Imath::V3f wi = toGuide(v * (1 / length));
    return {wi, kAlbedo, evaluate(wi).pdf, false};
  }
  // What the BSDF looks like, roughly: lets the guide know the normal.
  guiding::LobeSet lobes() const {
    guiding::LobeSet set;
    set.add({guiding::Lobe::Shape::Cosine, toGuide(normal), 0, kAlbedo, 1});
    return set;
  }
};

// 3. One path: bind, sample the mixture, record.
float radiance(Vec position, Vec normal, const guiding::Field* field, Random& random, guiding::PathRecorder& recorder) {
  float throughput = 1, sum = 0;
  recorder.begin();
  for (int bounce = 0; bounce < 6; ++bounce) {
    const DiffuseBsdf bsdf{normal};
    const auto guide = field ? field->bind(toGuide(position), bsdf.lobes()) : guiding::GuidingDistribution();
    const float uChoice = random(), uX = random(), uY = random();
    const auto draw = guiding::sampleMixture(bsdf, guide, uChoice, {uX, uY});
    if (!(draw.weight > 0)) break;

    const auto grey = [](float x) { return Imath::V3f(x); };
    recorder.scatter({.position = toGuide(position),
                      .wi = draw.wi,
                      .weight = grey(draw.weight),
                      .bsdfCos = grey(draw.bsdfCos),
                      .pdf = draw.pdf,
                      .bsdfPdf = draw.bsdfPdf,
                      .guidePdf = draw.guidePdf,
                      .isDelta = draw.isDelta});
    throughput *= draw.weight;
    const Hit hit = trace(position, fromGuide(draw.wi));
    recorder.setDistance(hit.distance);
    recorder.addEmission(grey(hit.emission));
    sum += throughput * hit.emission;
    position = hit.position;
    normal = hit.normal;
  }
  return sum;
}

struct Estimate {
  double mean, standardError;
};

Estimate estimate(int paths, const guiding::Field* field, Random& random, guiding::SampleBuffer& samples) {
  guiding::PathRecorder recorder;
  double sum = 0, sumOfSquares = 0;
  for (int i = 0; i < paths; ++i) {
    const double x = radiance({0.2f, 0.3f, 1e-5f}, {0, 0, 1}, field, random, recorder);
    recorder.finish(samples);
    sum += x;
    sumOfSquares += x * x;
  }
  const double mean = sum / paths;
  return {mean, std::sqrt((sumOfSquares / paths - mean * mean) / (paths - 1))};
}

}  // namespace host

int main() {
  // 4. A field over the scene's bounds. Errors are values, nothing throws.
  auto created = guiding::Field::create({{0, 0, 0}, {1, 1, 1}}, guiding::FieldSettings::recommended());
  if (!created) {
    std::fprintf(stderr, "%s\n", created.error().text.c_str());
    return EXIT_FAILURE;
  }
  guiding::Field field = std::move(created).value();

  // 5. Training: render, accumulate, end the iteration; each one twice as long.
  host::Random random{std::mt19937(1)};
  for (int iteration = 0; iteration < 6; ++iteration) {
    guiding::SampleBuffer samples;
    host::estimate(2000 << iteration, field.hasGuide() ? &field : nullptr, random, samples);
    if (!field.accumulate(samples) || !field.endIteration(1 << iteration)) return EXIT_FAILURE;
  }

  // 6. Use, and keep it for the next frame.
  guiding::SampleBuffer unused;
  const host::Estimate plain = host::estimate(100000, nullptr, random, unused);
  const host::Estimate guided = host::estimate(100000, &field, random, unused);
  std::printf("unguided %.4f +- %.4f, guided %.4f +- %.4f\n", plain.mean, plain.standardError, guided.mean,
              guided.standardError);
  if (const auto saved = guiding::save(field, "room.field"); !saved) {
    std::fprintf(stderr, "%s\n", saved.error().text.c_str());
    return EXIT_FAILURE;
  }

  // Guiding changes the noise, never the mean.
  const double difference = std::abs(plain.mean - guided.mean) / std::hypot(plain.standardError, guided.standardError);
  return difference < 4 && guided.standardError < plain.standardError ? EXIT_SUCCESS : EXIT_FAILURE;
}
