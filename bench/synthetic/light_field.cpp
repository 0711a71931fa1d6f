#include "synthetic/light_field.h"

#include <limits>

#include "synthetic/around_axis.h"

namespace bench {

namespace {

constexpr double kTau = 2 * std::numbers::pi;

bool isNear(const Light& light) {
  return light.shape == Light::Shape::Ball || light.shape == Light::Shape::NearLobe;
}

Imath::V3f axisOf(const Light& light, const Imath::V3f& position) {
  return isNear(light) ? (light.center - position).normalized() : light.center;
}

/// 1 - cosine of the angle under which the ball's radius is seen, without cancellation for a far one.
double capHeight(const Light& light, const Imath::V3f& position) {
  const double s2 = double(light.size) * light.size / (light.center - position).length2();
  return s2 / (1 + std::sqrt(std::max(0.0, 1 - s2)));
}

/// Whether the line of sight meets the ball; no square roots, for this is asked for each light and sample.
bool meetsBall(const Light& light, const Imath::V3f& position, const Imath::V3f& wi) {
  const Imath::V3f toCenter = light.center - position;
  const float along = toCenter.dot(wi);
  return along > 0 && (toCenter - wi * along).length2() < light.size * light.size;
}

double radianceOf(const Light& light, const Imath::V3f& position, const Imath::V3f& wi) {
  switch (light.shape) {
    case Light::Shape::Ball:
      return meetsBall(light, position, wi) ? light.radiance : 0;
    case Light::Shape::NearLobe:
    case Light::Shape::FarLobe: {
      const double exponent = light.size * versine(axisOf(light, position), wi);
      return exponent < 100 ? light.radiance * std::exp(-exponent) : 0;
    }
    case Light::Shape::Hemisphere:
      return light.center.dot(wi) > 0 ? light.radiance : 0;
    case Light::Shape::Background:
      return light.radiance;
  }
  return 0;
}

double fluenceOf(const Light& light, const Imath::V3f& position) {
  switch (light.shape) {
    case Light::Shape::Ball:
      return light.radiance * kTau * capHeight(light, position);
    case Light::Shape::NearLobe:
    case Light::Shape::FarLobe:
      return light.radiance * kTau * -std::expm1(-2.0 * light.size) / light.size;
    case Light::Shape::Hemisphere:
      return light.radiance * kTau;
    case Light::Shape::Background:
      return light.radiance * 2 * kTau;
  }
  return 0;
}

/// 1 - cosine of a direction drawn in proportion to the light's radiance.
double sampleVersine(const Light& light, const Imath::V3f& position, double u) {
  switch (light.shape) {
    case Light::Shape::Ball:
      return u * capHeight(light, position);
    case Light::Shape::NearLobe:
    case Light::Shape::FarLobe:
      return -std::log1p(u * std::expm1(-2.0 * light.size)) / light.size;
    case Light::Shape::Hemisphere:
      return u;
    case Light::Shape::Background:
      return 2 * u;
  }
  return 0;
}

}  // namespace

double LightField::radiance(const Imath::V3f& position, const Imath::V3f& wi) const noexcept {
  double sum = 0;
  for (const Light& light : lights) sum += radianceOf(light, position, wi);
  return sum;
}

double LightField::fluence(const Imath::V3f& position) const noexcept {
  double sum = 0;
  for (const Light& light : lights) sum += fluenceOf(light, position);
  return sum;
}

double LightField::distance(const Imath::V3f& position, const Imath::V3f& wi) const noexcept {
  const Light* brightest = nullptr;
  double most = 0;
  for (const Light& light : lights)
    if (const double radiance = radianceOf(light, position, wi); radiance > most) {
      most = radiance;
      brightest = &light;
    }
  if (!brightest || !isNear(*brightest)) return std::numeric_limits<double>::infinity();
  return (brightest->center - position).length();
}

Imath::V3f LightField::sample(const Imath::V3f& position, Random& random) const noexcept {
  double chosen = random.next1D() * fluence(position);
  const Light* light = &lights.back();
  for (const Light& candidate : lights) {
    chosen -= fluenceOf(candidate, position);
    if (chosen >= 0) continue;
    light = &candidate;
    break;
  }
  const double v = sampleVersine(*light, position, random.next1D());
  return aroundAxis(axisOf(*light, position), v, kTau * random.next1D());
}

LightField nearLights() {
  using Shape = Light::Shape;
  return {{{Shape::Ball, {0.5f, 0.5f, 1.4f}, 0.15f, 20},
           {Shape::Ball, {-0.3f, 0.2f, 0.6f}, 0.1f, 30},
           {Shape::Ball, {1.3f, 0.9f, 0.3f}, 0.2f, 10},
           {Shape::Ball, {0.6f, -0.5f, 0.1f}, 0.05f, 100},
           {Shape::Background, {0, 0, 1}, 0, 0.1f}}};
}

}  // namespace bench
