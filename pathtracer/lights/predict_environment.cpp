#include "lights/predict_environment.h"

#include <vector>

#include "core/parallel.h"
#include "core/types.h"

namespace pt {
namespace {

constexpr int kNormals = 128;

/// Evenly spread over the sphere [spherical Fibonacci points].
Vec3 normalOf(int i) {
  const double z = 1 - (2 * i + 1.0) / kNormals, r = std::sqrt(1 - z * z);
  const double phi = 2.399963229728653 * i;  // the golden angle
  return Vec3(float(r * std::cos(phi)), float(z), float(r * std::sin(phi)));
}

struct Texel {
  Vec3 direction;
  double solidAngle, radiance, pdf;  ///< pdf: of light sampling, per solid angle
};

std::vector<Texel> texelsOf(const guiding::EnvironmentImage& map, std::span<const float> sampling) {
  const guiding::EnvironmentLayout& layout = map.layout;
  const bool toPoles = layout.mapping() == guiding::EnvironmentMapping::LatLongToPoles;
  std::vector<Texel> texels;
  texels.reserve(layout.texels());
  double total = 0;
  for (int y = 0; y < layout.height(); ++y)
    for (int x = 0; x < layout.width(); ++x) {
      const float v = toPoles ? float(y) / float(layout.height() - 1) : (float(y) + 0.5f) / float(layout.height());
      const std::size_t i = texels.size();
      const double solidAngle = 4 * double(kPi) * layout.texelShare(y);
      texels.push_back({layout.toDirection({(float(x) + 0.5f) / float(layout.width()), v}), solidAngle,
                        map.luminance[i], sampling[i]});
      total += sampling[i] * solidAngle;
    }
  for (Texel& texel : texels) texel.pdf = total > 0 ? texel.pdf / total : 0;
  return texels;
}

struct Moments {
  double variance = 0, squaredMean = 0;
};

Moments momentsFor(const std::vector<Texel>& texels, const Vec3& normal) {
  double second = 0, byLight = 0, byCosine = 0;
  for (const Texel& texel : texels) {
    const double cosine = normal.dot(texel.direction) / double(kPi);
    if (!(cosine > 0)) continue;
    const double f = texel.radiance * cosine, both = texel.pdf + cosine;
    second += f * f / both * texel.solidAngle;
    byLight += f * texel.pdf / both * texel.solidAngle;
    byCosine += f * cosine / both * texel.solidAngle;
  }
  return {second - byLight * byLight - byCosine * byCosine, (byLight + byCosine) * (byLight + byCosine)};
}

}  // namespace

double predictVariance(const guiding::EnvironmentImage& map, std::span<const float> sampling) {
  const std::vector<Texel> texels = texelsOf(map, sampling);
  std::vector<Moments> moments(kNormals);
  parallelFor(kNormals, [&](std::size_t i) { moments[i] = momentsFor(texels, normalOf(int(i))); });
  Moments sum;
  for (const Moments& m : moments) {
    sum.variance += m.variance;
    sum.squaredMean += m.squaredMean;
  }
  return sum.squaredMean > 0 ? sum.variance / sum.squaredMean : 0;
}

}  // namespace pt
