#include <random>

#include "catch.h"
#include "reference/reference.h"
#include "results/metric.h"

namespace {

/// Parts of a picture of mean 1 whose pixels have the given standard deviation.
std::vector<pt::Image> drawParts(std::mt19937_64& rng, int count, float sigma, float mean = 1) {
  std::normal_distribution<float> normal(mean, sigma);
  std::vector<pt::Image> parts(count, pt::Image(64, 48));
  for (pt::Image& part : parts)
    for (pt::Spectrum& pixel : part.pixels) pixel = pt::Spectrum(normal(rng), normal(rng), normal(rng));
  return parts;
}

double rateOfDisagreement(float meanOfSecond, int trials) {
  std::mt19937_64 rng(9);
  int disagreements = 0;
  for (int i = 0; i < trials; ++i)
    disagreements += !bench::compareEstimators(drawParts(rng, 8, 0.3f), drawParts(rng, 8, 0.5f, meanOfSecond)).agrees();
  return double(disagreements) / trials;
}

}  // namespace

TEST_CASE("the noise of a reference is estimated from its halves") {
  std::mt19937_64 rng(3);
  const pt::Image truth = drawParts(rng, 1, 0)[0];
  for (const int count : {4, 8}) {
    const bench::Reference reference = bench::combineParts(drawParts(rng, count, 0.2f), 100);
    CHECK(reference.spp == 100 * count);
    const double expected = 0.2 * 0.2 / count / 1.01;
    CHECK(bench::measure(reference.image, truth).relMse == Approx(expected).epsilon(0.05));
    CHECK(reference.noise == Approx(expected).epsilon(0.05));
  }
}

TEST_CASE("estimators of the same picture agree, a biased one is found out") {
  CHECK(rateOfDisagreement(1.0f, 300) <= 0.01);
  CHECK(rateOfDisagreement(1.05f, 20) == 1);
}

TEST_CASE("a bias in one corner is found") {
  std::mt19937_64 rng(5);
  const auto a = drawParts(rng, 8, 0.3f);
  auto b = drawParts(rng, 8, 0.3f);
  for (pt::Image& part : b)
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) part.at(x, y) *= 1.1f;
  CHECK(bench::compareEstimators(a, b).worstT > 6);
  CHECK_FALSE(bench::compareEstimators(a, b).agrees());
}
