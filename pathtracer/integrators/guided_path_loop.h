#pragma once

#include <guiding/mis.h>
#include <guiding/mixture.h>

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

/// The path tracer: unidirectional paths with light sampling, guided where `Guides` offers a guide. Where
/// roulette splits a path, its branches are traced one after the other.
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
  void absorb(PathState& path, float distance) const noexcept;
  int playRoulette(PathState& path, const SurfaceInteraction& si, Sampler& sampler, PathWorker& worker) const noexcept;
  bool takeWaiting(PathState& path, SurfaceInteraction& si, PathWorker& worker) const noexcept;
  bool reflect(PathState& path, const SurfaceInteraction& si, Sampler& sampler, PathWorker& worker,
               Ray& ray) const noexcept;
  DirectLight sampleDirect(const PathState& path, const SurfaceInteraction& si, const SurfaceBsdf& bsdf,
                           const Distribution& guide, Sampler& sampler, PathWorker& worker) const noexcept;
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
Spectrum GuidedPathLoop<Guides>::trace(Ray ray, int, int, Sampler& sampler, PathWorker& worker) const noexcept {
  PathState path;
  SurfaceInteraction si;
  worker.branchesLeft = PathWorker::kMostBranches;
  if (worker.records) worker.recorder.begin();
  if (worker.reflections) worker.reflectionRecorder.begin();

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
    if (worker.reflections) worker.reflectionRecorder.add(path.throughput * weighted);

    // The end of the path, or how many branches it goes on in
    const int branches = hit && !pathEnds(path, si) ? playRoulette(path, si, sampler, worker) : 0;

    // Light reflected here; where a branch ends, at the last vertex where others wait
    bool goesOn = branches > 0 && reflect(path, si, sampler, worker, ray);
    while (!goesOn && takeWaiting(path, si, worker)) goesOn = reflect(path, si, sampler, worker, ray);
    if (!goesOn) break;
  }
  if (worker.reflections) worker.reflectionRecorder.closeTo(0, *worker.reflections);
  const double unguided = luminance(Guides::kGuides ? path.unguidedRadiance : path.radiance);
  worker.unguidedSquare = worker.roulette.isLearned() ? 0 : unguided * unguided * path.likelihood;
  return path.radiance;
}

/// Makes the last branch that waits the one under way; false if none waits.
template <GuideSource Guides>
bool GuidedPathLoop<Guides>::takeWaiting(PathState& path, SurfaceInteraction& si, PathWorker& worker) const noexcept {
  if (worker.waiting.empty()) return false;
  WaitingBranches& last = worker.waiting.back();
  const Spectrum radiance = path.radiance;
  path = last.path;
  path.radiance = radiance;
  si = last.si;
  if (worker.records) worker.recorder.returnTo(last.place);
  if (worker.reflections) worker.reflectionRecorder.closeTo(last.openReflections, *worker.reflections);
  if (--last.count == 0) worker.waiting.pop_back();
  return true;
}

/// Samples light and the next direction at the surface point; false: nothing comes from there.
template <GuideSource Guides>
bool GuidedPathLoop<Guides>::reflect(PathState& path, const SurfaceInteraction& si, Sampler& sampler,
                                     PathWorker& worker, Ray& ray) const noexcept {
  const bool hasSmooth = si.material->traits().hasSmooth;
  if (m_nee && hasSmooth) path.previous = m_scene.receiver(si);
  if (worker.reflections && hasSmooth) worker.reflectionRecorder.open(si.p, path.throughput);

  // The guide at this point
  const SurfaceBsdf bsdf(si, m_settings.strictNormals);
  const auto guide = hasSmooth ? m_guides.bind(si, bsdf, sampler, worker) : Distribution();

  // Direct light
  if (m_nee && hasSmooth) {
    const DirectLight direct = sampleDirect(path, si, bsdf, guide, sampler, worker);
    path.radiance += path.throughput * direct.radiance;
    if constexpr (Guides::kGuides) path.unguidedRadiance += path.unguidedThroughput * direct.unguided;
    if (worker.records) worker.recorder.addDirect(direct.radiance * path.arriving);
    if (worker.reflections) worker.reflectionRecorder.add(path.throughput * direct.radiance);
  }

  // The next direction
  return scatter(path, si, bsdf, guide, sampler, worker, ray);
}

template <GuideSource Guides>
auto GuidedPathLoop<Guides>::emission(const PathState& path, const Ray& ray,
                                      const SurfaceInteraction* hit) const noexcept -> Emission {
  if (m_settings.hideEmitters && path.isStraight) return {};
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

/// How many branches the path goes on in; all but one wait.
template <GuideSource Guides>
int GuidedPathLoop<Guides>::playRoulette(PathState& path, const SurfaceInteraction& si, Sampler& sampler,
                                         PathWorker& worker) const noexcept {
  const Spectrum& unguided = Guides::kGuides ? path.unguidedThroughput : path.throughput;
  float factor = worker.roulette.splittingFactor(path, unguided, si, worker.pixelScale);
  if (factor == 1) return 1;
  if (factor > 1 && factor > float(worker.branchesLeft)) {
    ++worker.counters.cappedSplits;
    factor = std::max(1.0f, float(worker.branchesLeft));
  }
  const int whole = int(factor);
  const int branches = whole + (sampler.next1D() < factor - float(whole) ? 1 : 0);
  if (branches == 0) return 0;

  path.throughput /= factor;
  if constexpr (Guides::kGuides) path.unguidedThroughput /= factor;
  if (worker.records) worker.recorder.survived(factor);
  if (branches > 1) {
    ++worker.counters.splits;
    worker.counters.branches += std::uint64_t(branches - 1);
    worker.branchesLeft -= branches - 1;
    worker.waiting.push_back({path, si, worker.recorder.place(), worker.reflectionRecorder.openCount(), branches - 1});
  }
  return branches;
}

template <GuideSource Guides>
void GuidedPathLoop<Guides>::absorb(PathState& path, float distance) const noexcept {
  path.arriving = path.media.transmittance(distance);
  path.throughput *= path.arriving;
  if constexpr (Guides::kGuides) path.unguidedThroughput *= path.arriving;
}

template <GuideSource Guides>
auto GuidedPathLoop<Guides>::sampleDirect(const PathState& path, const SurfaceInteraction& si, const SurfaceBsdf& bsdf,
                                          const Distribution& guide, Sampler& sampler,
                                          PathWorker& worker) const noexcept -> DirectLight {
  const auto [uLight, u] = sampler.nextChoice();
  const LightSample light = m_scene.sampleDirect(path.previous, uLight, u);
  if (!(light.pdf > 0) || isBlack(light.radiance)) return {};
  const BsdfEvaluation f = bsdf.evaluate(light.wi);
  if (isBlack(f.bsdfCos)) return {};
  ++worker.counters.shadowRays;
  if (worker.reflections) worker.reflectionRecorder.addCost(RouletteCost::kShadowRay);
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
  const auto [uChoice, u] = sampler.nextChoice();
  const auto draw = guiding::sampleMixture(bsdf, guide, uChoice, u);
  ++worker.counters.scatterings;
  if (worker.reflections) worker.reflectionRecorder.addCost(RouletteCost::kScattering);
  if (guide) ++worker.counters.guidedScatterings;
  if constexpr (Guides::kGuides) {
    if (draw.pdf > 0)
      path.likelihood *= draw.bsdfPdf / draw.pdf;
    else if (guide)  // a draw that failed, which one of the BSDF alone would have done too
      path.likelihood *= uChoice < guide.bsdfSamplingFraction() ? 1 / guide.bsdfSamplingFraction() : 0;
  }
  if (isBlack(draw.weight)) return false;

  path.throughput *= draw.weight;
  if constexpr (Guides::kGuides)
    path.unguidedThroughput *= draw.bsdfPdf > 0 ? draw.weight * (draw.pdf / draw.bsdfPdf) : draw.weight;
  path.eta *= bsdf.etaCrossed(draw.wi);
  path.pdf = draw.pdf;
  path.bsdfPdf = draw.bsdfPdf;
  path.isDelta = draw.isDelta;
  constexpr float kStraight = 1e-8f;  // roundings
  path.isStraight = path.isStraight && draw.isDelta && (draw.wi + si.wo).length2() < kStraight;
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
