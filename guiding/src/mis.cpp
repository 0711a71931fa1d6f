#include "guiding/mis.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "water_level.h"

namespace guiding {

namespace {

/// Sum with a running correction [Neumaier 1974]: 2^20 cells of very different size still add up to the last bits.
class ExactSum {
 public:
  void add(double x) noexcept {
    const double t = m_sum + x;
    m_correction += std::abs(m_sum) >= std::abs(x) ? (m_sum - t) + x : (x - t) + m_sum;
    m_sum = t;
  }
  double value() const noexcept { return m_sum + m_correction; }

 private:
  double m_sum = 0, m_correction = 0;
};

/// The same for eight cells at a time.
class ExactSum8 {
 public:
  void add(const Double8& x) noexcept {
    const Double8 t = m_sum + x;
    const Double8 sumSize = m_sum < 0 ? -m_sum : m_sum, xSize = x < 0 ? -x : x;
    m_correction += sumSize >= xSize ? (m_sum - t) + x : (x - t) + m_sum;
    m_sum = t;
  }
  double total() const noexcept {
    ExactSum sum;
    for (int lane = 0; lane < 8; ++lane) sum.add(m_sum[lane]);
    for (int lane = 0; lane < 8; ++lane) sum.add(m_correction[lane]);
    return sum.value();
  }

 private:
  Double8 m_sum{}, m_correction{};
};

/// visit(scaled(t), b) for eight cells at a time; missing ones are empty.
template <class Real, class Scaled, class Visit>
void forEachEight(std::span<const Real> t, std::span<const Real> b, const Scaled& scaled, Visit&& visit) noexcept {
  for (std::size_t j = 0; j < t.size(); j += 8) {
    Double8 t8{}, b8{};
    const std::size_t count = std::min<std::size_t>(8, t.size() - j);
    for (std::size_t lane = 0; lane < count; ++lane) {
      t8[lane] = scaled(t[j + lane]);
      b8[lane] = b[j + lane];
    }
    visit(t8, b8);
  }
}

/// Largest mass; negative if any mass of either technique is unusable.
template <class Real>
double largestMass(std::span<const Real> t, std::span<const Real> b) noexcept {
  double largest = 0;
  for (std::size_t j = 0; j < t.size(); ++j) {
    if (!(t[j] >= 0 && t[j] <= std::numeric_limits<Real>::max())) return -1;
    if (!(b[j] >= 0 && b[j] <= std::numeric_limits<Real>::max())) return -1;
    largest = std::max(largest, double(t[j]));
  }
  return largest;
}

template <class Real>
CompensationResult solve(std::span<const Real> t, std::span<const Real> b, double alpha, CompensationForm form,
                         std::span<Real> q) noexcept {
  assert(t.size() == b.size() && t.size() == q.size());
  const auto nothing = [&] {
    std::fill(q.begin(), q.end(), Real(0));
    return CompensationResult{0, 0, true};
  };
  const double largest = largestMass(t, b);
  if (!(largest > 0) || !(alpha >= 0 && alpha < 1)) return nothing();

  // Scaled in two steps, so that neither 1e300 nor a subnormal total leaves the range of double.
  int exponent = 0;
  std::frexp(largest, &exponent);
  const double toUnit = std::ldexp(1.0, std::clamp(-exponent, -1022, 1022));
  ExactSum total;
  for (const Real tj : t) total.add(tj * toUnit);
  const double perTotal = 1 / total.value();
  const auto scaled = [=](double tj) { return tj * toUnit * perTotal; };

  CompensationResult result;
  result.lambda =
      form == CompensationForm::WaterFilling
          ? waterLevel<Double8, ExactSum8, double>([&](auto&& visit) { forEachEight(t, b, scaled, visit); }, alpha)
          : 1.0;
  const double floor = form == CompensationForm::None ? 0.0 : alpha;
  ExactSum kept, removed;
  for (std::size_t j = 0; j < t.size(); ++j) {
    const double tj = scaled(t[j]);
    const double rest = tj / result.lambda - floor * b[j];
    if (!(rest > 0)) removed.add(tj);
    kept.add(std::max(0.0, rest));
    q[j] = Real(std::max(0.0, rest));
  }
  result.removedMass = std::clamp(removed.value(), 0.0, 1.0);
  if (!(kept.value() > 0)) return nothing();
  const double normalise = 1 / kept.value();
  for (Real& qj : q) qj = Real(qj * normalise);
  return result;
}

}  // namespace

CompensationResult compensate(std::span<const float> t, std::span<const float> b, float alpha, CompensationForm form,
                              std::span<float> q) noexcept {
  return solve<float>(t, b, alpha, form, q);
}

CompensationResult compensate(std::span<const double> t, std::span<const double> b, double alpha, CompensationForm form,
                              std::span<double> q) noexcept {
  return solve<double>(t, b, alpha, form, q);
}

float misWeight(MisHeuristic heuristic, std::span<const float> products, std::size_t own) noexcept {
  constexpr double kCutoff = 0.1;
  const double largest = *std::max_element(products.begin(), products.end());
  if (!(products[own] > 0)) return 0;
  const auto part = [&](float product) {
    const double x = product / largest;
    switch (heuristic) {
      case MisHeuristic::Power:
        return x * x;
      case MisHeuristic::Cutoff:
        return x < kCutoff ? 0.0 : x;
      case MisHeuristic::Maximum:
        return x < 1 ? 0.0 : 1.0;
      default:
        return x;
    }
  };
  double sum = 0;
  for (const float product : products) sum += part(product);
  return float(part(products[own]) / sum);
}

}  // namespace guiding
