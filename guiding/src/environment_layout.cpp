#include "guiding/environment_layout.h"

#include <cmath>
#include <utility>

#include "environment_grid.h"
#include "sphere_map.h"

namespace guiding {

namespace {

constexpr double kPiD = 3.14159265358979323846;

Imath::V2f toLatLong(const Imath::V3f& w) noexcept {
  // Quarter turns from -z towards +x.
  const float half = mirroredIf(w.z > 0, 2, quarterAngle(std::abs(w.x), std::abs(w.z)));
  const float turn = mirroredIf(w.x < 0, 4, half) * 0.25f;
  const float sinTheta = std::sqrt(w.x * w.x + w.z * w.z);
  return {turn, mirroredIf(w.y < 0, 2, quarterAngle(sinTheta, std::abs(w.y))) * 0.5f};
}

Imath::V3f fromLatLong(const Imath::V2f& uv) noexcept {
  const SinCos azimuth = quarterSinCos(4 * uv.x), theta = quarterSinCos(2 * uv.y);
  return {theta.sin * azimuth.sin, theta.cos, -theta.sin * azimuth.cos};
}

}  // namespace

Imath::V2f EnvironmentLayout::toPicture(const Imath::V3f& direction) const noexcept {
  return m_mapping == EnvironmentMapping::Octahedral ? detail::sphereToOctahedron(direction) : toLatLong(direction);
}

EnvironmentPoint EnvironmentLayout::locate(const Imath::V3f& direction) const noexcept {
  if (m_mapping == EnvironmentMapping::Octahedral) return {toPicture(direction), 1 / (4 * kPiF)};
  const float sinTheta = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  return {toPicture(direction), sinTheta > 0 ? 1 / (2 * kPiF * kPiF * sinTheta) : 0.0f};
}

Imath::V3f EnvironmentLayout::toDirection(const Imath::V2f& uv) const noexcept {
  return m_mapping == EnvironmentMapping::Octahedral ? detail::octahedronToSphere(uv) : fromLatLong(uv);
}

EnvironmentFootprint EnvironmentLayout::footprint(const Imath::V2f& uv) const noexcept {
  const auto split = [](float g, int least, int most) {
    const int lower = std::clamp(int(std::floor(g)), least, most);
    return std::pair(lower, std::clamp(g - float(lower), 0.0f, 1.0f));
  };
  const bool toPoles = m_mapping == EnvironmentMapping::LatLongToPoles;
  const auto [x, fx] = split(uv.x * float(m_width) - 0.5f, -1, m_width - 1);
  const auto [y, fy] = toPoles ? split(uv.y * float(m_height - 1), 0, m_height - 1)
                               : split(uv.y * float(m_height) - 0.5f, -1, m_height - 1);
  EnvironmentFootprint result;
  for (int i = 0; i < 4; ++i) {
    result.texels[std::size_t(i)] = wrappedTexel(*this, x + (i & 1), y + (i >> 1));
  }
  result.weights = {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
  return result;
}

double EnvironmentLayout::texelShare(int row) const noexcept {
  if (m_mapping == EnvironmentMapping::Octahedral) return 1.0 / double(texels());
  const bool toPoles = m_mapping == EnvironmentMapping::LatLongToPoles;
  const double rows = toPoles ? m_height - 1 : m_height, offset = toPoles ? -0.5 : 0;
  const double top = std::max(0.0, row + offset), bottom = std::min(rows, row + offset + 1);
  return (std::cos(kPiD * top / rows) - std::cos(kPiD * bottom / rows)) / (2 * m_width);
}

}  // namespace guiding
