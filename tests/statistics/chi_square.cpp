#include "statistics/chi_square.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "statistics/quadrature.h"
#include "statistics/special_functions.h"

namespace test {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kMinExpected = 5;
constexpr double kIntegralTolerance = 1e-3;

template <class... Args>
std::string text(const char* format, Args... args) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, args...);
  return buffer;
}

/// Equal cells over a rectangle, row by row.
class Grid {
 public:
  Grid(const Rectangle& domain, int resolution) : m_domain(domain), m_nx(2 * resolution), m_ny(resolution) {}

  std::size_t size() const { return std::size_t(m_nx) * m_ny; }
  double width() const { return (m_domain.max.x - m_domain.min.x) / m_nx; }
  double height() const { return (m_domain.max.y - m_domain.min.y) / m_ny; }
  Imath::V2d corner(std::size_t cell) const {
    return {m_domain.min.x + double(cell % m_nx) * width(), m_domain.min.y + double(cell / m_nx) * height()};
  }
  bool contains(const Imath::V2d& p) const {
    return p.x >= m_domain.min.x && p.x <= m_domain.max.x && p.y >= m_domain.min.y && p.y <= m_domain.max.y;
  }
  /// The blocks of about a third of the domain each way that cells are also counted in.
  static constexpr std::size_t kBlocks = 3 * 6;
  std::size_t blockOf(std::size_t cell) const { return (cell / m_nx) * 3 / m_ny * 6 + (cell % m_nx) * 6 / m_nx; }

  std::size_t cellOf(const Imath::V2d& p) const {
    const int x = std::clamp(int((p.x - m_domain.min.x) / width()), 0, m_nx - 1);
    const int y = std::clamp(int((p.y - m_domain.min.y) / height()), 0, m_ny - 1);
    return std::size_t(y) * m_nx + x;
  }

 private:
  Rectangle m_domain;
  int m_nx, m_ny;
};

/// Integral of the density over each cell; counts impossible values of the density.
std::vector<double> integrateCells(const Grid& grid, const std::function<double(const Imath::V2d&)>& pdf,
                                   std::size_t& impossible) {
  const auto density = [&](double x, double y) {
    const double value = pdf({x, y});
    if (value >= 0 && std::isfinite(value)) return value;
    ++impossible;
    return 0.0;
  };
  std::vector<double> integrals(grid.size());
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const Imath::V2d c = grid.corner(cell);
    integrals[cell] = integrate(density, c.x, c.x + grid.width(), c.y, c.y + grid.height(), 1e-8);
  }
  return integrals;
}

struct Histogram {
  std::vector<double> counts;
  std::size_t failed = 0, outside = 0, zeroDensity = 0;
};

Histogram countSamples(const Grid& grid, const PlaneSampler& sample,
                       const std::function<double(const Imath::V2d&)>& pdf, const ChiSquareSettings& settings) {
  Histogram histogram;
  histogram.counts.resize(grid.size());
  Random random(settings.seed);
  for (std::size_t i = 0; i < settings.samples; ++i) {
    const std::optional<Imath::V2d> p = sample(random);
    if (!p)
      ++histogram.failed;
    else if (!grid.contains(*p))
      ++histogram.outside;
    else if (!(pdf(*p) > 0))
      ++histogram.zeroDensity;
    else
      ++histogram.counts[grid.cellOf(*p)];
  }
  return histogram;
}

ChiSquareResult failure(double integral, std::string message) {
  ChiSquareResult result;
  result.integral = integral;
  result.message = std::move(message);
  return result;
}

/// Counts of the blocks; the last entry, that of failed samples, stays itself.
std::vector<double> sumBlocks(const Grid& grid, const std::vector<double>& cells) {
  std::vector<double> blocks(Grid::kBlocks + 1);
  for (std::size_t i = 0; i < grid.size(); ++i) blocks[grid.blockOf(i)] += cells[i];
  blocks.back() = cells.back();
  return blocks;
}

/// Latitude-longitude coordinates (phi, theta) of a unit vector and back.
Imath::V3f directionOf(const Imath::V2d& p) {
  const double sinTheta = std::sin(p.y);
  return Imath::V3f(float(sinTheta * std::cos(p.x)), float(sinTheta * std::sin(p.x)), float(std::cos(p.y)));
}
Imath::V2d anglesOf(const Imath::V3f& w) {
  const double phi = std::atan2(double(w.y), double(w.x));
  return {phi < 0 ? phi + 2 * kPi : phi, std::atan2(std::hypot(double(w.x), double(w.y)), double(w.z))};
}

}  // namespace

ChiSquareResult chiSquareOfCounts(const std::vector<double>& observed, const std::vector<double>& expected,
                                  const ChiSquareSettings& settings) {
  std::vector<std::size_t> order(expected.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });

  ChiSquareResult result;
  result.level = sidakLevel(settings.significance, settings.tests);
  double pooledObserved = 0, pooledExpected = 0;
  std::size_t cells = 0, pooled = 0;
  const auto addCell = [&](double o, double e) {
    result.statistic += (o - e) * (o - e) / e;
    ++cells;
  };
  for (const std::size_t i : order) {
    if (expected[i] < kMinExpected || (pooled > 0 && pooledExpected < kMinExpected)) {
      ++pooled;
      pooledObserved += observed[i];
      pooledExpected += expected[i];
    } else {
      addCell(observed[i], expected[i]);
    }
  }
  if (pooled > 0) addCell(pooledObserved, pooledExpected);
  if (cells < 2) return failure(0, "fewer than two cells expect samples: use more samples or more bins");

  result.degreesOfFreedom = double(cells - 1);
  result.pValue = chiSquareTail(result.statistic, result.degreesOfFreedom);
  result.passed = result.pValue > result.level;
  result.message = text("chi-square %.1f with %.0f degrees of freedom, p-value %.3g, level %.3g", result.statistic,
                        result.degreesOfFreedom, result.pValue, result.level);
  return result;
}

ChiSquareResult chiSquareOnPlane(const PlaneSampler& sample, const std::function<double(const Imath::V2d&)>& pdf,
                                 const Rectangle& domain, const ChiSquareSettings& settings) {
  const Grid grid(domain, settings.resolution);
  std::size_t impossible = 0;
  std::vector<double> expected = integrateCells(grid, pdf, impossible);
  const double integral = std::accumulate(expected.begin(), expected.end(), 0.0);
  if (impossible > 0) return failure(integral, text("the density is negative or not finite at %zu points", impossible));
  if (integral > 1 + kIntegralTolerance) return failure(integral, text("the density integrates to %.6f", integral));

  Histogram histogram = countSamples(grid, sample, pdf, settings);
  if (histogram.outside > 0) return failure(integral, text("%zu samples lie outside the domain", histogram.outside));
  if (histogram.zeroDensity > 0)
    return failure(integral, text("%zu samples lie where the density is zero", histogram.zeroDensity));

  for (double& e : expected) e *= double(settings.samples);
  expected.push_back(double(settings.samples) * std::max(0.0, 1 - integral));
  histogram.counts.push_back(double(histogram.failed));
  // Many small cells see fine structure, a few large ones small smooth errors: two tests, of which either may reject.
  ChiSquareSettings each = settings;
  each.tests = 2 * settings.tests;
  ChiSquareResult result = chiSquareOfCounts(histogram.counts, expected, each);
  const ChiSquareResult coarse = chiSquareOfCounts(sumBlocks(grid, histogram.counts), sumBlocks(grid, expected), each);
  if (coarse.degreesOfFreedom > 0 && coarse.pValue < result.pValue) result = coarse;
  result.integral = integral;
  result.message += text(", the density integrates to %.6f, %zu samples failed", integral, histogram.failed);
  return result;
}

ChiSquareResult chiSquareOnSphere(const DirectionSampler& sample, const std::function<double(const Imath::V3f&)>& pdf,
                                  const ChiSquareSettings& settings) {
  std::size_t notUnit = 0;
  const auto samplePlane = [&](Random& random) -> std::optional<Imath::V2d> {
    const std::optional<Imath::V3f> w = sample(random);
    if (!w) return std::nullopt;
    if (!(std::abs(w->length() - 1) < 1e-4f)) ++notUnit;
    return anglesOf(*w);
  };
  // Not zero at the poles, which a sampler may draw.
  const auto pdfPlane = [&](const Imath::V2d& p) { return pdf(directionOf(p)) * std::max(std::sin(p.y), 1e-12); };
  ChiSquareResult result = chiSquareOnPlane(samplePlane, pdfPlane, {{0, 0}, {2 * kPi, kPi}}, settings);
  if (notUnit > 0) return failure(result.integral, text("%zu sampled directions are not unit vectors", notUnit));
  return result;
}

}  // namespace test
