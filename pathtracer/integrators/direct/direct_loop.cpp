#include "integrators/direct/direct_loop.h"

#include <guiding/mis.h>

#include <algorithm>
#include <vector>

#include "allocation/convex_share.h"
#include "allocation/equal_count_share.h"
#include "allocation/fixed_share.h"
#include "allocation/inverse_variance_share.h"
#include "allocation/optimal_weights.h"
#include "allocation/population_share.h"
#include "allocation/representativity_share.h"
#include "allocation/second_order_share.h"
#include "integrators/direct/direct_techniques.h"

namespace pt {

namespace {

/// Samples of each technique that one draw has, or is expected to have.
using Counts = std::array<float, 2>;

/// What a pixel knows for optimal weights.
struct PixelWeights {
  OptimalWeights sums;
  OptimalWeights::Coefficients coefficients;  ///< by earlier camera rays
};

template <ShareRule Rule>
class DirectLoop final : public PathLoop {
 public:
  /// makeRule() gives an untrained rule.
  template <class MakeRule>
  DirectLoop(const Scene& scene, const RenderSettings& settings, const MakeRule& makeRule);

  Spectrum trace(Ray ray, int x, int y, Sampler& sampler, PathWorker& worker) const noexcept override;

 private:
  struct Pixel {
    Rule rule;
    std::uint32_t draws = 0;
    std::uint32_t nextUpdate;
  };

  bool pathEnds(const SurfaceInteraction& si) const noexcept;
  Spectrum bsdfOnly(const SurfaceInteraction& si, const SurfaceBsdf& bsdf, Sampler& sampler,
                    PathWorker& worker) const noexcept;
  Color3d shared(const SurfaceInteraction& si, const SurfaceBsdf& bsdf, Pixel& pixel, PixelWeights* weights,
                 Sampler& sampler, PathWorker& worker) const noexcept;
  std::size_t bsdfCount(double share, float u) const noexcept;
  Color3d withDensities(const Color3d& sum, PixelWeights& weights, std::uint32_t draws) const noexcept;
  void learn(Pixel& pixel, PixelWeights* weights) const noexcept;

  const Scene& m_scene;
  DirectTechniques m_techniques;
  DirectSettings m_direct;
  IntegratorDescription m_path;
  MisHeuristic m_heuristic;
  bool m_samplesLights;
  std::size_t m_width;
  // Each pixel is changed by the one thread that renders it.
  mutable std::vector<Pixel> m_pixels;
  mutable std::vector<PixelWeights> m_weights;  ///< empty without optimal weights
};

template <ShareRule Rule>
template <class MakeRule>
DirectLoop<Rule>::DirectLoop(const Scene& scene, const RenderSettings& settings, const MakeRule& makeRule)
    : m_scene(scene),
      m_techniques(scene),
      m_direct(*settings.direct),
      m_path(settings.path),
      m_heuristic(settings.heuristic),
      m_samplesLights(settings.nee && scene.features().hasLightsToWeigh),
      m_width(std::size_t(settings.width)) {
  if (!m_samplesLights) return;
  const std::size_t pixels = m_width * std::size_t(settings.height);
  m_pixels.reserve(pixels);
  for (std::size_t i = 0; i < pixels; ++i) m_pixels.push_back({makeRule(), 0, std::uint32_t(m_direct.pilot)});
  if (usesOptimalWeights(m_direct.estimator)) m_weights.resize(pixels);
}

template <ShareRule Rule>
Spectrum DirectLoop<Rule>::trace(Ray ray, int x, int y, Sampler& sampler, PathWorker& worker) const noexcept {
  // The surface seen
  SurfaceInteraction si;
  ++worker.counters.rays;
  const bool hit = m_scene.intersect(ray, si);
  if (worker.firstHit && hit)
    *worker.firstHit = {si.material ? si.material->albedo(si) : Spectrum(0.0f), si.frame.n, si.distance};

  // Its emission
  Spectrum radiance(0.0f);
  if (!m_path.hideEmitters) {
    if (hit && si.light) radiance = si.light->radiance(si, si.wo);
    if (!hit && m_scene.environment()) radiance = m_scene.environment()->radianceFrom(ray.direction);
  }
  if (!hit || pathEnds(si)) return radiance;

  // The light that it scatters
  const SurfaceBsdf bsdf(si, m_path.strictNormals);
  if (!m_samplesLights || !si.material->traits().hasSmooth) return radiance + bsdfOnly(si, bsdf, sampler, worker);
  const std::size_t index = std::size_t(y) * m_width + std::size_t(x);
  Pixel& pixel = m_pixels[index];
  PixelWeights* weights = m_weights.empty() ? nullptr : &m_weights[index];
  Color3d scattered = shared(si, bsdf, pixel, weights, sampler, worker);
  if (weights) scattered = withDensities(scattered, *weights, pixel.draws);
  learn(pixel, weights);
  return radiance + Spectrum(scattered);
}

template <ShareRule Rule>
bool DirectLoop<Rule>::pathEnds(const SurfaceInteraction& si) const noexcept {
  if (!si.material || m_path.maxDepth == 1) return true;
  return m_path.strictNormals && si.ng.dot(si.wo) * si.frame.n.dot(si.wo) <= 0;
}

template <ShareRule Rule>
Spectrum DirectLoop<Rule>::bsdfOnly(const SurfaceInteraction& si, const SurfaceBsdf& bsdf, Sampler& sampler,
                                    PathWorker& worker) const noexcept {
  Spectrum sum(0.0f);
  for (int i = 0; i < m_direct.samples; ++i)
    sum += m_techniques.drawBsdf(si, bsdf, false, sampler, worker.counters).value;
  return sum / float(m_direct.samples);
}

/// Whole counts come out in proportion to the share on average over u; at least one sample of each technique.
template <ShareRule Rule>
std::size_t DirectLoop<Rule>::bsdfCount(double share, float u) const noexcept {
  // The direct estimator asks for the same counts every time.
  const double rounding = m_direct.estimator == DirectEstimator::OptimalDirect ? 0.5 : double(u);
  return std::size_t(std::clamp(int(share * m_direct.samples + rounding), 1, m_direct.samples - 1));
}

template <ShareRule Rule>
Color3d DirectLoop<Rule>::shared(const SurfaceInteraction& si, const SurfaceBsdf& bsdf, Pixel& pixel,
                                 PixelWeights* weights, Sampler& sampler, PathWorker& worker) const noexcept {
  const bool isOneSample = m_direct.estimator == DirectEstimator::OneSample;
  const auto samples = std::size_t(m_direct.samples);
  const auto share = float(pixel.rule.share());
  const std::size_t bsdfSamples = bsdfCount(share, sampler.next1D());
  const Counts counts = isOneSample ? Counts{share * float(samples), (1 - share) * float(samples)}
                                    : Counts{float(bsdfSamples), float(samples - bsdfSamples)};

  Color3d sum(0.0);
  for (std::size_t i = 0; i < samples; ++i) {
    const bool isBsdf = isOneSample ? sampler.next1D() < share : i < bsdfSamples;
    const TechniqueDraw draw = isBsdf ? m_techniques.drawBsdf(si, bsdf, true, sampler, worker.counters)
                                      : m_techniques.drawLight(si, bsdf, sampler, worker.counters);
    const Counts densities{counts[0] * draw.pdf[0], counts[1] * draw.pdf[1]};
    const std::array<double, 2> pdf{draw.pdf[0], draw.pdf[1]};
    const double invDensity = 1 / (double(densities[0]) + double(densities[1]));
    if (weights) {
      sum += (Color3d(draw.value) - weights->coefficients.dot(pdf)) * invDensity;
      weights->sums.add(Color3d(draw.value), pdf, invDensity);
    } else {
      const std::size_t own = isBsdf ? kBsdfSampling : kLightSampling;
      sum +=
          Color3d(draw.value * (guiding::misWeight(m_heuristic, densities[own], densities[1 - own]) / densities[own]));
    }
    pixel.rule.add({double(luminance(draw.value)), pdf, invDensity});
  }
  pixel.rule.endDraw();
  ++pixel.draws;
  return sum;
}

/// The estimate by optimal weights, given what the samples add to the densities' part.
template <ShareRule Rule>
Color3d DirectLoop<Rule>::withDensities(const Color3d& sum, PixelWeights& weights, std::uint32_t draws) const noexcept {
  const Color3d before = weights.coefficients.sum();
  if (m_direct.estimator == DirectEstimator::Optimal) return before + sum;
  // The mean of what camera rays add is to be the direct estimate from all of them.
  weights.coefficients = weights.sums.solve();
  return weights.coefficients.sum() * double(draws) - before * double(draws - 1);
}

/// Decides by the samples so far how the next are drawn.
template <ShareRule Rule>
void DirectLoop<Rule>::learn(Pixel& pixel, PixelWeights* weights) const noexcept {
  if (pixel.draws < pixel.nextUpdate) return;
  pixel.nextUpdate *= 2;
  pixel.rule.update(m_direct.limits);
  if (m_direct.estimator == DirectEstimator::Optimal) weights->coefficients = weights->sums.solve();
}

/// Rules are made from the same arguments for each pixel.
template <class Rule, class... Arguments>
std::unique_ptr<PathLoop> loopWith(const Scene& scene, const RenderSettings& settings, Arguments... arguments) {
  return std::make_unique<DirectLoop<Rule>>(scene, settings, [=] { return Rule(arguments...); });
}

}  // namespace

std::unique_ptr<PathLoop> directLoop(const Scene& scene, const RenderSettings& settings) {
  const DirectSettings& direct = *settings.direct;
  const std::size_t pilotSamples = std::size_t(direct.pilot) * std::size_t(direct.samples);
  switch (direct.allocation) {
    case Allocation::Fixed:
      break;
    case Allocation::SecondOrder:
      return loopWith<SecondOrderShare>(scene, settings);
    case Allocation::Convex:
      return loopWith<ConvexShare<ConvexVariables::Share>>(scene, settings, pilotSamples);
    case Allocation::ConvexControl:
      return loopWith<ConvexShare<ConvexVariables::ShareAndControl>>(scene, settings, pilotSamples);
    case Allocation::InverseVariance:
      return loopWith<InverseVarianceShare>(scene, settings);
    case Allocation::EqualCountDeviation:
      return loopWith<EqualCountShare<EqualCountForm::Deviation>>(scene, settings);
    case Allocation::EqualCountMoment:
      return loopWith<EqualCountShare<EqualCountForm::Moment>>(scene, settings);
    case Allocation::Representativity:
      return loopWith<RepresentativityShare>(scene, settings);
    case Allocation::Population:
      return loopWith<PopulationShare>(scene, settings);
  }
  return loopWith<FixedShare>(scene, settings, direct.share);
}

}  // namespace pt
