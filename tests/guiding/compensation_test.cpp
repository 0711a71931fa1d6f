#include <cmath>
#include <random>
#include <vector>

#include "catch.h"
#include "exact_compensation.h"
#include "guiding/mis.h"

using namespace guiding;

namespace {

struct Problem {
  std::vector<double> t, b;
  double alpha = 0;
};

/// Masses over up to 1000 cells, from flat to spiky, with empty cells of either kind.
class RandomProblems {
 public:
  explicit RandomProblems(std::uint64_t seed) : m_engine(seed) {}

  Problem next() {
    Problem p;
    const std::size_t cells = 1 + std::size_t(std::pow(1000.0, uniform()));
    const double spread = 20 * uniform(), emptyT = uniform() * 0.5, emptyB = uniform() < 0.5 ? 0 : 0.5 * uniform();
    for (std::size_t j = 0; j < cells; ++j) {
      p.t.push_back(uniform() < emptyT ? 0 : std::exp(spread * (uniform() - 0.5)));
      p.b.push_back(uniform() < emptyB ? 0 : 0.1 + uniform());
    }
    p.t[std::size_t(uniform() * double(cells))] = 1;
    double sum = 0;
    for (const double x : p.b) sum += x;
    const double share = uniform() < 0.7 ? 1 : uniform();  // part of b may lie outside all cells
    for (double& x : p.b) x *= sum > 0 ? share / sum : 0;
    p.alpha = uniform() < 0.1 ? 0 : uniform();
    return p;
  }
  double uniform() { return double(m_engine() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 m_engine;
};

struct Solution {
  std::vector<double> q;
  CompensationResult result;
};

Solution solve(const Problem& p, CompensationForm form = CompensationForm::WaterFilling) {
  Solution s{std::vector<double>(p.t.size(), -1), {}};
  s.result = compensate(p.t, p.b, p.alpha, form, s.q);
  return s;
}

double sum(const std::vector<double>& x) {
  long double total = 0;
  for (const double v : x) total += v;
  return double(total);
}

}  // namespace

TEST_CASE("Water-filling finds the exact solution") {
  RandomProblems problems(1);
  double worstLambda = 0, worstMass = 0, worstSum = 0;
  bool inBounds = true;
  for (int i = 0; i < 5000; ++i) {
    const Problem p = problems.next();
    const Solution s = solve(p);
    const test::ExactCompensation exact = test::exactWaterFilling(p.t, p.b, p.alpha);
    if (s.result.empty) FAIL("empty in trial " << i);
    worstLambda = std::max(worstLambda, std::abs(double(s.result.lambda / exact.lambda) - 1));
    // Masses are differences of the order of 1/(1 - alpha).
    for (std::size_t j = 0; j < p.t.size(); ++j)
      worstMass = std::max(worstMass, std::abs(double(s.q[j] - exact.q[j])) * (1 - p.alpha));
    worstSum = std::max(worstSum, std::abs(sum(s.q) - 1));
    inBounds &= s.result.lambda >= 1 - 1e-14 && s.result.lambda <= (1 + 1e-14) / (1 - p.alpha);
  }
  CHECK(worstLambda < 1e-14);
  CHECK(worstMass < 1e-14);
  CHECK(worstSum < 1e-14);
  CHECK(inBounds);
}

TEST_CASE("No other feasible density has a smaller second moment") {
  RandomProblems problems(2);
  int better = 0;
  for (int i = 0; i < 300; ++i) {
    const Problem p = problems.next();
    const Solution s = solve(p);
    const std::vector<long double> best(s.q.begin(), s.q.end());
    const long double smallest = test::secondMoment(p.t, p.b, best, p.alpha);
    for (int k = 0; k < 20; ++k) {
      // A step towards any other density is feasible.
      std::vector<long double> other(best.size());
      long double total = 0;
      for (auto& x : other) total += x = std::pow(problems.uniform(), 1 + 8 * problems.uniform());
      const long double step = std::pow(10.0L, -4 * problems.uniform());
      for (std::size_t j = 0; j < other.size(); ++j) other[j] = (1 - step) * best[j] + step * other[j] / total;
      better += test::secondMoment(p.t, p.b, other, p.alpha) < smallest * (1 - 1e-13L);
    }
  }
  CHECK(better == 0);
}

TEST_CASE("The published form is feasible and no better; on a spike it is worse") {
  RandomProblems problems(3);
  for (int i = 0; i < 500; ++i) {
    const Problem p = problems.next();
    const Solution exact = solve(p), published = solve(p, CompensationForm::ClipRenormalise);
    const auto moment = [&](const Solution& s) {
      return test::secondMoment(p.t, p.b, std::vector<long double>(s.q.begin(), s.q.end()), p.alpha);
    };
    if (published.result.empty) continue;
    if (std::abs(sum(published.q) - 1) > 1e-14) FAIL("mass");
    if (moment(published) < moment(exact) * (1 - 1e-13L)) FAIL("better than the optimum");
  }
  const Problem spike{{6, 2, 1, 1}, {0.25, 0.25, 0.25, 0.25}, 0.5};
  const auto moment = [&](CompensationForm form) {
    const Solution s = solve(spike, form);
    return test::secondMoment(spike.t, spike.b, std::vector<long double>(s.q.begin(), s.q.end()), spike.alpha);
  };
  CHECK(moment(CompensationForm::ClipRenormalise) < 0.999L * moment(CompensationForm::None));
  CHECK(moment(CompensationForm::WaterFilling) < moment(CompensationForm::ClipRenormalise));
}

TEST_CASE("The other forms are what they say") {
  const Problem p{{4, 1, 2, 1}, {0.25, 0.25, 0.25, 0.25}, 0.6};
  const Solution none = solve(p, CompensationForm::None);
  CHECK(none.q == std::vector<double>{0.5, 0.125, 0.25, 0.125});
  CHECK(none.result.removedMass == 0);
  const Solution clip = solve(p, CompensationForm::ClipRenormalise);  // 0.35, 0, 0.1, 0 of 0.45
  CHECK(clip.q[0] == Approx(0.35 / 0.45));
  CHECK(clip.q[1] == 0);
  CHECK(clip.q[2] == Approx(0.1 / 0.45));
  CHECK(clip.result.removedMass == Approx(0.25));
}

TEST_CASE("Without a share of the other technique every form is the target itself") {
  for (const auto form : {CompensationForm::None, CompensationForm::WaterFilling, CompensationForm::ClipRenormalise}) {
    const Solution s = solve({{3, 0, 1}, {0.2, 0.5, 0.3}, 0}, form);
    CHECK(s.q[0] == Approx(0.75).epsilon(1e-15));
    CHECK(s.q[1] == 0);
    CHECK(s.result.lambda == Approx(1).epsilon(1e-15));
  }
}

TEST_CASE("A target that is the other technique's density stays as it is") {
  for (const double alpha : {0.0, 0.3, 0.5, 0.99, 0.999999}) {
    const std::vector<double> b{0.125, 0.5, 0.25, 0.125};
    const Solution s = solve({b, b, alpha});
    REQUIRE(!s.result.empty);
    for (std::size_t j = 0; j < b.size(); ++j) CHECK(s.q[j] == Approx(b[j]).epsilon(1e-9));
    CHECK(s.result.lambda == Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("Where the other technique cannot sample, the guide does it all") {
  const Solution s = solve({{0, 0, 2, 6}, {0.5, 0.5, 0, 0}, 0.7});
  CHECK(s.q == std::vector<double>{0, 0, 0.25, 0.75});
  CHECK(s.result.lambda == Approx(1 / 0.3));
}

TEST_CASE("One cell") {
  for (const auto form : {CompensationForm::None, CompensationForm::WaterFilling, CompensationForm::ClipRenormalise}) {
    const Solution s = solve({{1e-300}, {1}, 0.9}, form);
    CHECK(!s.result.empty);
    CHECK(s.q[0] == 1);
  }
}

TEST_CASE("The same in float") {
  RandomProblems problems(4);
  double worst = 0, worstSum = 0;
  for (int i = 0; i < 1000; ++i) {
    const Problem p = problems.next();
    const std::vector<float> t(p.t.begin(), p.t.end()), b(p.b.begin(), p.b.end());
    std::vector<float> q(t.size());
    if (compensate(t, b, float(p.alpha), CompensationForm::WaterFilling, q).empty) FAIL("empty");
    const Solution s = solve({{t.begin(), t.end()}, {b.begin(), b.end()}, float(p.alpha)});
    double total = 0;
    for (std::size_t j = 0; j < q.size(); ++j) {
      worst = std::max(worst, std::abs(q[j] - s.q[j]));
      total += q[j];
    }
    worstSum = std::max(worstSum, std::abs(total - 1));
  }
  CHECK(worst < 1e-7);
  CHECK(worstSum < 1e-6);
}
