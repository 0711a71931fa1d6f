#include "field_bytes.h"
#include "random_settings.h"
#include "sphere_map.h"
#include "statistics/chi_square.h"

using namespace guiding;
using namespace test;

namespace {

constexpr int kCases = 120;
constexpr int kGrid = 64;  ///< cells per axis of the square in which draws are counted

void requireSound(const Field& field) {
  const Status status = field.validate();
  if (!status) FAIL(status.error().text);
}

/// Mean density over a cell of the square that may hold smaller ones: exact down to `depth` more halvings, where all
/// cells of a tree so shallow end.
double integrateCell(const GuidingDistribution& guide, DirectionMap map, int x, int y, int depth) {
  const int n = 1 << depth;
  double sum = 0;
  for (int i = 0; i < n * n; ++i) {
    const Imath::V2f uv((float(x) + (float(i % n) + 0.5f) / float(n)) / kGrid,
                        (float(y) + (float(i / n) + 0.5f) / float(n)) / kGrid);
    sum += guide.pdf(squareToSphere(map, uv));
  }
  return sum / (double(n) * n) * 4 * double(kPi) / (double(kGrid) * kGrid);
}

/// The integral of the density, and whether draws follow it.
void checkDensity(const GuidingDistribution& guide, const FieldSettings& settings, Random& random) {
  const int depth = std::max(0, std::min(settings.maxDTreeDepth, 9) - 6);
  std::vector<double> expected, observed(kGrid * kGrid, 0);
  double integral = 0;
  constexpr int kDraws = 20'000;
  for (int y = 0; y < kGrid; ++y)
    for (int x = 0; x < kGrid; ++x) {
      expected.push_back(kDraws * integrateCell(guide, settings.directionMap, x, y, depth));
      integral += expected.back() / kDraws;
    }
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
  if (settings.maxDTreeDepth > 9) return;  // finer than the quadrature
  CHECK(integral == Approx(1).epsilon(1e-4));
  int cells = 0;
  for (const double e : expected) cells += e >= 5;
  if (cells < 2) return;
  const ChiSquareResult result = chiSquareOfCounts(observed, expected, {.significance = 0.01, .tests = 3 * kCases});
  CAPTURE(result.message);
  CHECK(result);
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
    for (int i = 0; i < 3; ++i) {
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
