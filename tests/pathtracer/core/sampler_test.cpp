#include "core/sampler.h"

#include <set>
#include <vector>

#include "catch.h"
#include "statistics/chi_square.h"
#include "statistics/z_test.h"

using namespace pt;
using namespace test;

namespace {

constexpr SamplerKind kKinds[] = {SamplerKind::Independent, SamplerKind::Sobol};

std::vector<float> firstNumbers(Sampler& sampler, int x, int y, std::uint32_t index) {
  sampler.startPath(x, y, index);
  std::vector<float> numbers;
  for (int i = 0; i < 20; ++i) {
    numbers.push_back(sampler.next1D());
    const Vec2 u = sampler.next2D();
    numbers.insert(numbers.end(), {u.x, u.y});
  }
  return numbers;
}

/// Points `first` to `first + count` of a pixel in the dimension reached after `skip` calls of next2D.
std::vector<Vec2> pointsOf(Sampler& sampler, int x, std::uint32_t first, std::uint32_t count, int skip) {
  std::vector<Vec2> points;
  for (std::uint32_t i = first; i < first + count; ++i) {
    sampler.startPath(x, 0, i);
    for (int s = 0; s < skip; ++s) sampler.next2D();
    points.push_back(sampler.next2D());
  }
  return points;
}

/// Whether every elementary interval of area 1 / 2^k holds exactly one of 2^k points: a (0, k, 2)-net in base 2.
bool isNet(const std::vector<Vec2>& points, int k) {
  for (int a = 0; a <= k; ++a) {
    const int nx = 1 << a, ny = 1 << (k - a);
    std::set<int> occupied;
    for (const Vec2& p : points) occupied.insert(int(p.x * float(nx)) * ny + int(p.y * float(ny)));
    if (occupied.size() != points.size()) return false;
  }
  return true;
}

/// Points of a pixel: the way they choose, and where they fall on it.
std::vector<Sampler::Choice> choicesOf(SamplerKind kind, int x, std::uint32_t count) {
  Sampler sampler(kind, 4);
  std::vector<Sampler::Choice> choices;
  for (std::uint32_t i = 0; i < count; ++i) {
    sampler.startPath(x, 0, i);
    choices.push_back(sampler.nextChoice());
  }
  return choices;
}

/// Squared errors of the mean of `f` over 256 samples in many pixels.
template <class F>
double meanSquaredError(SamplerKind kind, const F& f, double truth) {
  double sum = 0;
  constexpr int kPixels = 200, kSamples = 256;
  Sampler sampler(kind, 9);
  for (int x = 0; x < kPixels; ++x) {
    double mean = 0;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      sampler.startPath(x, 3, i);
      sampler.next1D();
      mean += f(sampler.next2D()) / kSamples;
    }
    sum += (mean - truth) * (mean - truth) / kPixels;
  }
  return sum;
}

}  // namespace

TEST_CASE("PCG32 yields the published sequence") {
  Pcg32 generator(42, 54);  // the demonstration program of the reference implementation
  for (const std::uint32_t expected : {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu})
    CHECK(generator.next() == expected);
}

TEST_CASE("The unscrambled points are Sobol's") {
  const float expectedX[] = {0, 0.5f, 0.25f, 0.75f, 0.125f, 0.625f, 0.375f, 0.875f};
  const float expectedY[] = {0, 0.5f, 0.75f, 0.25f, 0.625f, 0.125f, 0.375f, 0.875f};
  const float expectedZ[] = {0, 0.5f, 0.75f, 0.25f, 0.375f, 0.875f, 0.625f, 0.125f};
  for (std::uint32_t i = 0; i < 8; ++i) {
    CHECK(toUnitFloat(reverseBits(i)) == expectedX[i]);
    CHECK(toUnitFloat(reverseBits(sobolSecondReversed(i))) == expectedY[i]);
    CHECK(toUnitFloat(reverseBits(sobolThirdReversed(i))) == expectedZ[i]);
  }
}

TEST_CASE("Samplers depend on seed, pixel and index alone") {
  for (const SamplerKind kind : kKinds) {
    Sampler a(kind, 5), b(kind, 5), otherSeed(kind, 6);
    firstNumbers(b, 100, 7, 3);  // what came before does not matter
    const std::vector<float> numbers = firstNumbers(a, 17, 4, 11);
    CHECK(numbers == firstNumbers(b, 17, 4, 11));
    CHECK(numbers != firstNumbers(otherSeed, 17, 4, 11));
    CHECK(numbers != firstNumbers(a, 4, 17, 11));
    CHECK(numbers != firstNumbers(a, 17, 5, 11));
    CHECK(numbers != firstNumbers(a, 17, 4, 12));
    for (const float n : numbers) CHECK((n >= 0 && n < 1));
  }
}

TEST_CASE("Scrambled points of every pixel and dimension are nets") {
  Sampler sampler(SamplerKind::Sobol, 1);
  for (const int pixel : {0, 1, 77}) {
    for (const int dimension : {0, 1, 30}) {
      for (const int k : {2, 5, 8}) {
        CHECK(isNet(pointsOf(sampler, pixel, 0, 1u << k, dimension), k));
        CHECK(isNet(pointsOf(sampler, pixel, 5u << k, 1u << k, dimension), k));  // a later pass of as many samples
      }
    }
  }
  Sampler independent(SamplerKind::Independent, 1);
  CHECK(!isNet(pointsOf(independent, 0, 0, 32, 0), 5));
}

TEST_CASE("Single dimensions are stratified") {
  Sampler sampler(SamplerKind::Sobol, 2);
  std::set<int> occupied;
  for (std::uint32_t i = 0; i < 64; ++i) {
    sampler.startPath(3, 3, i);
    sampler.next2D();
    occupied.insert(int(sampler.next1D() * 64));
  }
  CHECK(occupied.size() == 64);
}

TEST_CASE("Choices are stratified together with the points on each way") {
  for (const int pixel : {0, 5, 123}) {
    std::vector<Vec2> points, chosen;
    std::set<int> ways;
    for (const auto& [way, point] : choicesOf(SamplerKind::Sobol, pixel, 256)) {
      points.push_back(point);
      ways.insert(int(way * 256));
      if (way < 0.5f) chosen.push_back(point);
    }
    CHECK(isNet(points, 8));
    CHECK(ways.size() == 256);
    // Half of the points, in one of the two ways: each of 64 squares has two of 128.
    std::vector<int> count(64);
    for (const Vec2& p : chosen) ++count[int(p.x * 8) * 8 + int(p.y * 8)];
    CHECK(std::set<int>(count.begin(), count.end()) == std::set<int>{2});
  }
  std::vector<int> count(64);
  for (const auto& [way, point] : choicesOf(SamplerKind::Independent, 0, 256))
    count[int(point.x * 8) * 8 + int(point.y * 8)] += way < 0.5f;
  CHECK(std::set<int>(count.begin(), count.end()).size() > 2);
}

TEST_CASE("Each number is uniform and dimensions are independent") {
  const auto uniform = [](const Imath::V2d&) { return 1.0; };
  for (const SamplerKind kind : kKinds) {
    const ChiSquareSettings settings{.samples = 200'000, .tests = 10};
    const auto test = [&](const auto& draw) {
      Sampler sampler(kind, 3);
      std::uint32_t count = 0;
      const PlaneSampler points = [&](Random&) {
        sampler.startPath(int(count / 16) % 500, int(count / 16) / 500, count % 16);
        ++count;
        const Vec2 p = draw(sampler);
        return std::optional(Imath::V2d(p.x, p.y));
      };
      return chiSquareOnPlane(points, uniform, {}, settings);
    };
    const ChiSquareResult pair = test([](Sampler& s) { return s.next2D(); });
    const ChiSquareResult singles = test([](Sampler& s) {
      const float x = s.next1D();
      return Vec2(x, s.next1D());
    });
    const ChiSquareResult across = test([](Sampler& s) {
      const float x = s.next2D().x;
      return Vec2(x, s.next2D().y);
    });
    const ChiSquareResult choice = test([](Sampler& s) {
      const auto [way, point] = s.nextChoice();
      return Vec2(way, point.x);
    });
    const ChiSquareResult otherChoice = test([](Sampler& s) {
      const auto [way, point] = s.nextChoice();
      return Vec2(point.y, way);
    });
    INFO(pair.message << '\n'
                      << singles.message << '\n'
                      << across.message << '\n'
                      << choice.message << '\n'
                      << otherChoice.message);
    CHECK(choice);
    CHECK(otherChoice);
    CHECK(pair);
    CHECK(singles);
    CHECK(across);
    // A dimension used twice is noticed.
    CHECK(!test([](Sampler& s) {
      const float x = s.next1D();
      return Vec2(x, std::fmod(x + 0.25f * s.next1D(), 1.0f));
    }));
  }
}

TEST_CASE("Neighbouring pixels and seeds are not correlated") {
  for (const SamplerKind kind : kKinds) {
    Sampler sampler(kind, 0), next(kind, 1);
    RunningMean pixels, seeds, itself;
    for (int x = 0; x < 20'000; ++x) {
      sampler.startPath(x, 0, 0);
      const float a = sampler.next1D() - 0.5f;
      sampler.startPath(x + 1, 0, 0);
      pixels.add(a * (sampler.next1D() - 0.5f));
      next.startPath(x, 0, 0);
      seeds.add(a * (next.next1D() - 0.5f));
      itself.add(a * (a + 5 * (next.next1D() - 0.5f)));
    }
    CHECK(zTest(pixels, 0, 1e-3));
    CHECK(zTest(seeds, 0, 1e-3));
    CHECK(!zTest(itself, 0, 1e-3));  // a correlation of a fifth is noticed
  }
}

TEST_CASE("Sobol points integrate smooth functions far better than independent ones") {
  const auto smooth = [](const Vec2& u) { return double(u.x) * u.y + std::sin(3 * u.x); };
  const double truth = 0.25 + (1 - std::cos(3.0)) / 3;
  const double independent = meanSquaredError(SamplerKind::Independent, smooth, truth);
  CHECK(meanSquaredError(SamplerKind::Sobol, smooth, truth) < independent / 100);
}
