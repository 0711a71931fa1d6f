#include "fit/fit.h"

#include <guiding/field.h>

#include <new>
#include <stdexcept>

#include "fit/fit_trained.h"

namespace bench {

namespace {

class FieldLearner {
 public:
  explicit FieldLearner(const guiding::FieldSettings& settings) : m_field(create(settings)) {}

  void learnRound(const guiding::SampleBuffer& buffer) {
    // 2 samples per pixel make the rule c sqrt(2 n / 4) a constant: leaves of sTreeThreshold samples.
    if (!m_field.accumulate(buffer) || !m_field.endIteration(2)) throw std::bad_alloc();
  }
  guiding::GuidingDistribution bind(const Imath::V3f& position, const guiding::LobeSet& lobes, Random&) {
    return m_field.bind(position, lobes);
  }
  guiding::GuidingDistribution bind(const Imath::V3f& position, Random&) { return m_field.bind(position); }
  std::size_t leaves() const { return m_field.stats().spatialLeaves; }
  std::size_t bytes() const { return m_field.stats().memoryBytes; }

 private:
  static guiding::Field create(const guiding::FieldSettings& settings) {
    auto field = guiding::Field::create(Imath::Box3f({0, 0, 0}, {1, 1, 1}), settings);
    if (!field) throw std::invalid_argument(field.error().text);
    return std::move(field).value();
  }

  guiding::Field m_field;
};

}  // namespace

FitQuality fit(const LightField& light, const guiding::FieldSettings& settings, const FitPlan& plan) {
  FieldLearner learner(settings);
  return fitTrained(light, learner, plan);
}

}  // namespace bench
