#include "materials/beckmann_slopes.h"

#include <iterator>

namespace pt {

namespace {

constexpr float kInvSqrtPi = 0.564189584f;
/// Keeps arguments of erfInverse off +-1.
constexpr float kErfLimit = 1 - 1.2e-7f;

template <std::size_t N>
float polynomial(const float (&coefficients)[N], float x) noexcept {
  float sum = coefficients[0];
  for (std::size_t i = 1; i < N; ++i) sum = sum * x + coefficients[i];
  return sum;
}

/// Slope x with P(X < x) = u where the density of X is proportional to max(0, cos - x sin) exp(-x^2). Works on b =
/// erf(x), in which the distribution function is increasing and concave.
float sampleSlopeAlongTilt(float sinTheta, float cosTheta, float u) noexcept {
  const float cot = cosTheta / sinTheta;
  const float bMax = std::erf(cot);
  const float total = cosTheta * (1 + bMax) + sinTheta * kInvSqrtPi * std::exp(-cot * cot);
  const float target = std::clamp(u, 1e-6f, 1 - 1e-6f) * total;

  float low = -kErfLimit, high = std::min(bMax, kErfLimit);
  const float exponent = 1 - sinTheta * (0.855f - 0.301f * sinTheta);  // fitted; exact at normal incidence
  float b = bMax - (1 + bMax) * std::pow(1 - u, exponent);
  for (int i = 0; i < 10; ++i) {
    if (!(b > low && b < high)) b = 0.5f * (low + high);
    const float x = erfInverse(b);
    const float excess = cosTheta * (1 + b) + sinTheta * kInvSqrtPi * std::exp(-x * x) - target;
    (excess > 0 ? high : low) = b;
    b -= excess / std::max(1e-7f, cosTheta - x * sinTheta);
    if (std::abs(excess) < 1e-5f * total) break;  // the step above squares what is left
  }
  return erfInverse(std::clamp(b, low, high));
}

}  // namespace

float erfInverse(float x) noexcept {
  constexpr float kCentral[] = {2.81022636e-08f, 3.43273939e-07f, -3.5233877e-06f, -4.39150654e-06f, 0.00021858087f,
                                -0.00125372503f, -0.00417768164f, 0.246640727f,    1.50140941f};
  constexpr float kTail[] = {-0.000200214257f, 0.000100950558f, 0.00134934322f, -0.00367342844f, 0.00573950773f,
                             -0.0076224613f,   0.00943887047f,  1.00167406f,    2.83297682f};
  const float w = -std::log((1 - x) * (1 + x));
  return x * (w < 5 ? polynomial(kCentral, w - 2.5f) : polynomial(kTail, std::sqrt(w) - 3));
}

Vec2 sampleVisibleBeckmannSlopes(const Vec3& w, const Vec2& u) noexcept {
  const float sinTheta = std::sqrt(w.x * w.x + w.y * w.y);
  if (sinTheta < 1e-4f) {  // all slopes are equally visible
    const float r = std::sqrt(-std::log(1 - u.x));
    const float phi = 2 * kPi * u.y;
    return {r * std::cos(phi), r * std::sin(phi)};
  }
  const float along = sampleSlopeAlongTilt(sinTheta, w.z, u.x);
  const float across = erfInverse(std::clamp(2 * u.y - 1, -kErfLimit, kErfLimit));
  const float cosPhi = w.x / sinTheta, sinPhi = w.y / sinTheta;
  return {cosPhi * along - sinPhi * across, sinPhi * along + cosPhi * across};
}

}  // namespace pt
