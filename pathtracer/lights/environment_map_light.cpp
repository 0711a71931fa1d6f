#include "lights/environment_map_light.h"

#include <fmt/format.h>

#include <limits>

#include "core/error.h"
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

guiding::EnvironmentTable makeTable(const EnvironmentMap& map, const SourceLocation& source) {
  std::vector<float> luminances;
  luminances.reserve(map.image->pixels.size());
  for (const Spectrum& radiance : map.image->pixels) luminances.push_back(luminance(radiance));
  const guiding::EnvironmentLayout layout(map.mapping, map.image->width, map.image->height);
  auto table = guiding::EnvironmentTable::create({layout, luminances});
  if (!table) throw InputError(fmt::format("{}: {}", source, table.error().text));
  return std::move(table).value();
}

}  // namespace

EnvironmentMapLight::EnvironmentMapLight(const EnvironmentMap& map, double sceneRadius, const SourceLocation& source)
    : m_image(map.image), m_scale(map.scale), m_table(makeTable(map, source)) {
  if (!(m_scale >= 0) || !std::isfinite(m_scale))
    throw InputError(source + ": the scale of an environment must be finite and not negative");
  setAxes(m_axes, map.toWorld, source);
  // Through the scene's disc from every direction.
  m_power = 4 * double(kPi) * double(kPi) * sceneRadius * sceneRadius * m_table.sharpening().mean * m_scale;
}

LightSample EnvironmentMapLight::sampleDirect(const Vec3&, double, const Vec2& u) const noexcept {
  const guiding::DirectionSample sample = m_table.sample(u);
  const Vec3 wi = toWorld(sample.wi);
  return {wi, std::numeric_limits<float>::infinity(), radianceFrom(wi), pdfFrom(wi)};
}

Spectrum EnvironmentMapLight::radianceFrom(const Vec3& wi) const noexcept {
  const guiding::EnvironmentLayout& layout = m_table.layout();
  const guiding::EnvironmentFootprint footprint = layout.footprint(layout.toPicture(toMap(wi)));
  Spectrum sum(0.0f);
  for (std::size_t i = 0; i < 4; ++i) sum += m_image->pixels[footprint.texels[i]] * footprint.weights[i];
  return sum * m_scale;
}

float EnvironmentMapLight::pdfFrom(const Vec3& wi) const noexcept {
  return m_table.pdf(toMap(wi));
}

}  // namespace pt
