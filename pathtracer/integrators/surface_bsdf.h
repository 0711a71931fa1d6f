#pragma once

#include <guiding/mixture.h>

#include "core/types.h"
#include "materials/material.h"
#include "scene/interaction.h"

namespace pt {

/// A material at one surface point with world space directions: what guiding::sampleMixture asks of a host's BSDF.
class SurfaceBsdf {
 public:
  using Color = Spectrum;

  /// With `strictNormals`, directions on different sides of the geometric and the shading normal scatter nothing.
  SurfaceBsdf(const SurfaceInteraction& si, bool strictNormals) noexcept
      : m_si(si), m_woLocal(si.frame.toLocal(si.wo)), m_strictNormals(strictNormals) {}

  BsdfEvaluation evaluate(const Vec3& wi) const noexcept {
    const Vec3 wiLocal = m_si.frame.toLocal(wi);
    BsdfEvaluation e = m_si.material->evaluate(m_si, m_woLocal, wiLocal);
    if (leaks(wi, wiLocal)) e.bsdfCos = Spectrum(0.0f);
    return e;
  }

  guiding::BsdfDraw<Spectrum> sample(float uLobe, const Vec2& u) const noexcept {
    const BsdfSample s = m_si.material->sample(m_si, m_woLocal, uLobe, u);
    if (isBlack(s.weight)) return {m_si.frame.n, Spectrum(0.0f), 0, false};  // its direction may be anything
    guiding::BsdfDraw<Spectrum> draw{m_si.frame.toWorld(s.wi), s.weight, s.pdf, s.isDelta};
    if (leaks(draw.wi, s.wi)) draw.weight = Spectrum(0.0f);
    return draw;
  }

  /// What the guide multiplies with.
  guiding::LobeSet lobes() const noexcept {
    guiding::LobeSet local, world;
    m_si.material->describeLobes(m_si, m_woLocal, local);
    for (guiding::Lobe lobe : local.lobes()) {
      lobe.axis = m_si.frame.toWorld(lobe.axis);
      world.add(lobe);
    }
    return world;
  }

  float etaCrossed(const Vec3& wi) const noexcept {
    return m_si.material->etaCrossed(m_woLocal, m_si.frame.toLocal(wi));
  }

 private:
  bool leaks(const Vec3& wi, const Vec3& wiLocal) const noexcept {
    return m_strictNormals && m_si.ng.dot(wi) * cosTheta(wiLocal) <= 0;
  }

  const SurfaceInteraction& m_si;
  Vec3 m_woLocal;
  bool m_strictNormals;
};

}  // namespace pt
