#include "openpgl/openpgl_field.h"

#include <openpgl/cpp/OpenPGL.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.h"

namespace pt {

namespace {

/// Stands for infinity, which Open PGL refuses, as a multiple of the scene's diagonal: too far for any parallax.
constexpr float kFarAway = 1e5f;

pgl_vec3f toPgl(const Imath::V3f& v) {
  return {v.x, v.y, v.z};
}

PGL_DIRECTIONAL_DISTRIBUTION_TYPE toPgl(OpenPglModel model) {
  switch (model) {
    case OpenPglModel::ParallaxVmm:
      return PGL_DIRECTIONAL_DISTRIBUTION_PARALLAX_AWARE_VMM;
    case OpenPglModel::Vmm:
      return PGL_DIRECTIONAL_DISTRIBUTION_VMM;
    case OpenPglModel::Quadtree:
      return PGL_DIRECTIONAL_DISTRIBUTION_QUADTREE;
  }
  return PGL_DIRECTIONAL_DISTRIBUTION_PARALLAX_AWARE_VMM;
}

class Distribution final : public OpenPglDistribution {
 public:
  Distribution(const openpgl::cpp::Field& field, bool cosineProduct)
      : m_field(field),
        m_distribution(&field),
        m_cosineProduct(cosineProduct && m_distribution.SupportsApplyCosineProduct()) {}

  bool bind(const Imath::V3f& position, const guiding::LobeSet& lobes, float u) noexcept override {
    if (!m_distribution.Init(&m_field, toPgl(position), u)) return false;
    if (!m_cosineProduct) return true;
    for (const guiding::Lobe& lobe : lobes.lobes())
      if (lobe.shape == guiding::Lobe::Shape::Cosine) {
        m_distribution.ApplyCosineProduct(toPgl(lobe.axis));
        break;
      }
    return true;
  }

  guiding::DirectionSample sample(const Imath::V2f& u) const noexcept override {
    pgl_vec3f wi;
    const float pdf = m_distribution.SamplePDF({u.x, u.y}, wi);
    return {{wi.x, wi.y, wi.z}, pdf};
  }

  float pdf(const Imath::V3f& wi) const noexcept override { return m_distribution.PDF(toPgl(wi)); }

 private:
  const openpgl::cpp::Field& m_field;
  openpgl::cpp::SurfaceSamplingDistribution m_distribution;
  bool m_cosineProduct;
};

bool isSound(const guiding::RadianceSample& s) {
  const float sum = s.position.x + s.position.y + s.position.z + s.direction.x + s.direction.y + s.direction.z;
  return std::isfinite(sum) && std::isfinite(s.radiance / s.pdf) && s.radiance >= 0 && s.pdf > 0;
}

std::vector<std::string> splitCsv(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const std::size_t begin = cell.find_first_not_of(' ');
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, cell.find_last_not_of(' ') - begin + 1));
  }
  return cells;
}

/// The value in the column of that name; 0 if there is none. Text is all that Open PGL hands out.
double statistic(const openpgl::cpp::FieldStatistics& statistics, const std::string& column) {
  const std::vector<std::string> names = splitCsv(statistics.HeaderCSVString());
  const std::vector<std::string> values = splitCsv(statistics.ToCSVString());
  for (std::size_t i = 0; i < names.size() && i < values.size(); ++i)
    if (names[i] == column) return std::stod(values[i]);
  return 0;
}

struct Config : openpgl::cpp::FieldConfig {
  explicit Config(const OpenPglSettings& settings) {
    Init(PGL_SPATIAL_STRUCTURE_KDTREE, toPgl(settings.model), settings.deterministic,
         std::size_t(settings.maxSamplesPerLeaf));
  }
};

class Field final : public OpenPglField {
 public:
  Field(const Imath::Box3f& bounds, const OpenPglSettings& settings)
      : m_settings(settings),
        m_farAway(kFarAway * bounds.size().length()),
        m_device(PGL_DEVICE_TYPE_CPU_8),
        m_field(&m_device, Config(settings)) {
    m_field.SetSceneBounds({toPgl(bounds.min), toPgl(bounds.max)});
  }

  void learn(std::span<const guiding::SampleBuffer> buffers) override {
    for (const guiding::SampleBuffer& buffer : buffers) {
      take(buffer);
      if (m_samples.GetSizeSurface() >= std::size_t(m_settings.samplesPerUpdate)) update();
    }
  }

  void update() override {
    if (m_samples.GetSizeSurface() > 0) m_field.Update(m_samples);
    m_samples.Clear();
  }

  bool isTrained() const noexcept override { return m_field.GetIteration() > 0; }

  std::unique_ptr<OpenPglDistribution> newDistribution() const override {
    return std::make_unique<Distribution>(m_field, m_settings.cosineProduct);
  }

  OpenPglStats stats() const override {
    const openpgl::cpp::FieldStatistics statistics = m_field.GetSurfaceStatistics();
    return {std::size_t(statistic(statistics, "numCacheRegions")),
            std::size_t(statistic(statistics, "sizeAllCacheRegionsUsed(Mbs)") * 1024 * 1024), m_dropped};
  }

 private:
  void take(const guiding::SampleBuffer& buffer) {
    m_radiant.clear();
    m_black.clear();
    for (const guiding::RadianceSample& sample : buffer.samples()) {
      if (!isSound(sample))
        ++m_dropped;
      else if (sample.radiance > 0)
        m_radiant.push_back({.position = toPgl(sample.position),
                             .direction = toPgl(sample.direction),
                             .weight = sample.radiance / sample.pdf,
                             .pdf = sample.pdf,
                             .distance = std::min(sample.distance, m_farAway),
                             .flags = 0});
      else
        m_black.push_back({toPgl(sample.position), toPgl(sample.direction), false});
    }
    m_samples.AddSamples(m_radiant.data(), m_radiant.size());
    m_samples.AddZeroValueSamples(m_black.data(), m_black.size());
  }

  OpenPglSettings m_settings;
  float m_farAway;
  openpgl::cpp::Device m_device;
  openpgl::cpp::Field m_field;
  openpgl::cpp::SampleStorage m_samples;
  std::vector<openpgl::cpp::SampleData> m_radiant;  ///< of the buffer at hand
  std::vector<openpgl::cpp::ZeroValueSampleData> m_black;
  std::size_t m_dropped = 0;
};

}  // namespace

bool hasOpenPgl() noexcept {
  return true;
}

std::unique_ptr<OpenPglField> createOpenPglField(const Imath::Box3f& bounds, const OpenPglSettings& settings) {
  if (const auto status = settings.validate(); !status) throw InputError(status.error().text);
  return std::make_unique<Field>(bounds, settings);
}

}  // namespace pt
