#pragma once

#include "guiding/mixture.h"
#include "training_fixture.h"

namespace test {

/// A host's BSDF about a normal: a cosine lobe, and a mirror that is chosen with probability `deltaShare`.
class CosineAndMirror {
 public:
  using Color = float;

  CosineAndMirror(const Imath::V3f& normal, const Imath::V3f& mirrored, float albedo, float mirrorAlbedo,
                  float deltaShare)
      : m_normal(normal),
        m_mirrored(mirrored),
        m_albedo(albedo),
        m_mirrorAlbedo(mirrorAlbedo),
        m_deltaShare(deltaShare) {}

  guiding::BsdfEvaluation<float> evaluate(const Imath::V3f& wi) const {
    const float cosine = std::max(0.0f, m_normal.dot(wi)) / kPi;
    return {m_albedo * cosine, (1 - m_deltaShare) * cosine};
  }

  guiding::BsdfDraw<float> sample(float uLobe, const Imath::V2f& u) const {
    if (uLobe < m_deltaShare) return {m_mirrored, m_mirrorAlbedo / m_deltaShare, m_deltaShare, true};
    // A point of the sphere around the tip of the normal is cosine distributed.
    const float z = 1 - 2 * u.x, phi = 2 * kPi * u.y, r = std::sqrt(std::max(0.0f, 1 - z * z));
    const Imath::V3f wi = (m_normal + Imath::V3f(r * std::cos(phi), r * std::sin(phi), z)).normalized();
    const auto e = evaluate(wi);
    if (!(e.pdf > 0)) return {{NAN, NAN, NAN}, NAN, 0, false};  // a failed sample may hold anything
    return {wi, e.bsdfCos / e.pdf, e.pdf, false};
  }

  guiding::LobeSet lobes() const {
    guiding::LobeSet set;
    set.add({guiding::Lobe::Shape::Cosine, m_normal, 0, m_albedo, 1 - m_deltaShare});
    return set;
  }

 private:
  Imath::V3f m_normal, m_mirrored;
  float m_albedo, m_mirrorAlbedo, m_deltaShare;
};

inline const Imath::V3f kNormal = Imath::V3f(0.2f, -0.3f, 0.93f).normalized();
inline const Imath::V3f kMirrored = Imath::V3f(-0.5f, 0.1f, 0.8f).normalized();
inline const Cone kLight{Imath::V3f(0.5f, 0.4f, 0.6f).normalized(), 0.98f};
inline constexpr float kAmbient = 0.05f;

/// A bright cone before a dim background.
inline float coneRadiance(const Imath::V3f&, const Imath::V3f& wi) {
  return kLight.contains(wi) ? 10.0f : kAmbient;
}

/// What reaches the eye from CosineAndMirror about kNormal and kMirrored in coneRadiance.
inline double reflected(float albedo, float mirrorAlbedo) {
  return albedo * (kAmbient + (10.0 - kAmbient) / kPi * kLight.cosineIntegral(kNormal)) +
         mirrorAlbedo * coneRadiance({}, kMirrored);
}

/// Settings under which every path of the mixture's code is taken.
inline std::vector<guiding::FieldSettings> mixtureSettings() {
  guiding::FieldSettings plain = guiding::FieldSettings::mueller2017(), water = plain, skewed = plain,
                         best = guiding::FieldSettings::boundProduct();
  water.directionMap = guiding::DirectionMap::Octahedral;
  water.compensation.form = guiding::CompensationForm::WaterFilling;
  skewed.bsdfSamplingFraction = 0.2f;
  skewed.compensation = {guiding::CompensationForm::ClipRenormalise, 1.0f};
  return {plain, water, skewed, guiding::FieldSettings::production2019(), guiding::FieldSettings::recommended(), best};
}

}  // namespace test
