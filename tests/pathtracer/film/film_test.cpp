#include "film/film.h"

#include <limits>

#include "catch.h"
#include "integrators/iteration_images.h"

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
