#include "core/fresnel.h"

#include <complex>

#include "catch.h"

using namespace pt;

namespace {

double reflectanceFromComplexIndex(double cosI, std::complex<double> n) {
  const std::complex<double> cosT = std::sqrt(1.0 - (1 - cosI * cosI) / (n * n));
  const std::complex<double> s = (cosI - n * cosT) / (cosI + n * cosT), p = (n * cosI - cosT) / (n * cosI + cosT);
  return 0.5 * (std::norm(s) + std::norm(p));
}

/// Midpoint rule of 2 cos F(cos).
double diffuseReflectanceByQuadrature(double eta) {
  constexpr int kSteps = 200'000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double c = (i + 0.5) / kSteps, sin2T = (1 - c * c) / (eta * eta);
    sum += 2 * c * (sin2T >= 1 ? 1 : reflectanceFromComplexIndex(c, eta)) / kSteps;
  }
  return sum;
}

}  // namespace

TEST_CASE("Dielectric reflectance at known angles") {
  CHECK(fresnelDielectric(1, 1.5f).reflectance == Approx(0.04));
  CHECK(fresnelDielectric(-1, 1.5f).reflectance == Approx(0.04));
  CHECK(fresnelDielectric(0, 1.5f).reflectance == Approx(1));
  // Brewster's angle: only one polarisation is reflected, ((n^2-1)/(n^2+1))^2 of it.
  CHECK(fresnelDielectric(std::cos(std::atan(1.5f)), 1.5f).reflectance == Approx(0.5 * std::pow(1.25 / 3.25, 2)));
}

TEST_CASE("Dielectric reflectance from either side") {
  for (const float cosI : {0.1f, 0.4f, 0.7f, 0.95f}) {
    const DielectricFresnel outside = fresnelDielectric(cosI, 1.5f);
    CHECK(outside.eta == 1.5f);
    CHECK(outside.cosThetaT < 0);
    CHECK(std::sqrt(1 - cosI * cosI) == Approx(1.5 * std::sqrt(1 - outside.cosThetaT * outside.cosThetaT)));
    // The same boundary crossed backwards.
    const DielectricFresnel inside = fresnelDielectric(outside.cosThetaT, 1.5f);
    CHECK(inside.reflectance == Approx(outside.reflectance).epsilon(1e-4));
    CHECK(inside.cosThetaT == Approx(cosI).epsilon(1e-4));
    CHECK(inside.eta == Approx(1 / 1.5));
    // Swapping the media is swapping the sides.
    CHECK(fresnelDielectric(-cosI, 1.5f).reflectance == Approx(fresnelDielectric(cosI, 1 / 1.5f).reflectance));
  }
  const DielectricFresnel total = fresnelDielectric(-0.5f, 1.5f);
  CHECK(total.reflectance == 1);
  CHECK(total.cosThetaT == 0);
}

TEST_CASE("Equal media reflect nothing") {
  for (const float cosI : {-1.0f, -0.2f, 0.0f, 0.3f, 1.0f}) {
    const DielectricFresnel f = fresnelDielectric(cosI, 1);
    CHECK(f.reflectance == 0);
    CHECK(f.cosThetaT == -cosI);
  }
}

TEST_CASE("Conductor reflectance agrees with complex arithmetic") {
  for (const float cosI : {1e-3f, 0.2f, 0.5f, 0.8f, 1.0f}) {
    for (const auto& [eta, k] :
         {std::pair(0.2f, 3.9f), std::pair(1.66f, 9.22f), std::pair(2.0f, 0.5f), std::pair(0.5f, 0.2f)}) {
      INFO(cosI << ' ' << eta << ' ' << k);
      CHECK(fresnelConductor(cosI, eta, k) == Approx(reflectanceFromComplexIndex(cosI, {eta, k})).epsilon(1e-4));
    }
    CHECK(fresnelConductor(cosI, 1.5f, 0) == Approx(fresnelDielectric(cosI, 1.5f).reflectance).epsilon(1e-4));
    CHECK(fresnelConductor(cosI, 0, 1) == Approx(1));
  }
}

TEST_CASE("Diffuse reflectance in closed form agrees with quadrature") {
  for (const float eta : {1.02f, 1.33f, 1.49f, 2.4f, 4.0f, 1 / 1.33f, 1 / 1.5f, 1 / 2.4f}) {
    INFO(eta);
    CHECK(diffuseFresnelReflectance(eta) == Approx(diffuseReflectanceByQuadrature(eta)).margin(2e-6));
  }
  CHECK(diffuseFresnelReflectance(1) == 0);
  CHECK(diffuseFresnelReflectance(1.00011f) < 1e-4f);
  CHECK(diffuseFresnelReflectance(1.00011f) >= 0);
}
