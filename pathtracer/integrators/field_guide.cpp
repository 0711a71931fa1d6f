#include "core/error.h"
#include "integrators/check_settings.h"
#include "integrators/guided_path_loop.h"
#include "integrators/path_guide.h"
#include "openpgl/openpgl_guide.h"

namespace pt {

namespace {

struct NoGuides {
  static constexpr bool kGuides = false;
  using Distribution = guiding::GuidingDistribution;

  Distribution bind(const SurfaceInteraction&, const SurfaceBsdf&, Sampler&, PathWorker&) const noexcept { return {}; }
};

struct FieldGuides {
  static constexpr bool kGuides = true;
  using Distribution = guiding::GuidingDistribution;
  const guiding::Field& field;

  Distribution bind(const SurfaceInteraction& si, const SurfaceBsdf& bsdf, Sampler&, PathWorker&) const noexcept {
    return field.settings().product ? field.bind(si.p, bsdf.lobes()) : field.bind(si.p);
  }
};

class FieldGuide final : public PathGuide {
 public:
  explicit FieldGuide(guiding::Field field) : m_field(std::move(field)) {}

  void learn(std::span<const guiding::SampleBuffer> buffers) override {
    if (const auto status = m_field.accumulate(buffers); !status)
      throw WorkError("learning from the paths failed: " + status.error().text);
  }
  void endIteration(double spp) override {
    if (const auto status = m_field.endIteration(spp); !status)
      throw WorkError("refining the guiding field failed: " + status.error().text);
  }
  bool hasGuide() const noexcept override { return m_field.hasGuide(); }
  std::unique_ptr<PathLoop> makeLoop(const Scene& scene, const RenderSettings& settings, int) const override {
    return std::make_unique<GuidedPathLoop<FieldGuides>>(scene, settings, FieldGuides{m_field});
  }
  std::size_t memoryBytes() const override { return m_field.stats().memoryBytes; }
  std::optional<guiding::Field> takeField() override { return std::move(m_field); }

 private:
  guiding::Field m_field;
};

}  // namespace

std::unique_ptr<PathGuide> makeGuide(const Scene& scene, const GuidingSettings& settings) {
  if (settings.openPgl) return makeOpenPglGuide(scene, *settings.openPgl);
  auto field = guiding::Field::create(scene.bounds(), settings.field);
  if (!field) throw InputError("cannot guide in this scene: " + field.error().text);
  return std::make_unique<FieldGuide>(std::move(field).value());
}

std::unique_ptr<PathGuide> pretrainedGuide(guiding::Field field, const Scene& scene) {
  checkFieldHolds(field, scene.bounds());
  return std::make_unique<FieldGuide>(std::move(field));
}

std::unique_ptr<PathLoop> unguidedLoop(const Scene& scene, const RenderSettings& settings) {
  return std::make_unique<GuidedPathLoop<NoGuides>>(scene, settings, NoGuides{});
}

}  // namespace pt
