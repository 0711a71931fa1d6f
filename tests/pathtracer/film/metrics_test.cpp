#include "film/metrics.h"

#include "catch.h"
#include "core/error.h"

using namespace pt;

TEST_CASE("The metrics are their formulas") {
  Image image(2, 1), reference(2, 1);
  reference.at(0, 0) = Spectrum(1, 2, 0);
  image.at(0, 0) = Spectrum(1.5f, 2, 0.1f);
  reference.at(1, 0) = Spectrum(1);
  image.at(1, 0) = Spectrum(1);
  const ImageError error = compareImages(image, reference);
  CHECK(error.mse.all == Approx((0.25 + 0.01) / 6).epsilon(1e-6));
  CHECK(error.relMse.all == Approx((0.25 / 1.01 + 0.01 / 0.01) / 6).epsilon(1e-6));
  CHECK(error.relMse.trimmed == error.relMse.all);  // 0.1% of two pixels is none
  CHECK(error.mape.all == Approx((0.5 / 1.01 + 0.1 / 0.01) / 6).epsilon(1e-6));
  CHECK(error.smape.all == Approx((1.0 / 2.51 + 0.2 / 0.11) / 6).epsilon(1e-6));
  CHECK(error.bias == Approx(0.6 / 6).epsilon(1e-6));
  const Image picture = errorPicture(image, reference);
  CHECK(picture.at(0, 0).x == Approx((0.25 / 1.01 + 1) / 3).epsilon(1e-6));
  CHECK(picture.at(1, 0) == Spectrum(0));
}

TEST_CASE("Trimming leaves out the worst pixels and nothing else") {
  Image image(100, 30), reference(100, 30);
  for (auto& pixel : reference.pixels) pixel = Spectrum(1);
  for (auto& pixel : image.pixels) pixel = Spectrum(1.1f);
  for (int i : {5, 700, 2999}) image.pixels[std::size_t(i)] = Spectrum(1e6f);
  const ImageError error = compareImages(image, reference);
  CHECK(error.relMse.trimmed == Approx(0.01 / 1.01).epsilon(1e-5));
  CHECK(error.relMse.all > 1e8);
  CHECK(error.mse.trimmed == Approx(0.01).epsilon(1e-5));
  CHECK(error.mape.trimmed == Approx(0.1 / 1.01).epsilon(1e-5));
  CHECK(error.smape.trimmed == Approx(0.2 / 2.11).epsilon(1e-5));
  image.pixels[1000] = Spectrum(1e6f);  // one more than 0.1%
  CHECK(compareImages(image, reference).relMse.trimmed > 1e8);
}

TEST_CASE("Pixels that are not finite are counted and left out") {
  Image image(3, 1), reference(3, 1);
  for (auto& pixel : reference.pixels) pixel = Spectrum(1);
  image.at(0, 0) = Spectrum(std::numeric_limits<float>::quiet_NaN());
  image.at(1, 0) = Spectrum(std::numeric_limits<float>::infinity());
  image.at(2, 0) = Spectrum(2);
  const ImageError error = compareImages(image, reference);
  CHECK(error.nonFinitePixels == 2);
  CHECK(error.mse.all == Approx(1));
  CHECK(errorPicture(image, reference).at(1, 0) == Spectrum(1));
}

TEST_CASE("Pictures that cannot be compared are refused") {
  Image a(2, 2), b(2, 3), nan(2, 2);
  nan.at(0, 0) = Spectrum(std::numeric_limits<float>::quiet_NaN());
  CHECK_THROWS_AS(compareImages(a, b), InputError);
  CHECK_THROWS_AS(compareImages(a, nan), InputError);
  CHECK_THROWS_AS(compareImages(Image(), Image()), InputError);
}
