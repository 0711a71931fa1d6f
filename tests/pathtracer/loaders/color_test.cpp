#include "loaders/color.h"

#include "core/near_name.h"
#include "loader_fixture.h"
#include "loaders/parse_number.h"
#include "loaders/refraction_index.h"

using namespace pt;
using test::isNear;

TEST_CASE("a constant spectrum over the visible range has the colour of equal energy") {
  // XYZ = (1, 1, 1) through the Rec.709 matrix.
  const SpectralSample flat[] = {{300, 1}, {900, 1}};
  CHECK(isNear(spectrumToRgb(flat), Vec3(1.2048f, 0.9483f, 0.9089f), 2e-3f));
}

TEST_CASE("spectra are interpolated linearly and are zero outside of their samples") {
  const SpectralSample ramp[] = {{400, 0}, {700, 3}}, same[] = {{400, 0}, {500, 1}, {600, 2}, {700, 3}};
  CHECK(isNear(spectrumToRgb(ramp), spectrumToRgb(same)));
  const SpectralSample falling[] = {{400, 3}, {700, 0}};
  CHECK_FALSE(isNear(spectrumToRgb(ramp), spectrumToRgb(falling), 0.1f));  // the direction matters

  const SpectralSample red[] = {{650, 1}, {700, 1}};
  const Spectrum rgb = spectrumToRgb(red);
  CHECK(rgb.x > 5 * std::abs(rgb.y));
  const SpectralSample infrared[] = {{800, 5}, {900, 5}};
  CHECK(isNear(spectrumToRgb(infrared), Vec3(0, 0, 0)));
}

TEST_CASE("black bodies: cool ones are red, the hot ones blue, and the sun's is as bright as Planck says") {
  const Spectrum candle = blackbodyToRgb(1900), sun = blackbodyToRgb(5778), hot = blackbodyToRgb(20000);
  CHECK(candle.x > candle.y);
  CHECK(candle.y > candle.z);
  CHECK(hot.z > hot.x);
  // Planck's law at 555 nm, where the eye is most sensitive: 2.6e4 W / (m^2 sr nm).
  CHECK(luminance(sun) == Approx(2.6e4).epsilon(0.05));
}

TEST_CASE("sRGB and hexadecimal colours") {
  CHECK(isNear(srgbToLinear(Spectrum(0, 0.5f, 1)), Vec3(0, 0.21404f, 1)));
  CHECK(srgbToLinear(Spectrum(0.04f)).x == Approx(0.04 / 12.92));
  CHECK(isNear(*parseHexColor("#ff8000"), Vec3(1, 128 / 255.0f, 0)));
  CHECK_FALSE(parseHexColor("#ff80"));
  CHECK_FALSE(parseHexColor("ff80001"));
  CHECK_FALSE(parseHexColor("#ff80g0"));
}

TEST_CASE("numbers: whole, finite, and nothing else") {
  CHECK(*parseNumber("9.40074e-010") == Approx(9.40074e-10));
  CHECK(*parseNumber(" +2 ") == 2);
  CHECK(*parseNumber("-.5") == -0.5);
  for (const char* bad : {"", " ", "nan", "inf", "1e999", "1e39", "1.5m", "1,5", "0x10", "--1", "+-1"}) {
    CAPTURE(bad);
    CHECK_FALSE(parseNumber(bad));
  }
  CHECK(*parseInteger("-12") == -12);
  for (const char* bad : {"", "1.0", "1e3", "99999999999999999999"}) CHECK_FALSE(parseInteger(bad));
  CHECK(splitList(" 1, 2\t3,,4 ").size() == 4);
}

TEST_CASE("the nearest name is offered only when it is near") {
  CHECK(nearestName("reflectence", {"reflectance", "roughness"}) == "reflectance");
  CHECK(nearestName("FOV", {"fov", "film"}) == "fov");
  CHECK_FALSE(nearestName("banana", {"fov", "film"}));
  CHECK(suggestName("banana", {"fov", "film"}) == "; known: fov, film");
}

TEST_CASE("indices of refraction by name") {
  CHECK(*findRefractionIndex("BK7") == Approx(1.5046));
  CHECK(*findRefractionIndex("water ice") == Approx(1.31));
  CHECK_FALSE(findRefractionIndex("butter"));
}
