#include <algorithm>
#include <numeric>

#include "field_bytes.h"
#include "random_settings.h"
#include "sphere_map.h"
#include "statistics/chi_square.h"

using namespace guiding;
using namespace test;

namespace {

constexpr int kCases = 240;
constexpr int kGrid = 64;  ///< cells per axis of the square in which draws are counted
constexpr int kDraws = 10'000;

void requireSound(const Field& field) {
  const Status status = field.validate();
  if (!status) FAIL(status.error().text);
}

/// Integrals of a density over cells of the square by adaptive quadrature: a cell is halved both ways until it is a
/// 512th wide, and from there on as long as the density is not the same at five points of it and at every point that
/// some draws of the guide have marked in it.
class MarkedQuadrature {
 public:
  MarkedQuadrature(const GuidingDistribution& guide, const FieldSettings& settings, Random& random)
      : m_guide(guide), m_map(settings.directionMap), m_smallest(std::ldexp(1.0, -settings.maxDTreeDepth)) {
    for (int i = 0; i < kDraws; ++i) m_marks.push_back(sphereToSquare(m_map, guide.sample(random.next2D()).wi));
  }

  /// Of the cell with this lower corner.
  double integrate(double x, double y, double size) { return integrate(x, y, size, std::span(m_marks)); }

  /// Sorts the marks by cells of the grid and gives those of each.
  double integrateGridCell(int column, int row) {
    if (m_ofCell.empty()) sortMarks();
    const std::size_t cell = std::size_t(row * kGrid + column);
    return integrate(double(column) / kGrid, double(row) / kGrid, 1.0 / kGrid,
                     std::span(m_marks).subspan(m_ofCell[cell], m_ofCell[cell + 1] - m_ofCell[cell]));
  }

 private:
  static std::size_t gridCellOf(const Imath::V2f& uv) {
    const auto index = [](float x) { return std::min(int(x * kGrid), kGrid - 1); };
    return std::size_t(index(uv.y) * kGrid + index(uv.x));
  }

  void sortMarks() {
    std::sort(m_marks.begin(), m_marks.end(),
              [](const Imath::V2f& a, const Imath::V2f& b) { return gridCellOf(a) < gridCellOf(b); });
    m_ofCell.assign(kGrid * kGrid + 1, 0);
    for (const Imath::V2f& mark : m_marks) ++m_ofCell[gridCellOf(mark) + 1];
    std::partial_sum(m_ofCell.begin(), m_ofCell.end(), m_ofCell.begin());
  }

  double pdf(double x, double y) const { return m_guide.pdf(squareToSphere(m_map, Imath::V2f(float(x), float(y)))); }

  double integrate(double x, double y, double size, std::span<Imath::V2f> marks) const {
    const double half = size / 2, value = pdf(x + half, y + half), mean = 4 * double(kPi) * size * size * value;
    if (size <= m_smallest || isConstant(x, y, size, value, marks)) return mean;
    const auto splitY = std::partition(marks.begin(), marks.end(), [&](const auto& m) { return m.y < y + half; });
    double sum = 0;
    for (const bool upper : {false, true}) {
      const std::span<Imath::V2f> row = upper ? std::span(splitY, marks.end()) : std::span(marks.begin(), splitY);
      const auto splitX = std::partition(row.begin(), row.end(), [&](const auto& m) { return m.x < x + half; });
      const double cellY = y + (upper ? half : 0);
      sum += integrate(x, cellY, half, std::span(row.begin(), splitX));
      sum += integrate(x + half, cellY, half, std::span(splitX, row.end()));
    }
    return sum;
  }

  bool isConstant(double x, double y, double size, double value, std::span<const Imath::V2f> marks) const {
    if (size > 0x1p-9) return false;
    for (int i = 0; i < 4; ++i)
      if (pdf(x + size * (i & 1 ? 0.75 : 0.25), y + size * (i & 2 ? 0.75 : 0.25)) != value) return false;
    return std::all_of(marks.begin(), marks.end(), [&](const Imath::V2f& m) { return pdf(m.x, m.y) == value; });
  }

  const GuidingDistribution& m_guide;
  DirectionMap m_map;
  double m_smallest;
  std::vector<Imath::V2f> m_marks;
  std::vector<std::size_t> m_ofCell;
};

/// Below cells of depth 9 what was never drawn may be overlooked; and few floats fit into a cell of depth 20, so that
/// the quadrature's points fall beside it at times, as computed directions do.
double quadratureError(const FieldSettings& settings) {
  return settings.maxDTreeDepth <= 9 ? 1e-4 : settings.maxDTreeDepth <= 12 ? 2e-3 : 0.03;
}

/// The integral of the density, and whether draws follow it.
void checkDensity(const GuidingDistribution& guide, const FieldSettings& settings, Random& random) {
  MarkedQuadrature quadrature(guide, settings, random);
  std::vector<double> expected, observed(kGrid * kGrid, 0);
  double integral = 0;
  for (int row = 0; row < kGrid; ++row)
    for (int column = 0; column < kGrid; ++column) {
      expected.push_back(kDraws * quadrature.integrateGridCell(column, row));
      integral += expected.back() / kDraws;
    }
  CHECK(std::abs(integral - 1) < quadratureError(settings));

  int differ = 0, empty = 0;
  for (int i = 0; i < kDraws; ++i) {
    const DirectionSample s = guide.sample(random.next2D());
    differ += s.pdf != guide.pdf(s.wi);
    empty += !(s.pdf > 0);
    const Imath::V2f uv = sphereToSquare(settings.directionMap, s.wi);
    ++observed[std::size_t(std::min(int(uv.y * kGrid), kGrid - 1) * kGrid + std::min(int(uv.x * kGrid), kGrid - 1))];
  }
  CHECK(differ == 0);
  CHECK(empty == 0);
  if (settings.maxDTreeDepth > 12) return;  // no expectation that is good enough
  int cells = 0;
  for (const double e : expected) cells += e >= 5;
  if (cells < 2) return;
  const ChiSquareResult result = chiSquareOfCounts(observed, expected, {.significance = 0.01, .tests = 2 * kCases});
  CAPTURE(result.message);
  CHECK(result);
}

/// What a pass recorded, a buffer a tile; each tile has a seed of its own, so the order in which they are done is free.
std::vector<SampleBuffer> recordTiles(const Field& field, const Radiance& light, std::uint64_t pass, int samples,
                                      const std::vector<std::size_t>& order) {
  std::vector<SampleBuffer> tiles(order.size());
  for (const std::size_t tile : order) {
    Random random(1'000'000 * pass + tile);
    tiles[tile] = record(field, light, samples, random);
  }
  return tiles;
}

std::vector<std::size_t> shuffled(std::size_t count, RandomCases& cases) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = count - 1; i > 0; --i) std::swap(order[i], order[std::size_t(cases.below(int(i) + 1))]);
  return order;
}

}  // namespace

TEST_CASE("Whatever the settings and the light, a field stays sound and samples what it says") {
  for (int c = 0; c < kCases; ++c) {
    RandomCases cases(std::uint64_t(1000 + c));
    FieldSettings settings = cases.settings();
    if (c % 2 == 0) settings.maxDTreeDepth = std::min(settings.maxDTreeDepth, 9);
    const Radiance light = cases.light();
    CAPTURE(c);
    REQUIRE(settings.validate().ok());
    Field field = makeField(settings);
    const int iterations = 1 + cases.below(3);
    for (int k = 0; k < iterations; ++k) {
      for (int batch = 0; batch < 2; ++batch) {
        REQUIRE(field.accumulate(record(field, light, 1'000 << cases.below(4), cases.random())));
        requireSound(field);
      }
      REQUIRE(field.endIteration(0.1 + 20 * cases.uniform()));
      requireSound(field);
    }
    for (int i = 0; i < 2; ++i) {
      const Imath::V3f p = uniformPosition(cases.random()) * 1.2f - Imath::V3f(0.1f);
      const GuidingDistribution guide = field.bind(p, cases.lobes());
      CHECK((guide.bsdfSamplingFraction() > 0 && guide.bsdfSamplingFraction() <= 1));
      if (guide) checkDensity(guide, settings, cases.random());
    }
    const Bytes bytes = bytesOf(field);
    const TemporaryFile file("random.field");
    writeBytes(file.path(), bytes);
    const Result<Field> loaded = load(file.path());
    REQUIRE(loaded.ok());
    CHECK(bytesOf(loaded.value()) == bytes);
  }
}

TEST_CASE("Whatever the settings, batches and the order in which tiles are done change not a bit") {
  constexpr std::size_t kTiles = 7;
  for (int c = 0; c < kCases; ++c) {
    RandomCases cases(std::uint64_t(5000 + c));
    const FieldSettings settings = cases.settings();
    const Radiance light = cases.light();
    CAPTURE(c);
    Field whole = makeField(settings), parts = makeField(settings);
    for (std::uint64_t pass = 0; pass < 2; ++pass) {
      const int samples = 200 << cases.below(3);
      const double spp = 0.1 + 20 * cases.uniform();
      REQUIRE(whole.accumulate(recordTiles(whole, light, pass, samples, shuffled(kTiles, cases))));
      const std::vector<SampleBuffer> tiles = recordTiles(parts, light, pass, samples, shuffled(kTiles, cases));
      const std::size_t cut = std::size_t(cases.below(int(kTiles) + 1));
      REQUIRE(parts.accumulate(std::span(tiles).first(cut)));
      REQUIRE(parts.accumulate(std::span(tiles).subspan(cut)));
      REQUIRE(whole.endIteration(spp));
      REQUIRE(parts.endIteration(spp));
    }
    CHECK(bytesOf(whole) == bytesOf(parts));
  }
}

TEST_CASE("Counts notice draws of which 3% would have to fall elsewhere") {
  FieldSettings settings = FieldSettings::mueller2017();
  settings.maxDTreeDepth = 9;
  RandomCases cases(1);
  const Field field = train(settings, cases.light(), 3, 20'000);
  const GuidingDistribution guide = field.bind(Imath::V3f(0.5f));
  MarkedQuadrature quadrature(guide, settings, cases.random());
  CHECK(std::abs(quadrature.integrate(0, 0, 1) - 1) < 1e-4);
  std::vector<double> expected, observed(kGrid * kGrid, 0);
  for (int row = 0; row < kGrid; ++row)
    for (int column = 0; column < kGrid; ++column)
      expected.push_back(kDraws * (0.97 * quadrature.integrateGridCell(column, row) + 0.03 / (kGrid * kGrid)));
  for (int i = 0; i < kDraws; ++i) {
    const Imath::V2f uv = sphereToSquare(DirectionMap::Cylinder, guide.sample(cases.random().next2D()).wi);
    ++observed[std::size_t(std::min(int(uv.y * kGrid), kGrid - 1) * kGrid + std::min(int(uv.x * kGrid), kGrid - 1))];
  }
  CHECK(!chiSquareOfCounts(observed, expected, {.significance = 0.01, .tests = 2 * kCases}));
}
