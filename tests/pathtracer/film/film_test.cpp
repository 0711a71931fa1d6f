#include "film/film.h"

#include <limits>

#include "catch.h"
#include "core/sampler.h"
#include "integrators/iteration_images.h"
#include "statistics/random.h"
#include "statistics/z_test.h"

using pt::Film;
using pt::Spectrum;

TEST_CASE("A film's pixels are the means of their samples") {
  Film film(2, 2);
  film.add(0, 0, Spectrum(1, 2, 3));
  film.add(0, 0, Spectrum(3, 2, 1));
  film.add(1, 1, Spectrum(5));
  const pt::Image image = film.mean();
  CHECK(image.at(0, 0) == Spectrum(2, 2, 2));
  CHECK(image.at(1, 1) == Spectrum(5));
  CHECK(image.at(1, 0) == Spectrum(0));
}

TEST_CASE("A film estimates the variance of each pixel's mean without bias") {
  Film film(2, 1);
  for (float value : {1.0f, 2.0f, 3.0f, 6.0f}) film.add(0, 0, Spectrum(value));
  for (int i = 0; i < 4; ++i) film.add(1, 0, Spectrum(0.3f));
  // Mean 3, squared deviations 4 + 1 + 0 + 9 over (n - 1) n; the luminance's weights sum to 1.
  const auto variance = film.pixelVariance();
  CHECK(variance[0] == Approx(14.0 / 12).epsilon(1e-6));
  CHECK(variance[1] == Approx(0).margin(1e-16));
  CHECK(film.meanVariance() == Approx(7.0 / 12).epsilon(1e-6));
}

TEST_CASE("What few samples predict of the variance without a guide is right in the mean over pixels") {
  // Two samples of 1 each; without a guide they would be 0 or 2, as likely. A sample in four speaks for them, for 4
  // each: of most pixels a variance below 0 is predicted, which must stay as it is.
  constexpr int kSide = 64;
  Film film(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      for (int i = 0; i < 2; ++i) {
        film.add(x, y, Spectrum(1));
        film.addUnguidedSquare(x, y, (x + 2 * y + i) % 4 == 0 ? 8 : 0);  // mean 2, as that of 0 and 4
      }
  pt::Image sum(kSide, kSide);
  pt::addWeighted(sum, film.mean(), 2.0);
  CHECK(film.relativeVariance(sum, 2).here == Approx(0).margin(1e-9));
  CHECK(film.relativeVariance(sum, 2).unguided == Approx(0.5 / 1.01).epsilon(0.01));  // clamped: 1.5 times that
}

TEST_CASE("The variance of half a picture tells nothing of the other half, and each half has weights of its own") {
  Film film(3, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x)
      for (const float sign : {-1.0f, 1.0f})
        film.add(x, y, Spectrum(10 + sign * (Film::halfOf(x, y) == 0 ? 1.0f : 2.0f)));
  CHECK(film.halfVariance()[0] == Approx(1).epsilon(1e-6));
  CHECK(film.halfVariance()[1] == Approx(4).epsilon(1e-6));
  CHECK(film.meanVariance() == Approx(2.5).epsilon(1e-6));

  Film second(3, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) second.add(x, y, Spectrum(20));
  pt::IterationImages images(false);
  images.add(film);
  images.add(second);
  const pt::Image sum = images.combined(pt::ImageWeights{{{0.5, 1.0}, {0.5, 0.0}}});
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) CHECK(sum.at(x, y) == Spectrum(Film::halfOf(x, y) == 0 ? 25.0f : 5.0f));
}

TEST_CASE("Runs of samples tell the variance without bias, whatever their lengths") {
  constexpr int kPixels = 20000;
  pt::Image level(kPixels, 1);
  std::fill(level.pixels.begin(), level.pixels.end(), Spectrum(1));
  for (const auto& lengths : {std::vector{1, 1}, {4, 4}, {4, 4, 4}, {4, 4, 2}, {8, 3}}) {
    Film film(kPixels, 1);
    film.compareReplicates();
    test::Random random(3);
    int samples = 0;
    for (const int length : lengths) {
      for (int i = 0; i < length; ++i)
        for (int x = 0; x < kPixels; ++x) film.add(x, 0, Spectrum(random.next1D()));
      samples += length;
      if (&length != &lengths.back()) film.endReplicate();  // the last run may not have ended
    }
    // With one degree of freedom the standard error is sqrt(2 / pixels) of the value, and the 0.1% that are worst have
    // 1.2% of it. The level is raised by a hundredth.
    const double truth = 0.988 / 12 / samples / 1.01;
    const Film::RelativeVariance variance = film.relativeVariance(level, 1);
    CAPTURE(lengths, variance.here / truth);
    CHECK(std::abs(variance.here / truth - 1) < 4.5 * std::sqrt(2.0 / kPixels));
    // These samples are independent.
    CHECK(variance.independent == Approx(variance.here).epsilon(0.05));
    // Clearing forgets all.
    film.clear();
    CHECK(film.relativeVariance(level, 1).here == 0);
  }
}

TEST_CASE("A single run has no known variance") {
  pt::Image level(1, 1);
  level.pixels[0] = Spectrum(1);
  Film film(1, 1);
  film.compareReplicates();
  for (int i = 0; i < 4; ++i) film.add(0, 0, Spectrum(float(i)));
  CHECK(film.relativeVariance(level, 1).here == 0);
  film.endReplicate();
  CHECK(film.relativeVariance(level, 1).here == 0);
  film.add(0, 0, Spectrum(5));
  CHECK(film.relativeVariance(level, 1).here > 0);
}

TEST_CASE("Of stratified samples runs tell the error, and sample by sample does not") {
  constexpr int kPixels = 4000, kSamples = 64;
  Film film(kPixels, 1);
  film.compareReplicates();
  pt::Sampler sampler(pt::SamplerKind::Sobol, 8);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    for (int x = 0; x < kPixels; ++x) {
      sampler.startPath(x, 0, i);
      const pt::Vec2 u = sampler.next2D();
      film.add(x, 0, Spectrum(u.x * u.x + u.y < 1 ? 1.0f : 0.0f));  // an edge; the truth is 2/3
    }
    if ((i + 1) % (kSamples / 2) == 0) film.endReplicate();
  }
  const pt::Image mean = film.mean();
  double error = 0;
  for (const Spectrum& pixel : mean.pixels) error += (pixel.x - 2.0 / 3) * (pixel.x - 2.0 / 3) / kPixels;
  pt::Image level(kPixels, 1);
  std::fill(level.pixels.begin(), level.pixels.end(), Spectrum(1));
  const Film::RelativeVariance relative = film.relativeVariance(level, 1);
  // The difference of halves knows no more than the error of half as many samples.
  CHECK(relative.here > 0.9 * error);
  CHECK(relative.here < 4 * error);
  CHECK(relative.independent > 5 * error);
  CHECK(film.meanVariance() > 5 * error);
}

TEST_CASE("A single sample has no known variance") {
  Film film(1, 1);
  film.add(0, 0, Spectrum(3));
  CHECK(film.meanVariance() == 0);
}

TEST_CASE("A film counts values that are no radiance as black, and says so") {
  Film film(1, 1);
  film.add(0, 0, Spectrum(2));
  film.add(0, 0, Spectrum(1, std::numeric_limits<float>::quiet_NaN(), 1));
  film.add(0, 0, Spectrum(std::numeric_limits<float>::infinity(), 0, 0));
  film.add(0, 0, Spectrum(1, 1, -1e-3f));
  CHECK(film.rejectedSamples() == 3);
  CHECK(film.mean().at(0, 0) == Spectrum(0.5f));
  film.clear();
  CHECK(film.rejectedSamples() == 0);
  CHECK(film.mean().at(0, 0) == Spectrum(0));
}

TEST_CASE("A film's sums keep small samples beside a large one") {
  Film film(1, 1);
  film.add(0, 0, Spectrum(1 << 25));
  for (int i = 0; i < 1000; ++i) film.add(0, 0, Spectrum(1));
  CHECK(double(film.mean().at(0, 0).x) * 1001 == Approx((1 << 25) + 1000).epsilon(1e-7));
}
