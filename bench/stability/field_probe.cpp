#include "stability/field_probe.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace bench {

namespace {

constexpr int kPlaces = 20;

std::string faultAt(const guiding::GuidingDistribution& guide, Random& random) {
  const float alpha = guide.bsdfSamplingFraction();
  if (!(alpha > 0 && alpha <= 1)) return fmt::format("a fraction of {}", alpha);
  if (!guide) return {};
  for (int i = 0; i < 1000; ++i) {
    const guiding::DirectionSample s = guide.sample(random.next2D());
    if (!(s.pdf > 0) || !std::isfinite(s.pdf)) return fmt::format("a draw of density {}", s.pdf);
    if (s.pdf != guide.pdf(s.wi))
      return fmt::format("a draw of density {} that pdf() calls {}", s.pdf, guide.pdf(s.wi));
    if (!(std::abs(s.wi.length() - 1) < 1e-5f)) return fmt::format("a direction of length {}", s.wi.length());
  }
  return {};
}

}  // namespace

guiding::Field makeUnitField(const guiding::FieldSettings& settings) {
  auto field = guiding::Field::create(Imath::Box3f({0, 0, 0}, {1, 1, 1}), settings);
  if (!field) throw std::invalid_argument(field.error().text);
  return std::move(field).value();
}

std::string faultOf(const guiding::Field& field, Random& random) {
  if (const guiding::Status status = field.validate(); !status) return status.error().text;
  for (int i = 0; i < kPlaces; ++i)
    if (std::string fault = faultAt(field.bind(random.next3D()), random); !fault.empty()) return fault;
  return {};
}

double meanRadiance(const LightField& light, const Imath::V3f& place) {
  return light.fluence(place) * double(kUniformSpherePdf);
}

std::vector<double> estimateFluence(const guiding::Field& field, const LightField& light, const Imath::V3f& place,
                                    int means, int draws, Random& random) {
  const guiding::GuidingDistribution guide = field.bind(place);
  const double alpha = guide ? guide.bsdfSamplingFraction() : 1;
  std::vector<double> result(std::size_t(means), 0);
  for (double& mean : result)
    for (int i = 0; i < draws; ++i) {
      const Imath::V3f wi = random.next1D() < alpha ? random.nextDirection() : guide.sample(random.next2D()).wi;
      const double mixture = alpha * double(kUniformSpherePdf) + (1 - alpha) * (guide ? guide.pdf(wi) : 0);
      mean += light.radiance(place, wi) * double(kUniformSpherePdf) / mixture / draws;
    }
  return result;
}

double shareTowardsLight(const guiding::Field& field, const LightField& light, Random& random) {
  constexpr int kDraws = 500;
  int inside = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const Imath::V3f place = random.next3D();
    const guiding::GuidingDistribution guide = field.bind(place);
    if (!guide) continue;
    for (int k = 0; k < kDraws; ++k)
      inside += light.radiance(place, guide.sample(random.next2D()).wi) > meanRadiance(light, place);
  }
  return double(inside) / (kPlaces * kDraws);
}

ProbeResult probeOf(const guiding::Field& field, Random& random) {
  ProbeResult result;
  result.fault = faultOf(field, random);
  const guiding::FieldStats stats = field.stats();
  result.dropped = stats.droppedSamples;
  result.memoryBytes = stats.memoryBytes;
  return result;
}

void learnIteration(guiding::Field& field, const guiding::SampleBuffer& buffer, double spp) {
  if (const auto status = field.accumulate(buffer); !status) throw std::runtime_error(status.error().text);
  if (const auto status = field.endIteration(spp); !status) throw std::runtime_error(status.error().text);
}

}  // namespace bench
