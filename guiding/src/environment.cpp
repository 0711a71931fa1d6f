#include "guiding/environment.h"

#include <algorithm>
#include <cmath>

#include "environment_grid.h"
#include "library_edge.h"
#include "sphere_map.h"

namespace guiding {

namespace {

EnvironmentAxis columnsOf(const EnvironmentLayout& layout) noexcept {
  return {layout.width(), false};
}
EnvironmentAxis rowsOf(const EnvironmentLayout& layout) noexcept {
  return {layout.height(), layout.mapping() == EnvironmentMapping::LatLongToPoles};
}

/// sin(theta) of a row of vertices; 1 where the map preserves area. Texels on the poles themselves must not be lost.
double stretch(const EnvironmentLayout& layout, const EnvironmentAxis& rows, int row) {
  if (layout.mapping() == EnvironmentMapping::Octahedral) return 1;
  const bool isPole = row == 0 || row == rows.vertices() - 1;
  if (rows.toEnds) return std::sin(double(kPiF) * (isPole ? 0.25 : double(row)) / (rows.texels - 1));
  return isPole ? 0 : std::sin(double(kPiF) * (row - 0.5) / rows.texels);
}

float mix(float a, float b, float t) noexcept {
  return (1 - t) * a + t * b;
}

/// The last patch that begins at or before x; never an empty one. upTo(i): mass of the patches before i.
template <class UpTo>
int findPatch(int patches, float x, UpTo&& upTo) noexcept {
  int lower = 0, count = patches;  // the answer lies in [lower, lower + count)
  while (count > 1) {
    const int half = count / 2;
    const bool upper = upTo(lower + half) <= x;
    lower += upper ? half : 0;
    count = upper ? count - half : half;
  }
  return lower;
}

/// Where the integral of the line from (0, a) to (1, b) reaches `share` of its whole.
float invertLine(float a, float b, float share) noexcept {
  const float area = share * (a + b);  // twice the area
  const float slopeRoot = std::sqrt(std::max(0.0f, a * a + (b - a) * area));
  const float t = area / (a + slopeRoot);
  return t < 1 ? t : 1.0f;  // 1 for 0/0 too
}

float belowWhole(float u, float whole) noexcept {
  return std::min(u * whole, std::nextafter(whole, 0.0f));
}

}  // namespace

Result<EnvironmentTable> EnvironmentTable::create(const EnvironmentImage& image, const EnvironmentSettings& settings) {
  return withoutThrowing([&]() -> Result<EnvironmentTable> {
    std::vector<float> sharpened(image.luminance.size());
    const auto sharpening = sharpenEnvironment(image, settings, sharpened);
    if (!sharpening) return sharpening.error();
    EnvironmentTable table(image.layout, sharpening.value());
    if (!sharpening.value().empty) table.build(sharpened);
    return table;
  });
}

void EnvironmentTable::build(std::span<const float> luminance) {
  const EnvironmentAxis columns = columnsOf(m_layout), rows = rowsOf(m_layout);
  m_columns = std::size_t(columns.vertices());
  const auto rowCount = std::size_t(rows.vertices());
  const double largest = *std::max_element(luminance.begin(), luminance.end());  // sums must not overflow

  std::vector<double> values(m_columns * rowCount), integrals(rowCount);
  for (int y = 0; y < rows.vertices(); ++y) {
    const auto [y0, y1] = rows.texelsAt(y);
    const double factor = stretch(m_layout, rows, y) / largest;
    double* row = &values[std::size_t(y) * m_columns];
    for (int x = 0; x < columns.vertices(); ++x) {
      const auto [x0, x1] = columns.texelsAt(x);
      const double sum =
          double(luminance[wrappedTexel(m_layout, x0, y0)]) + double(luminance[wrappedTexel(m_layout, x1, y0)]) +
          double(luminance[wrappedTexel(m_layout, x0, y1)]) + double(luminance[wrappedTexel(m_layout, x1, y1)]);
      row[x] = sum / 4 * factor;
      if (x > 0) integrals[std::size_t(y)] += (row[x - 1] + row[x]) / 2 * columns.width(x - 1);
    }
  }
  double total = 0;
  for (int y = 0; y < rows.patches(); ++y)
    total += (integrals[std::size_t(y)] + integrals[std::size_t(y) + 1]) / 2 * rows.width(y);

  m_density.resize(values.size());
  m_conditional.resize(values.size());
  for (std::size_t y = 0; y < rowCount; ++y) {
    double sum = 0;
    for (std::size_t x = 0; x < m_columns; ++x) {
      const std::size_t i = y * m_columns + x;
      if (x > 0) sum += (values[i - 1] + values[i]) / 2 * columns.width(int(x) - 1) / total;
      m_density[i] = float(values[i] / total);
      m_conditional[i] = float(sum);
    }
  }
  m_marginal.resize(rowCount);
  double upTo = 0;
  for (int y = 0; y < rows.patches(); ++y) {
    upTo += (integrals[std::size_t(y)] + integrals[std::size_t(y) + 1]) / 2 * rows.width(y) / total;
    m_marginal[std::size_t(y) + 1] = float(upTo);
  }
}

DirectionSample EnvironmentTable::sample(const Imath::V2f& u) const noexcept {
  if (empty()) return {{0, 0, 1}, 0};
  const EnvironmentAxis columns = columnsOf(m_layout), rows = rowsOf(m_layout);

  // The row of patches, and how far down in it
  const float restY = belowWhole(u.y, m_marginal.back());
  const int y = findPatch(rows.patches(), restY, [&](int i) { return m_marginal[std::size_t(i)]; });
  const float* upper = &m_conditional[std::size_t(y) * m_columns];
  const float* lower = upper + m_columns;
  const float shareY =
      (restY - m_marginal[std::size_t(y)]) / (m_marginal[std::size_t(y) + 1] - m_marginal[std::size_t(y)]);
  const float alongY = invertLine(upper[m_columns - 1], lower[m_columns - 1], shareY);

  // The patch, and how far across in it
  const auto upTo = [&](int i) { return mix(upper[i], lower[i], alongY); };
  const float restX = belowWhole(u.x, upTo(columns.patches()));
  const int x = findPatch(columns.patches(), restX, upTo);
  const float* above = &m_density[std::size_t(y) * m_columns + std::size_t(x)];
  const float* below = above + m_columns;
  const float shareX = (restX - upTo(x)) / (upTo(x + 1) - upTo(x));
  const float alongX = invertLine(mix(above[0], below[0], alongY), mix(above[1], below[1], alongY), shareX);

  const Imath::V3f wi = m_layout.toDirection({columns.position({x, alongX}), rows.position({y, alongY})});
  return {wi, pdf(wi)};
}

float EnvironmentTable::pdf(const Imath::V3f& direction) const noexcept {
  if (empty()) return 0;
  const Imath::V2f uv = m_layout.toPicture(direction);
  const EnvironmentAxis::Point x = columnsOf(m_layout).locate(uv.x), y = rowsOf(m_layout).locate(uv.y);
  const float* above = &m_density[std::size_t(y.patch) * m_columns + std::size_t(x.patch)];
  const float* below = above + m_columns;
  const float density = mix(mix(above[0], above[1], x.along), mix(below[0], below[1], x.along), y.along);
  if (m_layout.mapping() == EnvironmentMapping::Octahedral) return density * (1 / (4 * kPiF));
  const float sinTheta = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  return sinTheta > 0 ? density / (2 * kPiF * kPiF * sinTheta) : 0.0f;
}

std::size_t EnvironmentTable::memoryBytes() const noexcept {
  return (m_density.capacity() + m_conditional.capacity() + m_marginal.capacity()) * sizeof(float);
}

}  // namespace guiding
