#include "discrete_case.h"

#include <cmath>
#include <numeric>

namespace test {

namespace {

void normalise(std::vector<double>& values) {
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  for (double& value : values) value /= sum;
}

}  // namespace

DiscreteCase DiscreteCase::random(std::uint64_t seed) {
  Random random(seed);
  DiscreteCase c;
  const int cells = 6;
  const double contrast = 1 + 5 * random.next1D();
  for (int i = 0; i < cells; ++i) {
    c.f.push_back(random.next1D() < 0.2f ? 0 : std::exp(contrast * (random.next1D() - 0.5)));
    c.p[0].push_back(random.next1D() < 0.1f ? 0 : std::exp(contrast * (random.next1D() - 0.5)));
    c.p[1].push_back(random.next1D() < 0.1f && c.p[0].back() > 0 ? 0 : std::exp(contrast * (random.next1D() - 0.5)));
  }
  c.f[0] = 1;
  c.p[0][0] = c.p[1][1] = 1;
  normalise(c.p[0]);
  normalise(c.p[1]);
  return c;
}

double DiscreteCase::integral() const {
  return std::accumulate(f.begin(), f.end(), 0.0);
}

double DiscreteCase::secondMoment(double share) const {
  double sum = 0;
  for (std::size_t i = 0; i < size(); ++i)
    if (f[i] > 0) sum += f[i] * f[i] / (share * p[0][i] + (1 - share) * p[1][i]);
  return sum;
}

double DiscreteCase::divergence(double share) const {
  double sum = 0;
  for (std::size_t i = 0; i < size(); ++i)
    if (f[i] > 0) sum -= f[i] * std::log(share * p[0][i] + (1 - share) * p[1][i]);
  return sum;
}

std::vector<pt::TechniqueSample> DiscreteCase::cells() const {
  std::vector<pt::TechniqueSample> result;
  for (std::size_t i = 0; i < size(); ++i) result.push_back({f[i], {p[0][i], p[1][i]}, 1.0});
  return result;
}

std::vector<pt::TechniqueSample> DiscreteCase::draw(std::array<int, 2> counts, Random& random) const {
  std::vector<pt::TechniqueSample> result;
  for (std::size_t technique = 0; technique < 2; ++technique)
    for (int k = 0; k < counts[technique]; ++k) {
      double u = random.next1D();
      std::size_t i = 0;
      while (i + 1 < size() && (u -= p[technique][i]) >= 0) ++i;
      while (p[technique][i] == 0) --i;  // u beyond the rounded sum
      result.push_back({f[i], {p[0][i], p[1][i]}, 1 / (counts[0] * p[0][i] + counts[1] * p[1][i])});
    }
  return result;
}

double minimumOf(const std::function<double(double)>& f, double from, double to) {
  for (int round = 0; round < 12; ++round) {
    const int steps = 100;
    int best = 0;
    for (int i = 1; i <= steps; ++i)
      if (f(from + (to - from) * i / steps) < f(from + (to - from) * best / steps)) best = i;
    const double width = (to - from) / steps, middle = from + (to - from) * best / steps;
    from = std::max(from, middle - width);
    to = std::min(to, middle + width);
  }
  return (from + to) / 2;
}

}  // namespace test
