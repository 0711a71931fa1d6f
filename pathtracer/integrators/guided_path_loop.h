#pragma once

#include <guiding/mis.h>
#include <guiding/mixture.h>

#include "integrators/medium_stack.h"
#include "integrators/path_loop.h"
#include "integrators/surface_bsdf.h"
#include "scene/scene.h"

namespace pt {

/// Where the path loop gets the guide of a shading point from. The sampler and the worker are for look-ups that are
/// random or need memory. kGuides: whether there is a guide anywhere.
template <class G>
concept GuideSource = requires(const G& guides, const SurfaceInteraction& si, const SurfaceBsdf& bsdf, Sampler& sampler,
                               PathWorker& worker) {
  requires guiding::Guide<typename G::Distribution>;
  { G::kGuides } -> std::convertible_to<bool>;
  { guides.bind(si, bsdf, sampler, worker) } -> std::same_as<typename G::Distribution>;
};

/// The path tracer: unidirectional paths with light sampling, guided where `Guides` offers a guide.
template <GuideSource Guides>
class GuidedPathLoop final : public PathLoop {
 public:
  /// Light sampling is left out when no light of the scene can be sampled, absorption when no medium absorbs.
  GuidedPathLoop(const Scene& scene, const RenderSettings& settings, Guides guides) noexcept
      : m_scene(scene),
        m_guides(std::move(guides)),
        m_settings(settings.path),
        m_nee(settings.nee && scene.features().hasLightsToWeigh),
        m_hasMedia(scene.features().hasMedia),
        m_heuristic(settings.heuristic) {}

  Spectrum trace(Ray ray, int x, int y, Sampler& sampler, PathWorker& worker) const noexcept override;

 private:
  using Distribution = typename Guides::Distribution;
  struct PathState;

  /// Radiance of a light and the density with which light sampling would have found it; 0: it could not.
  struct Emission {
    Spectrum radiance{0.0f};
    float lightPdf = 0;
  };
  /// Light found by light sampling: as this estimator counts it, and as it would without a guide.
  struct DirectLight {
    Spectrum radiance{0.0f}, unguided{0.0f};
  };

  Emission emission(const PathState& path, const Ray& ray, const SurfaceInteraction* hit) const noexcept;
  bool survivesRoulette(PathState& path, Sampler& sampler, PathWorker& worker) const noexcept;
  void absorb(PathState& path, float distance) const noexcept;
  DirectLight sampleDirect(const PathState& path, const SurfaceInteraction& si, const SurfaceBsdf& bsdf,
                           const Distribution& guide, Sampler& sampler, RenderCounters& counters) const noexcept;
  bool scatter(PathState& path, const SurfaceInteraction& si, const SurfaceBsdf& bsdf, const Distribution& guide,
               Sampler& sampler, PathWorker& worker, Ray& ray) const noexcept;
  bool pathEnds(const PathState& path, const SurfaceInteraction& si) const noexcept;
  float misWeight(float pdf, float otherPdf) const noexcept;

  const Scene& m_scene;
  Guides m_guides;
  IntegratorDescription m_settings;
  bool m_nee;
  bool m_hasMedia;
  MisHeuristic m_heuristic;
};

template <GuideSource Guides>
struct GuidedPathLoop<Guides>::PathState {
  Spectrum radiance{0.0f};
  Spectrum throughput{1.0f};
  /// The throughput that BSDF sampling alone would have given this path. Roulette goes by it: a guide makes the
  /// throughput small exactly where much light is expected, and those paths must live.
  Spectrum unguidedThroughput{1.0f};
  Spectrum unguidedRadiance{0.0f};  ///< what BSDF sampling alone would have counted for this path
  float likelihood = 1;             ///< density of this path under BSDF sampling alone over its density here
  float eta = 1;                    ///< product of the relative indices of refraction crossed
  int depth = 1;                    ///< edges from the camera to the current hit
  LightReceiver previous;           ///< where the path scattered last
  float pdf = 0;                    ///< mixture density of the ray at `previous`, per solid angle
  float bsdfPdf = 0;                ///< the BSDF's own
  bool isDelta = true;  ///< light sampling at `previous` cannot find what the ray met: camera rays and delta scattering
  MediumStack media;    ///< around the ray
  Spectrum arriving{1.0f};  ///< share of the light on the ray that they leave
};

template <GuideSource Guides>
Spectrum GuidedPathLoop<Guides>::trace(Ray ray, int, int, Sampler& sampler, PathWorker& worker) const noexcept {
  PathState path;
  SurfaceInteraction si;
  if (worker.records) worker.recorder.begin();

  for (;; ++path.depth) {
    // The nearest surface
    ++worker.counters.rays;
    const bool hit = m_scene.intersect(ray, si);
    if (path.depth == 1 && worker.firstHit && hit)
      *worker.firstHit = {si.material ? si.material->albedo(si) : Spectrum(0.0f), si.frame.n, si.distance};
    if (worker.records && hit) worker.recorder.setDistance(si.distance);

    // What media leave of the light on the way
    if (m_hasMedia) absorb(path, hit ? si.distance : std::numeric_limits<float>::infinity());

    // Emission, weighted against light sampling
    const Emission emitted = emission(path, ray, hit ? &si : nullptr);
    const Spectrum weighted = emitted.radiance * misWeight(path.pdf, emitted.lightPdf);
    path.radiance += path.throughput * weighted;
    if constexpr (Guides::kGuides)
      path.unguidedRadiance += path.unguidedThroughput * emitted.radiance * misWeight(path.bsdfPdf, emitted.lightPdf);
    if (worker.records) worker.recorder.addEmission(weighted * path.arriving);

    // The end of the path
    if (!hit || pathEnds(path, si)) break;
    if (!survivesRoulette(path, sampler, worker)) break;

    // The guide at this point
    const SurfaceBsdf bsdf(si, m_settings.strictNormals);
    const bool hasSmooth = si.material->traits().hasSmooth;
    const auto guide = hasSmooth ? m_guides.bind(si, bsdf, sampler, worker) : Distribution();

    // Direct light
    if (m_nee && hasSmooth) {
      const DirectLight direct = sampleDirect(path, si, bsdf, guide, sampler, worker.counters);
      path.radiance += path.throughput * direct.radiance;
      if constexpr (Guides::kGuides) path.unguidedRadiance += path.unguidedThroughput * direct.unguided;
      if (worker.records) worker.recorder.addDirect(direct.radiance * path.arriving);
    }

    // The next direction
    if (!scatter(path, si, bsdf, guide, sampler, worker, ray)) break;
  }
  const float unguided = luminance(Guides::kGuides ? path.unguidedRadiance : path.radiance);
  worker.unguidedSquare = unguided * unguided * path.likelihood;
  return path.radiance;
}

template <GuideSource Guides>
auto GuidedPathLoop<Guides>::emission(const PathState& path, const Ray& ray,
                                      const SurfaceInteraction* hit) const noexcept -> Emission {
  if (m_settings.hideEmitters && path.depth == 1) return {};
  Spectrum emitted(0.0f);
  if (hit) {
    if (hit->light) emitted = hit->light->radiance(*hit, hit->wo);
  } else if (const EnvironmentLight* environment = m_scene.environment()) {
    emitted = environment->radianceFrom(ray.direction);
  }
  if (path.isDelta || !m_nee || isBlack(emitted)) return {emitted};
  return {emitted, hit ? m_scene.pdfDirect(path.previous, *hit) : m_scene.pdfEnvironment(path.previous, ray.direction)};
}

template <GuideSource Guides>
bool GuidedPathLoop<Guides>::pathEnds(const PathState& path, const SurfaceInteraction& si) const noexcept {
  if (!si.material) return true;
  if (m_settings.maxDepth >= 0 && path.depth >= m_settings.maxDepth) return true;
  return m_settings.strictNormals && si.ng.dot(si.wo) * si.frame.n.dot(si.wo) <= 0;
}

template <GuideSource Guides>
bool GuidedPathLoop<Guides>::survivesRoulette(PathState& path, Sampler& sampler, PathWorker& worker) const noexcept {
  if (path.depth <= m_settings.rrDepth) return true;
  // The radiance carried shrinks by eta^2 at each refraction and may grow again at the next; roulette looks past that.
  const float survivalProbability = std::min(maxComponent(path.unguidedThroughput) * path.eta * path.eta, 0.95f);
  if (!(sampler.next1D() < survivalProbability)) return false;
  path.throughput /= survivalProbability;
  path.unguidedThroughput /= survivalProbability;
  if (worker.records) worker.recorder.survived(survivalProbability);
  return true;
}

template <GuideSource Guides>
void GuidedPathLoop<Guides>::absorb(PathState& path, float distance) const noexcept {
  path.arriving = path.media.transmittance(distance);
  path.throughput *= path.arriving;
  path.unguidedThroughput *= path.arriving;
}

template <GuideSource Guides>
auto GuidedPathLoop<Guides>::sampleDirect(const PathState& path, const SurfaceInteraction& si, const SurfaceBsdf& bsdf,
                                          const Distribution& guide, Sampler& sampler,
                                          RenderCounters& counters) const noexcept -> DirectLight {
  const float uLight = sampler.next1D();
  const DirectSample light = m_scene.sampleDirect(m_scene.receiver(si), uLight, sampler.next2D());
  if (!(light.pdf > 0) || isBlack(light.radiance)) return {};
  const BsdfEvaluation f = bsdf.evaluate(light.wi);
  if (isBlack(f.bsdfCos)) return {};
  ++counters.shadowRays;
  if (!m_scene.visible(si, light)) return {};
  Spectrum unweighted = f.bsdfCos * light.radiance * (1 / light.pdf);
  if (m_hasMedia) {
    MediumStack media = path.media;  // the light's side of the surface
    media.pass(si, light.wi);
    unweighted *= media.transmittance(light.distance);
  }
  if (light.isDelta) return {unweighted, unweighted};
  return {unweighted * misWeight(light.pdf, guiding::mixturePdf(guide, f.pdf, light.wi)),
          unweighted * misWeight(light.pdf, f.pdf)};
}

template <GuideSource Guides>
bool GuidedPathLoop<Guides>::scatter(PathState& path, const SurfaceInteraction& si, const SurfaceBsdf& bsdf,
                                     const Distribution& guide, Sampler& sampler, PathWorker& worker,
                                     Ray& ray) const noexcept {
  const float uChoice = sampler.next1D();
  const auto draw = guiding::sampleMixture(bsdf, guide, uChoice, sampler.next2D());
  ++worker.counters.scatterings;
  if (guide) ++worker.counters.guidedScatterings;
  if constexpr (Guides::kGuides)
    if (draw.pdf > 0) path.likelihood *= draw.bsdfPdf / draw.pdf;
  if (isBlack(draw.weight)) return false;

  path.throughput *= draw.weight;
  path.unguidedThroughput *= draw.bsdfPdf > 0 ? draw.weight * (draw.pdf / draw.bsdfPdf) : draw.weight;
  path.eta *= bsdf.etaCrossed(draw.wi);
  path.previous = m_scene.receiver(si);
  path.pdf = draw.pdf;
  path.bsdfPdf = draw.bsdfPdf;
  path.isDelta = draw.isDelta;
  if (worker.records)
    worker.recorder.scatter({si.p, draw.wi, draw.weight * path.arriving, draw.bsdfCos, draw.pdf, draw.bsdfPdf,
                             draw.guidePdf, draw.isDelta});
  if (m_hasMedia) path.media.pass(si, draw.wi);
  ray = m_scene.spawnRay(si, draw.wi);
  return true;
}

template <GuideSource Guides>
float GuidedPathLoop<Guides>::misWeight(float pdf, float otherPdf) const noexcept {
  if (!(otherPdf > 0)) return 1;
  return guiding::misWeight(m_heuristic, pdf, otherPdf);
}

}  // namespace pt
