#include "openpgl/openpgl_guide.h"

#include <vector>

#include "integrators/guided_path_loop.h"
#include "openpgl/openpgl_field.h"

namespace pt {

namespace {

struct OpenPglGuides {
  static constexpr bool kGuides = true;
  using Distribution = OpenPglGuide;

  std::vector<std::unique_ptr<OpenPglDistribution>> distributions;  ///< one a worker
  float bsdfSamplingFraction;

  Distribution bind(const SurfaceInteraction& si, const SurfaceBsdf& bsdf, Sampler& sampler,
                    PathWorker& worker) const noexcept {
    OpenPglDistribution& distribution = *distributions[std::size_t(worker.index)];
    if (!distribution.bind(si.p, bsdf.lobes(), sampler.next1D())) return {};
    return {distribution, bsdfSamplingFraction};
  }
};

class Guide final : public PathGuide {
 public:
  Guide(const Scene& scene, const OpenPglSettings& settings)
      : m_settings(settings), m_field(createOpenPglField(scene.bounds(), settings)) {}

  void learn(std::span<const guiding::SampleBuffer> buffers) override { m_field->learn(buffers); }
  void endIteration(double) override { m_field->update(); }
  bool hasGuide() const noexcept override { return m_field->isTrained(); }
  std::unique_ptr<PathLoop> makeLoop(const Scene& scene, const RenderSettings& settings, int workers) const override {
    OpenPglGuides guides{{}, m_settings.bsdfSamplingFraction};
    for (int i = 0; i < workers; ++i) guides.distributions.push_back(m_field->newDistribution());
    return std::make_unique<GuidedPathLoop<OpenPglGuides>>(scene, settings, std::move(guides));
  }
  std::size_t memoryBytes() const override { return m_field->stats().memoryBytes; }

 private:
  OpenPglSettings m_settings;
  std::unique_ptr<OpenPglField> m_field;
};

}  // namespace

std::unique_ptr<PathGuide> makeOpenPglGuide(const Scene& scene, const OpenPglSettings& settings) {
  return std::make_unique<Guide>(scene, settings);
}

}  // namespace pt
