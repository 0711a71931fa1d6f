#pragma once

#include <cmath>

#include "guiding/lobes.h"
#include "training_fixture.h"

namespace test {

/// Any settings that validate() takes, and lights and lobes to try them on.
class RandomCases {
 public:
  explicit RandomCases(std::uint64_t seed) : m_random(seed) {}

  guiding::FieldSettings settings() {
    using namespace guiding;
    FieldSettings s;
    s.directionMap = DirectionMap(below(2));
    s.sTreeThreshold = std::pow(10.0, 1 + 3 * uniform());
    s.dTreeThreshold = std::pow(10.0f, -3 * uniform()) * 0.5f;
    s.maxDTreeDepth = 1 + below(20);
    s.maxMemoryBytes = below(4) == 0 ? 200'000 : 0;
    s.spatialFilter = SpatialFilter(below(2));
    s.directionalFilter = DirectionalFilter(below(2));
    s.bsdfSamplingFraction = 0.02f + 0.97f * uniform();
    s.fractionMode = FractionMode(below(3));
    s.fractionLoss = FractionLoss(below(2));
    s.compensation = {CompensationForm(below(3)), below(3) == 0 ? 1.0f : uniform()};
    s.target = LearningTarget(below(2));
    s.product = s.target == LearningTarget::Radiance && below(2) == 0;
    s.neighbourWeight = below(2) == 0 ? 0 : uniform();
    s.recordClip = below(2) == 0 ? 0 : 0.1f * uniform();
    s.minimalGain = below(2) == 0 ? 0 : 0.1f * uniform();
    return s;
  }

  /// Cones of any size and strength before a background that may be black; the first moves with the place.
  Radiance light() {
    const Cone a{uniformDirection(m_random), 1 - std::pow(10.0f, -4 * uniform())}, b{uniformDirection(m_random), 0.5f};
    const float strength = std::pow(10.0f, 6 * uniform() - 3), background = below(2) == 0 ? 0 : 0.1f * strength;
    const float scale = std::pow(10.0f, 20 * uniform() - 10);
    return [=](const Imath::V3f& p, const Imath::V3f& wi) {
      Cone moving = a;
      moving.axis = (a.axis + (p - Imath::V3f(0.5f)) * 0.2f).normalized();
      return scale * (background + (moving.contains(wi) ? strength : 0) + (b.contains(wi) ? 1.0f : 0));
    };
  }

  guiding::LobeSet lobes() {
    guiding::LobeSet set;
    for (int i = below(4); i > 0; --i) {
      guiding::Lobe lobe;
      lobe.shape = guiding::Lobe::Shape(below(2));
      lobe.axis = uniformDirection(m_random);
      lobe.sharpness = std::pow(10.0f, 6 * uniform() - 2);
      lobe.reflectance = uniform();
      lobe.samplingShare = uniform() / 4;
      set.add(lobe);
    }
    return set;
  }

  float uniform() { return m_random.next1D(); }
  int below(int count) { return int(m_random.next1D() * float(count)); }
  Random& random() { return m_random; }

 private:
  Random m_random;
};

}  // namespace test
