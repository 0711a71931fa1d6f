#include "guiding/environment.h"

#include <algorithm>
#include <cmath>

#include "environment_grid.h"
#include "library_edge.h"
#include "sphere_map.h"

namespace guiding {

namespace {

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
double mix(double a, double b, double t) noexcept {
  return (1 - t) * a + t * b;
}

/// The last of the patches [first, end) that begins at or before x; never an empty one. upTo(i): mass before patch i.
template <class UpTo>
int findPatch(int first, int end, double x, UpTo&& upTo) noexcept {
  int count = end - first;
  while (count > 1) {
    const int half = count / 2;
    const bool upper = upTo(first + half) <= x;
    first += upper ? half : 0;
    count = upper ? count - half : half;
  }
  return first;
}

/// Where the integral of the line from (0, a) to (1, b) reaches `share` of its whole.
template <class Real>
float invertLine(Real a, Real b, Real share) noexcept {
  const Real area = share * (a + b);  // twice the area
  const Real t = area / (a + std::sqrt(std::max(Real(0), a * a + (b - a) * area)));
  return t < 1 ? float(t) : 1.0f;  // 1 for 0/0 too
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
      m_conditional[i] = sum;
    }
  }
  m_marginal.resize(rowCount);
  for (int y = 0; y < rows.patches(); ++y)
    m_marginal[std::size_t(y) + 1] = m_marginal[std::size_t(y)] + rowMass(y, 0, columns.patches());
}

EnvironmentTable::Patches EnvironmentTable::allPatches() const noexcept {
  return {0, columnsOf(m_layout).patches(), 0, rowsOf(m_layout).patches()};
}

double EnvironmentTable::rowMass(int y, int x0, int x1) const noexcept {
  const double* upper = &m_conditional[std::size_t(y) * m_columns];
  const double* lower = upper + m_columns;
  return ((upper[x1] - upper[x0]) + (lower[x1] - lower[x0])) / 2 * rowsOf(m_layout).width(y);
}

Imath::V3f EnvironmentTable::draw(const Imath::V2f& u) const noexcept {
  if (empty()) return {0, 0, 1};
  return draw(allPatches(), m_marginal.data(), u);
}

Imath::V3f EnvironmentTable::draw(const Patches& among, const double* marginal, const Imath::V2f& u) const noexcept {
  constexpr double kBelowOne = 1 - 0x1p-53;
  // The row of patches, and how far down in it
  const double restY = mix(marginal[among.y0], marginal[among.y1], std::min(double(u.y), kBelowOne));
  const int y = findPatch(among.y0, among.y1, restY, [&](int i) { return marginal[i]; });
  const double* upper = &m_conditional[std::size_t(y) * m_columns];
  const double* lower = upper + m_columns;
  const float alongY = invertLine(upper[among.x1] - upper[among.x0], lower[among.x1] - lower[among.x0],
                                  (restY - marginal[y]) / (marginal[y + 1] - marginal[y]));

  // The patch, and how far across in it
  const auto upTo = [&](int i) { return mix(upper[i], lower[i], double(alongY)); };
  const double restX = mix(upTo(among.x0), upTo(among.x1), std::min(double(u.x), kBelowOne));
  const int x = findPatch(among.x0, among.x1, restX, upTo);
  const float* above = &m_density[std::size_t(y) * m_columns + std::size_t(x)];
  const float* below = above + m_columns;
  const float alongX = invertLine(mix(above[0], below[0], alongY), mix(above[1], below[1], alongY),
                                  float((restX - upTo(x)) / (upTo(x + 1) - upTo(x))));
  return m_layout.toDirection({columnsOf(m_layout).position({x, alongX}), rowsOf(m_layout).position({y, alongY})});
}

float EnvironmentTable::pdf(const EnvironmentPoint& point) const noexcept {
  if (empty()) return 0;
  const EnvironmentAxis::Point x = columnsOf(m_layout).locate(point.uv.x), y = rowsOf(m_layout).locate(point.uv.y);
  const float* above = &m_density[std::size_t(y.patch) * m_columns + std::size_t(x.patch)];
  const float* below = above + m_columns;
  return mix(mix(above[0], above[1], x.along), mix(below[0], below[1], x.along), y.along) * point.areaPerSolidAngle;
}

std::size_t EnvironmentTable::memoryBytes() const noexcept {
  return m_density.capacity() * sizeof(float) + (m_conditional.capacity() + m_marginal.capacity()) * sizeof(double);
}

}  // namespace guiding
