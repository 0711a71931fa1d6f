#include "fit/fit_trained.h"
#include "openpgl/openpgl_field.h"
#include "peers/openpgl_bench.h"

namespace bench {

namespace {

class OpenPglLearner {
 public:
  explicit OpenPglLearner(const pt::OpenPglSettings& settings)
      : m_field(pt::createOpenPglField(Imath::Box3f({0, 0, 0}, {1, 1, 1}), settings)),
        m_distribution(m_field->newDistribution()),
        m_fraction(settings.bsdfSamplingFraction) {}

  void learnRound(const guiding::SampleBuffer& buffer) {
    m_field->learn(std::span(&buffer, 1));
    m_field->update();
  }
  pt::OpenPglGuide bind(const Imath::V3f& position, const guiding::LobeSet& lobes, Random& random) {
    if (!m_field->isTrained() || !m_distribution->bind(position, lobes, random.next1D())) return {};
    return {*m_distribution, m_fraction};
  }
  pt::OpenPglGuide bind(const Imath::V3f& position, Random& random) { return bind(position, {}, random); }
  std::size_t leaves() const { return m_field->stats().spatialLeaves; }
  std::size_t bytes() const { return m_field->stats().memoryBytes; }

 private:
  std::unique_ptr<pt::OpenPglField> m_field;
  std::unique_ptr<pt::OpenPglDistribution> m_distribution;
  float m_fraction;
};

}  // namespace

FitQuality fitOpenPgl(const LightField& light, const pt::OpenPglSettings& settings, const FitPlan& plan) {
  OpenPglLearner learner(settings);
  return fitTrained(light, learner, plan);
}

}  // namespace bench
