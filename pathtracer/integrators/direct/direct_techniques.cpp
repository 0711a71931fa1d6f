#include "integrators/direct/direct_techniques.h"

#include <limits>

#include "integrators/medium_stack.h"

namespace pt {

namespace {

constexpr std::array<float, 2> kBsdfAlone{1, 0}, kLightAlone{0, 1};

}  // namespace

TechniqueDraw DirectTechniques::drawBsdf(const SurfaceInteraction& si, const SurfaceBsdf& bsdf, bool knowsLights,
                                         Sampler& sampler, RenderCounters& counters) const noexcept {
  const TechniqueDraw nothing{Spectrum(0.0f), kBsdfAlone};
  const auto [uLobe, u] = sampler.nextChoice();
  const auto draw = bsdf.sample(uLobe, u);
  ++counters.scatterings;
  if (!(draw.pdf > 0) || isBlack(draw.weight)) return nothing;

  ++counters.rays;
  const Ray ray = m_scene.spawnRay(si, draw.wi);
  SurfaceInteraction hit;
  Spectrum emitted(0.0f);
  const bool meets = m_scene.intersect(ray, hit);
  if (meets) {
    if (hit.light) emitted = hit.light->radiance(hit, hit.wo);
  } else if (const EnvironmentLight* environment = m_scene.environment()) {
    emitted = environment->radianceFrom(draw.wi);
  }
  if (isBlack(emitted)) return nothing;
  if (m_hasMedia) emitted *= transmittance(si, draw.wi, meets ? hit.distance : std::numeric_limits<float>::infinity());
  if (draw.isDelta || !knowsLights) return {draw.weight * emitted, kBsdfAlone};
  const LightReceiver receiver = m_scene.receiver(si);
  const float lightPdf = meets ? m_scene.pdfDirect(receiver, hit) : m_scene.pdfEnvironment(receiver, draw.wi);
  return {draw.weight * draw.pdf * emitted, {draw.pdf, lightPdf}};
}

TechniqueDraw DirectTechniques::drawLight(const SurfaceInteraction& si, const SurfaceBsdf& bsdf, Sampler& sampler,
                                          RenderCounters& counters) const noexcept {
  const TechniqueDraw nothing{Spectrum(0.0f), kLightAlone};
  const auto [uLight, u] = sampler.nextChoice();
  const LightSample light = m_scene.sampleDirect(m_scene.receiver(si), uLight, u);
  if (!(light.pdf > 0) || isBlack(light.radiance)) return nothing;
  const BsdfEvaluation f = bsdf.evaluate(light.wi);
  if (isBlack(f.bsdfCos)) return nothing;
  ++counters.shadowRays;
  if (!m_scene.visible(si, light)) return nothing;
  Spectrum value = f.bsdfCos * light.radiance;
  if (m_hasMedia) value *= transmittance(si, light.wi, light.distance);
  if (light.isDelta) return {value / light.pdf, kLightAlone};
  return {value, {f.pdf, light.pdf}};
}

/// What absorbing media leave of the light on its way to `si`, where the camera's ray came from outside of them.
Spectrum DirectTechniques::transmittance(const SurfaceInteraction& si, const Vec3& wi, float distance) const noexcept {
  MediumStack media;
  media.pass(si, wi);
  return media.transmittance(distance);
}

}  // namespace pt
