#pragma once

#include <ImathVec.h>

#include <array>
#include <cstdint>

namespace guiding {

/// How a picture is laid over the sphere of directions. Picture coordinates lie in [0,1]^2, the origin at the upper
/// left.
enum class EnvironmentMapping {
  LatLong,         ///< u = atan2(x, -z)/(2 pi), v = acos(y)/pi; rows are bands of equal angle
  LatLongToPoles,  ///< the same, but the first and the last row lie on the poles themselves (as Mitsuba 3 has it)
  Octahedral,      ///< equal-area octahedron about z [Clarberg 2008], as in pbrt-v4
};

/// The texels that bilinear interpolation mixes, and their shares.
struct EnvironmentFootprint {
  std::array<std::uint32_t, 4> texels;  ///< row by row from the top
  std::array<float, 4> weights;         ///< add up to 1
};

/// Where a direction is seen in a picture.
struct EnvironmentPoint {
  Imath::V2f uv;
  float areaPerSolidAngle;  ///< of the picture; 0 on the poles of a latitude-longitude map
};

/// A picture of the sphere: which texels are seen in which direction. Bilinear interpolation goes on across the
/// picture's edges to what is next to them on the sphere; next to the poles of LatLong it stops at the outermost row.
class EnvironmentLayout {
 public:
  /// Sides of at least 1 texel (LatLongToPoles: 2 rows); the product of the sides fits into 32 bits.
  EnvironmentLayout(EnvironmentMapping mapping, int width, int height) noexcept
      : m_mapping(mapping), m_width(width), m_height(height) {}

  EnvironmentMapping mapping() const noexcept { return m_mapping; }
  int width() const noexcept { return m_width; }
  int height() const noexcept { return m_height; }
  std::size_t texels() const noexcept { return std::size_t(m_width) * std::size_t(m_height); }

  /// Picture coordinates of a unit direction, to about 2e-7.
  Imath::V2f toPicture(const Imath::V3f& direction) const noexcept;
  EnvironmentPoint locate(const Imath::V3f& direction) const noexcept;
  /// Inverse of toPicture().
  Imath::V3f toDirection(const Imath::V2f& uv) const noexcept;

  EnvironmentFootprint footprint(const Imath::V2f& uv) const noexcept;

  /// Solid angle of a texel of this row, as a share of the sphere. The texels' shares add up to 1.
  double texelShare(int row) const noexcept;

 private:
  EnvironmentMapping m_mapping;
  int m_width, m_height;
};

}  // namespace guiding
