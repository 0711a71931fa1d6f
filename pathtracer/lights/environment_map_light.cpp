#include "lights/environment_map_light.h"

#include <fmt/format.h>

#include <limits>

#include "core/error.h"
#include "materials/material.h"
#include "scene/transform.h"

namespace pt {
namespace {

/// The axes' directions, if they are at right angles and equally long.
void setAxes(Vec3 (&axes)[3], const Matrix4& toWorld, const SourceLocation& source) {
  const Transform transform(toWorld, source);
  const double length = transform.axis(0).length();
  for (int i = 0; i < 3; ++i) {
    const Imath::V3d axis = transform.axis(i) / length, next = transform.axis((i + 1) % 3) / length;
    if (std::abs(axis.length() - 1) > 1e-3 || std::abs(axis.dot(next)) > 1e-3)
      throw InputError(source +
                       ": the transform of an environment must be a rotation; take shear and uneven scale out");
    axes[i] = Vec3(axis.normalized());
  }
}

std::vector<float> luminancesOf(const Image& image) {
  std::vector<float> luminances;
  luminances.reserve(image.pixels.size());
  for (const Spectrum& radiance : image.pixels) luminances.push_back(luminance(radiance));
  return luminances;
}

template <class T>
T valueOf(guiding::Result<T> result, const SourceLocation& source) {
  if (!result) throw InputError(fmt::format("{}: {}", source, result.error().text));
  return std::move(result).value();
}

// LightReceiver::density: the complete table, the sharpened one, then its bins by normal.
constexpr std::uint32_t kComplete = 0, kSharpened = 1, kFirstBin = 2;

}  // namespace

EnvironmentMapLight::EnvironmentMapLight(const EnvironmentMap& map, double sceneRadius, const SourceLocation& source)
    : m_source(source),
      m_image(map.image),
      m_scale(map.scale),
      m_complete(valueOf(guiding::EnvironmentTable::create(
                             {{map.mapping, map.image->width, map.image->height}, luminancesOf(*map.image)}),
                         source)) {
  if (!(m_scale >= 0) || !std::isfinite(m_scale))
    throw InputError(source + ": the scale of an environment must be finite and not negative");
  setAxes(m_axes, map.toWorld, source);
  // Through the scene's disc from every direction.
  m_power = 4 * double(kPi) * double(kPi) * sceneRadius * sceneRadius * m_complete.sharpening().mean * m_scale;
}

bool EnvironmentMapLight::sharpen(const EnvironmentSampling& sampling, float lightShare) {
  using guiding::EnvironmentByNormal, guiding::EnvironmentCompensation, guiding::EnvironmentTable;
  if (sampling.form == EnvironmentForm::Plain) return true;
  const std::vector<float> luminances = luminancesOf(*m_image);
  const guiding::EnvironmentImage image{m_complete.layout(), luminances};
  if (sampling.form == EnvironmentForm::Normal) {
    m_byNormal = valueOf(EnvironmentByNormal::create(image, m_complete, lightShare), m_source);
    return !m_byNormal->empty();
  }
  const auto compensation = sampling.form == EnvironmentForm::Mean ? EnvironmentCompensation::SubtractMean
                                                                   : EnvironmentCompensation::WaterFilling;
  m_sharpened = valueOf(EnvironmentTable::create(image, {compensation, lightShare}), m_source);
  return !m_sharpened->empty();
}

std::uint32_t EnvironmentMapLight::densityFor(const SurfaceInteraction& si) const noexcept {
  if (!m_sharpened && !m_byNormal) return kComplete;
  if (!m_byNormal || si.material->traits().transmits) return kSharpened;
  const Vec3 normal = si.frame.n.dot(si.wo) < 0 ? -si.frame.n : si.frame.n;
  return kFirstBin + m_byNormal->bin(toMap(normal));
}

LightSample EnvironmentMapLight::sample(std::uint32_t density, const Vec2& u) const noexcept {
  const Vec3 inMap = density == kComplete    ? m_complete.draw(u)
                     : density == kSharpened ? sharpened().draw(u)
                                             : m_byNormal->draw(density - kFirstBin, u);
  const Vec3 wi = toWorld(inMap);
  const guiding::EnvironmentPoint point = m_complete.layout().locate(toMap(wi));  // of the very direction returned
  return {wi, std::numeric_limits<float>::infinity(), lookUp(point), pdfAt(density, point)};
}

Spectrum EnvironmentMapLight::radianceFrom(const Vec3& wi) const noexcept {
  return lookUp(m_complete.layout().locate(toMap(wi)));
}

float EnvironmentMapLight::pdfFrom(std::uint32_t density, const Vec3& wi) const noexcept {
  return pdfAt(density, m_complete.layout().locate(toMap(wi)));
}

Spectrum EnvironmentMapLight::lookUp(const guiding::EnvironmentPoint& point) const noexcept {
  const guiding::EnvironmentFootprint footprint = m_complete.layout().footprint(point.uv);
  Spectrum sum(0.0f);
  for (std::size_t i = 0; i < 4; ++i) sum += m_image->pixels[footprint.texels[i]] * footprint.weights[i];
  return sum * m_scale;
}

float EnvironmentMapLight::pdfAt(std::uint32_t density, const guiding::EnvironmentPoint& point) const noexcept {
  if (density == kComplete) return m_complete.pdf(point);
  return density == kSharpened ? sharpened().pdf(point) : m_byNormal->pdf(density - kFirstBin, point);
}

std::size_t EnvironmentMapLight::memoryBytes() const noexcept {
  return m_image->pixels.size() * sizeof(Spectrum) + m_complete.memoryBytes() +
         (m_sharpened ? m_sharpened->memoryBytes() : 0) + (m_byNormal ? m_byNormal->memoryBytes() : 0);
}

}  // namespace pt
