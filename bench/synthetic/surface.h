#pragma once

#include <guiding/lobes.h>

#include "synthetic/random.h"

namespace bench {

/// A shading point whose BSDF consists of the very lobes that the library knows, so that they describe it exactly.
class Surface {
 public:
  explicit Surface(const guiding::LobeSet& lobes) : m_lobes(lobes) {}

  /// Diffuse, about a random normal.
  static Surface diffuse(Random& random);
  /// Half diffuse, half a Gaussian lobe of sharpness 60 about a random direction of the upper hemisphere.
  static Surface glossy(Random& random);

  const guiding::LobeSet& lobes() const { return m_lobes; }
  /// BSDF * |cos|.
  double bsdfCos(const Imath::V3f& wi) const;
  /// Density of sample(), per solid angle.
  double pdf(const Imath::V3f& wi) const;
  Imath::V3f sample(Random& random) const;

 private:
  guiding::LobeSet m_lobes;
};

}  // namespace bench
