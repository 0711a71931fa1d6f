#include "synthetic/surface.h"

#include "synthetic/around_axis.h"

namespace bench {

namespace {

using Shape = guiding::Lobe::Shape;

double density(const guiding::Lobe& lobe, const Imath::V3f& wi) {
  if (lobe.shape == Shape::Cosine) return std::max(0.0f, lobe.axis.dot(wi)) / std::numbers::pi;
  const double k = lobe.sharpness;
  return k / (2 * std::numbers::pi * -std::expm1(-2 * k)) * std::exp(-k * versine(lobe.axis, wi));
}

Imath::V3f sampleLobe(const guiding::Lobe& lobe, Random& random) {
  const double u = random.next1D(), k = lobe.sharpness;
  const double v = lobe.shape == Shape::Cosine ? 1 - std::sqrt(1 - u) : -std::log1p(u * std::expm1(-2 * k)) / k;
  return aroundAxis(lobe.axis, v, 2 * std::numbers::pi * random.next1D());
}

}  // namespace

Surface Surface::diffuse(Random& random) {
  guiding::LobeSet lobes;
  lobes.add({Shape::Cosine, random.nextDirection(), 0, 0.7f, 1});
  return Surface(lobes);
}

Surface Surface::glossy(Random& random) {
  const Imath::V3f normal = random.nextDirection();
  Imath::V3f mirrored = random.nextDirection();
  if (mirrored.dot(normal) < 0) mirrored = -mirrored;
  guiding::LobeSet lobes;
  lobes.add({Shape::Cosine, normal, 0, 0.4f, 0.5f});
  lobes.add({Shape::SphericalGaussian, mirrored, 60, 0.4f, 0.5f});
  return Surface(lobes);
}

double Surface::bsdfCos(const Imath::V3f& wi) const {
  double sum = 0;
  for (const guiding::Lobe& lobe : m_lobes.lobes()) sum += lobe.reflectance * density(lobe, wi);
  return sum;
}

double Surface::pdf(const Imath::V3f& wi) const {
  double sum = 0;
  for (const guiding::Lobe& lobe : m_lobes.lobes()) sum += lobe.samplingShare * density(lobe, wi);
  return sum;
}

Imath::V3f Surface::sample(Random& random) const {
  double chosen = random.next1D();
  for (const guiding::Lobe& lobe : m_lobes.lobes()) {
    chosen -= lobe.samplingShare;
    if (chosen < 0) return sampleLobe(lobe, random);
  }
  return sampleLobe(m_lobes.lobes().back(), random);
}

}  // namespace bench
