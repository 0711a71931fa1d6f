#include "grid_geometry.h"

#include <bit>
#include <cmath>

#include "sphere_map.h"

namespace guiding {

namespace {

/// exp(x) for x <= 0, relative error below 1e-4.
inline void expOfNegative(Float8& x) noexcept {
  atLeast(x, Float8{} - 80.0f);
  const Float8 y = x * 1.44269504f;
  const Int8 whole = __builtin_convertvector(y - 0.5f, Int8);
  const Float8 t = y - __builtin_convertvector(whole, Float8);  // in [-1/2, 1/2]
  const Float8 p = 1 + t * (0.69314718f + t * (0.24022651f + t * (0.05550411f + t * 0.00961813f)));
  x = p * std::bit_cast<Float8>((whole + 127) << 23);
}

/// Sums over the directions of one cell.
struct CellMoments {
  Imath::V3d mean{0, 0, 0};
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
};

CellMoments momentsOf(DirectionMap map, int x, int y) {
  constexpr int kPoints = 16;  // per axis
  constexpr double kShare = 1.0 / (kPoints * kPoints);
  CellMoments m;
  for (int i = 0; i < kPoints * kPoints; ++i) {
    const Imath::V2f uv((float(x) + (float(i % kPoints) + 0.5f) / kPoints) / Grid::kSize,
                        (float(y) + (float(i / kPoints) + 0.5f) / kPoints) / Grid::kSize);
    const Imath::V3d w(squareToSphere(map, uv));
    m.mean += w * kShare;
    m.xx += w.x * w.x * kShare, m.yy += w.y * w.y * kShare, m.zz += w.z * w.z * kShare;
    m.xy += w.x * w.y * kShare, m.xz += w.x * w.z * kShare, m.yz += w.y * w.z * kShare;
  }
  return m;
}

}  // namespace

GridGeometry::GridGeometry(DirectionMap map) {
  for (int x = 0; x < Grid::kSize; ++x) {
    for (int y = 0; y < Grid::kSize; ++y) {
      const CellMoments m = momentsOf(map, x, y);
      const double length = m.mean.length();
      m_x[x][y] = float(m.mean.x), m_y[x][y] = float(m.mean.y), m_z[x][y] = float(m.mean.z);
      m_xx[x][y] = float(3 * (m.xx - m.mean.x * m.mean.x));
      m_yy[x][y] = float(3 * (m.yy - m.mean.y * m.mean.y));
      m_zz[x][y] = float(3 * (m.zz - m.mean.z * m.mean.z));
      m_xy[x][y] = float(6 * (m.xy - m.mean.x * m.mean.y));
      m_xz[x][y] = float(6 * (m.xz - m.mean.x * m.mean.z));
      m_yz[x][y] = float(6 * (m.yz - m.mean.y * m.mean.z));
      m_spread[x][y] = float(std::sqrt(1 - length * length));
      m_inverseLength[x][y] = float(1 / length);
      m_inverseSharpness[x][y] = float(1 - length);  // a spherical Gaussian's mean direction has length 1 - 1/sharpness
    }
  }
}

void GridGeometry::lobeShares(const Lobe& lobe, GridRows& shares) const noexcept {
  if (lobe.shape == Lobe::Shape::Cosine)
    cosineShares(lobe.axis, shares);
  else
    gaussianShares(lobe.axis, lobe.sharpness, shares);
}

void GridGeometry::cosineShares(const Imath::V3f& n, GridRows& shares) const noexcept {
  // The mean of n.w over a cell above the horizon is n times its mean direction. Across the horizon, n.w is taken as
  // uniformly distributed over [c - h, c + h], with its true mean and variance, and clipped. Its sum over the cells is
  // 64/(4 pi) * pi = 16.
  const float xx = n.x * n.x, yy = n.y * n.y, zz = n.z * n.z, xy = n.x * n.y, xz = n.x * n.z, yz = n.y * n.z;
  for (int x = 0; x < Grid::kSize; ++x) {
    const Float8 c = m_x[x] * n.x + m_y[x] * n.y + m_z[x] * n.z;
    Float8 h2 = m_xx[x] * xx + m_yy[x] * yy + m_zz[x] * zz + m_xy[x] * xy + m_xz[x] * xz + m_yz[x] * yz;
    atLeast(h2, Float8{} + 1e-4f);
    const Float8 h = (m_spread[x] + h2 / m_spread[x]) * 0.5f;  // one step of Heron's root, close enough
    Float8 above = c + h, beyond = c - h;
    atLeast(above, Float8{});
    atMost(above, h + h);
    atLeast(beyond, Float8{});
    shares[x] = (above * above / (h * 4) + beyond) * (1.0f / 16);
  }
}

void GridGeometry::gaussianShares(const Imath::V3f& axis, float sharpness, GridRows& shares) const noexcept {
  // The mean over a cell is about the value at its centre of the Gaussian convolved with one as wide as the cell.
  Float8 sum{};
  for (int x = 0; x < Grid::kSize; ++x) {
    const Float8 c = (m_x[x] * axis.x + m_y[x] * axis.y + m_z[x] * axis.z) * m_inverseLength[x];
    Float8 exponent = sharpness / (1 + sharpness * m_inverseSharpness[x]) * (c - 1);
    atMost(exponent, Float8{});
    expOfNegative(exponent);
    shares[x] = exponent;
    sum += exponent;
  }
  const float normalise = 1 / sumOfLanes(sum);
  for (Float8& row : shares) row *= normalise;
}

}  // namespace guiding
