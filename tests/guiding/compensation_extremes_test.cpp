#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "catch.h"
#include "exact_compensation.h"
#include "guiding/mis.h"

using namespace guiding;

namespace {

constexpr auto kWater = CompensationForm::WaterFilling;
constexpr double kInf = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();
const auto kAllForms = {CompensationForm::None, kWater, CompensationForm::ClipRenormalise};

std::vector<double> solved(const std::vector<double>& t, const std::vector<double>& b, double alpha,
                           CompensationForm form = kWater) {
  std::vector<double> q(t.size(), -1);
  compensate(t, b, alpha, form, q);
  return q;
}

double uniform(std::mt19937_64& engine) {
  return double(engine() >> 11) * 0x1p-53;
}

}  // namespace

TEST_CASE("Only ratios of the target matter, over the whole range of double") {
  const std::vector<double> t{5, 1, 0, 3, 0.25, 7}, b{0.1, 0.3, 0.2, 0.2, 0.1, 0.1};
  for (const auto form : kAllForms) {
    const std::vector<double> expected = solved(t, b, 0.6, form);
    for (int exponent = -1050; exponent <= 1020; exponent += 10) {
      std::vector<double> scaled = t;
      for (double& x : scaled) x = std::ldexp(x, exponent);
      CAPTURE(exponent);
      CHECK(solved(scaled, b, 0.6, form) == expected);  // powers of two change no bit
    }
    for (const double factor : {1e-300, 3e-77, 1e77, 1e300}) {
      std::vector<double> scaled = t;
      for (double& x : scaled) x *= factor;
      const std::vector<double> q = solved(scaled, b, 0.6, form);
      for (std::size_t j = 0; j < t.size(); ++j) CHECK(q[j] == Approx(expected[j]).epsilon(1e-13).margin(1e-15));
    }
  }
}

TEST_CASE("Subnormal and huge targets in float") {
  const std::vector<float> b{0.25f, 0.25f, 0.25f, 0.25f};
  for (const float scale : {0x1p-149f, 0x1p-126f, 1.0f, 0x1p124f}) {
    const std::vector<float> t{1 * scale, 2 * scale, 8 * scale, 5 * scale};
    std::vector<float> q(4);
    REQUIRE(!compensate(t, b, 0.5f, kWater, q).empty);
    const std::vector<double> expected = solved({1, 2, 8, 5}, {0.25, 0.25, 0.25, 0.25}, 0.5);
    for (std::size_t j = 0; j < 4; ++j) CHECK(q[j] == Approx(expected[j]).epsilon(1e-6).margin(1e-7));
  }
}

TEST_CASE("Targets that span the range of double") {
  const std::vector<double> t{1e300, 1, 1e-300, 5e-324}, b{0.25, 0.25, 0.25, 0.25};
  const std::vector<double> q = solved(t, b, 0.5);
  CHECK(q == std::vector<double>{1, 0, 0, 0});
  const std::vector<double> plain = solved(t, b, 0.5, CompensationForm::None);
  CHECK(plain[0] == 1);
  CHECK(plain[1] == Approx(1e-300));
}

TEST_CASE("Cells that lie on the water level itself: the solver ends") {
  std::mt19937_64 engine(5);
  double worst = 0;
  for (int trial = 0; trial < 200'000; ++trial) {
    const std::size_t cells = 2 + engine() % 20, above = 1 + engine() % (cells - 1);
    const double alpha = uniform(engine);
    std::vector<double> t(cells), b(cells);
    double sumB = 0, sumT = 0, sumActiveB = 0;
    for (double& x : b) sumB += x = 0.1 + uniform(engine);
    for (double& x : b) x /= sumB;
    for (std::size_t j = 0; j < above; ++j) {
      sumT += t[j] = b[j] * (2 + 8 * uniform(engine));
      sumActiveB += b[j];
    }
    const double level = sumT / ((1 - alpha) + alpha * sumActiveB) * alpha;
    for (std::size_t j = above; j < cells; ++j) t[j] = level * b[j] * (1 + double(int(engine() % 7) - 3) * 0x1p-53);
    std::vector<double> q(cells);
    const CompensationResult result = compensate(t, b, alpha, kWater, q);
    worst = std::max(worst, std::abs(double(result.lambda / test::exactWaterFilling(t, b, alpha).lambda) - 1));
  }
  CHECK(worst < 1e-14);
}

TEST_CASE("Ties") {
  const std::vector<double> q = solved({1, 1, 1, 1, 1}, {0.2, 0.2, 0.2, 0.2, 0.2}, 0.5);
  for (const double x : q) CHECK(x == Approx(0.2).epsilon(1e-14));
  const std::vector<double> pairs = solved({3, 3, 1, 1}, {0.25, 0.25, 0.25, 0.25}, 0.9);
  CHECK(pairs == std::vector<double>{0.5, 0.5, 0, 0});
}

TEST_CASE("A million cells of very different size: mass sums to one, as the exact solution has it") {
  std::mt19937_64 engine(6);
  const std::size_t cells = 1 << 20;
  std::vector<double> t(cells), b(cells, 1.0 / double(cells)), q(cells);
  for (double& x : t) x = std::exp(40 * (uniform(engine) - 0.5));
  for (const double alpha : {0.1, 0.5, 0.999}) {
    const CompensationResult result = compensate(t, b, alpha, kWater, q);
    CHECK(double(test::exactWaterFilling(t, b, alpha).lambda) == Approx(result.lambda).epsilon(1e-14));
    long double total = 0;
    for (const double x : q) total += x;
    CHECK(double(total) == Approx(1).epsilon(1e-14));
  }
}

TEST_CASE("Many rounds: targets that drop one cell at a time") {
  // Each cell is just below the level that the cells before it make.
  std::vector<double> t{1}, b{0.0};
  const double alpha = 0.5;
  double sumT = 1, sumB = 0;
  const std::size_t cells = 400;
  for (std::size_t j = 1; j < cells; ++j) {
    b.push_back(1.0 / cells);
    sumB += b.back();
    t.push_back(sumT / ((1 - alpha) + alpha * sumB) * alpha * b.back() * 0.999);
    sumT += t.back();
  }
  std::vector<double> q(cells);
  const CompensationResult result = compensate(t, b, alpha, kWater, q);
  CHECK(result.lambda == Approx(double(test::exactWaterFilling(t, b, alpha).lambda)).epsilon(1e-13));
}

TEST_CASE("A share next to one") {
  const std::vector<double> t{1, 2, 3, 4}, b{0.25, 0.25, 0.25, 0.25};
  for (const double alpha : {1 - 1e-6, 1 - 1e-12, std::nextafter(1.0, 0.0)}) {
    std::vector<double> q(4);
    const CompensationResult result = compensate(t, b, alpha, kWater, q);
    REQUIRE(!result.empty);
    CHECK(q[3] == Approx(1));
    CHECK(result.lambda <= (1 + 1e-12) / (1 - alpha));
  }
}

TEST_CASE("What cannot be solved is empty: no target, bad masses, bad shares") {
  const std::vector<double> t{1, 2, 3}, b{0.3, 0.3, 0.4};
  const auto isEmpty = [](const std::vector<double>& target, const std::vector<double>& other, double alpha) {
    bool all = true;
    for (const auto form : kAllForms) {
      std::vector<double> q(target.size(), -1);
      const CompensationResult result = compensate(target, other, alpha, form, q);
      all &= result.empty && result.lambda == 0 && q == std::vector<double>(target.size(), 0);
    }
    return all;
  };
  CHECK(!isEmpty(t, b, 0.5));
  CHECK(isEmpty({0, 0, 0}, b, 0.5));
  CHECK(isEmpty({}, {}, 0.5));
  for (const double bad : {kNaN, kInf, -kInf, -1.0}) {
    CHECK(isEmpty({1, bad, 3}, b, 0.5));
    CHECK(isEmpty(t, {0.3, bad, 0.4}, 0.5));
  }
  for (const double alpha : {1.0, 1.5, -0.1, kNaN, kInf}) CHECK(isEmpty(t, b, alpha));
}

TEST_CASE("Nothing is left where the published form clips everything") {
  std::vector<double> q(2);
  // t/T <= alpha b in every cell needs b to sum to more than the target: refused by the caller's contract, safe anyway.
  CHECK(compensate(std::vector<double>{1, 1}, std::vector<double>{1, 1}, 0.75, CompensationForm::ClipRenormalise, q)
            .empty);
  CHECK(q == std::vector<double>{0, 0});
}

TEST_CASE("The result may overwrite the target") {
  for (const auto form : kAllForms) {
    const std::vector<double> b{0.1, 0.2, 0.3, 0.4};
    std::vector<double> t{4, 3, 2, 1};
    const std::vector<double> expected = solved(t, b, 0.5, form);
    compensate(t, b, 0.5, form, t);
    CHECK(t == expected);
  }
}

TEST_CASE("The MIS heuristics") {
  CHECK(balanceHeuristic(1, 1, 1, 3) == Approx(0.25));
  CHECK(balanceHeuristic(2, 1, 1, 2) == Approx(0.5));
  CHECK(powerHeuristic(1, 1, 1, 3) == Approx(0.1));
  for (const auto heuristic : {balanceHeuristic, powerHeuristic}) {
    CHECK(heuristic(1, 0, 1, 1) == 0);
    CHECK(heuristic(1, 1, 1, 0) == 1);
    CHECK(heuristic(1, 0, 1, 0) == 0);
    for (const float large : {1e10f, 1e20f, 3e38f}) {
      CHECK(heuristic(1, large, 1, large) == Approx(0.5));
      CHECK(heuristic(1, 1, 1, large) + heuristic(1, large, 1, 1) == Approx(1));
      CHECK(heuristic(1, 1 / large, 1, 1 / large) == Approx(0.5));
    }
  }
}
