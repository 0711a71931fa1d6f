#pragma once

#include <functional>

#include "catch.h"
#include "guiding/field.h"
#include "statistics/random.h"

namespace test {

inline constexpr float kPi = 3.14159265358979f;
inline constexpr float kUniformPdf = 1 / (4 * kPi);

/// Incident radiance at a place from a direction.
using Radiance = std::function<float(const Imath::V3f& position, const Imath::V3f& wi)>;

inline Imath::V3f uniformDirection(Random& random) {
  const Imath::V2f u = random.next2D();
  const float z = 1 - 2 * u.x, phi = 2 * kPi * u.y, r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

inline Imath::V3f uniformPosition(Random& random) {
  const Imath::V2f xy = random.next2D();
  return {xy.x, xy.y, random.next1D()};
}

inline const Imath::Box3f kUnitCube{{0, 0, 0}, {1, 1, 1}};

inline guiding::Field makeField(const guiding::FieldSettings& settings, const Imath::Box3f& bounds = kUnitCube) {
  auto field = guiding::Field::create(bounds, settings);
  REQUIRE(field.ok());
  return std::move(field).value();
}

/// Samples as a host records them: places uniform in the unit cube, directions from the mixture of the guide and a
/// uniform density in the BSDF's place.
inline guiding::SampleBuffer record(const guiding::Field& field, const Radiance& radiance, int count, Random& random) {
  guiding::SampleBuffer buffer;
  for (int i = 0; i < count; ++i) {
    guiding::RadianceSample s;
    s.position = uniformPosition(random);
    const guiding::GuidingDistribution guide = field.bind(s.position);
    const float alpha = guide.bsdfSamplingFraction();
    s.direction = random.next1D() < alpha ? uniformDirection(random) : guide.sample(random.next2D()).wi;
    s.bsdfPdf = kUniformPdf;
    s.guidePdf = guide ? guide.pdf(s.direction) : 0;
    s.pdf = alpha * s.bsdfPdf + (1 - alpha) * s.guidePdf;
    s.radiance = s.product = radiance(s.position, s.direction);
    s.distance = 1;
    buffer.add(s);
  }
  return buffer;
}

/// Iterations of 2^k times `samples`; the field is checked after each.
inline guiding::Field train(const guiding::FieldSettings& settings, const Radiance& radiance, int iterations,
                            int samples, std::uint64_t seed = 1) {
  guiding::Field field = makeField(settings);
  Random random(seed);
  for (int k = 0; k < iterations; ++k) {
    REQUIRE(field.accumulate(record(field, radiance, samples << k, random)).ok());
    REQUIRE(field.endIteration(4 << k).ok());
    const guiding::Status valid = field.validate();
    if (!valid) FAIL(valid.error().text);
  }
  return field;
}

/// 1 inside a cone about the axis.
struct Cone {
  Imath::V3f axis{0, 0, 1};
  float cosHalfAngle = 0.9f;

  bool contains(const Imath::V3f& wi) const { return axis.dot(wi) > cosHalfAngle; }
  /// Integral of n.wi over the cone, if all of it lies above the horizon of n.
  double cosineIntegral(const Imath::V3f& n) const {
    return double(kPi) * (1 - double(cosHalfAngle) * cosHalfAngle) * n.dot(axis);
  }
};

}  // namespace test
