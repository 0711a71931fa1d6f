#include "loaders/sun_and_sky.h"

#include <guiding/environment_layout.h>

#include <array>
#include <span>
#include <vector>

#include "loaders/color.h"
#include "loaders/painted_environment.h"

namespace pt {
namespace {

constexpr double kPiD = 3.14159265358979323846;
constexpr double kSunDiameter = 0.5358 * kPiD / 180;             // seen from the earth
constexpr double kLumensPerWatt = 683, kSumOfCieY = 106.856980;  // lm/W; nm

/// A distribution of one of Y, x, y over the sky, up to its value at the zenith [Perez et al. 1993].
struct Perez {
  double a, b, c, d, e;

  double operator()(double cosTheta, double gamma) const {
    const double cosGamma = std::cos(gamma);
    return (1 + a * std::exp(b / cosTheta)) * (1 + c * std::exp(d * gamma) + e * cosGamma * cosGamma);
  }
};

double horner(std::span<const double> coefficients, double x) {
  double sum = 0;
  for (const double c : coefficients) sum = sum * x + c;
  return sum;
}

/// Colour of the zenith [Preetham et al. 1999, App. A.2]: rows for turbidity^2, turbidity and 1, of polynomials in the
/// sun's angle from the zenith.
double zenithChromaticity(const double (&rows)[3][4], double turbidity, double sunTheta) {
  return (horner(rows[0], sunTheta) * turbidity + horner(rows[1], sunTheta)) * turbidity + horner(rows[2], sunTheta);
}

Spectrum toRgb(double luminance, double x, double y) {
  const double X = x / y * luminance, Y = luminance, Z = (1 - x - y) / y * luminance;
  return Spectrum(float(std::max(0.0, 3.240479 * X - 1.537150 * Y - 0.498535 * Z)),
                  float(std::max(0.0, -0.969256 * X + 1.875991 * Y + 0.041556 * Z)),
                  float(std::max(0.0, 0.055648 * X - 0.204043 * Y + 1.057311 * Z)));
}

/// A table over wavelength in nm, linear between its points, 0 outside.
double lookUp(std::span<const std::array<double, 2>> table, double nanometers) {
  for (std::size_t i = 1; i < table.size(); ++i) {
    const auto& [x0, y0] = table[i - 1];
    const auto& [x1, y1] = table[i];
    if (nanometers >= x0 && nanometers <= x1) return y0 + (y1 - y0) * (nanometers - x0) / (x1 - x0);
  }
  return 0;
}

// Tables 1 and 2 of [Preetham et al. 1999, App. A.1]: the sun's spectral radiance outside of the air, 380 to 750 nm in
// steps of 10, 100 W / (m^2 sr nm); absorption of ozone (per cm), mixed gases and water vapour.
constexpr double kSunFirst = 380, kSunStep = 10;
constexpr std::array kSunSpectrum = {165.5, 162.3, 211.2, 258.8, 258.2, 242.3, 267.6, 296.6, 305.4, 300.6,
                                     306.6, 288.3, 287.1, 278.2, 271.0, 272.3, 263.6, 255.0, 250.6, 253.1,
                                     253.5, 251.3, 246.3, 241.7, 236.8, 232.1, 228.2, 223.4, 219.7, 215.3,
                                     211.0, 207.3, 202.4, 198.7, 194.3, 190.7, 186.3, 182.6};
constexpr std::array<std::array<double, 2>, 50> kOzone = {{
    {445, 0.003}, {450, 0.003}, {455, 0.004}, {460, 0.006}, {465, 0.008}, {470, 0.009}, {475, 0.012}, {480, 0.014},
    {485, 0.017}, {490, 0.021}, {495, 0.025}, {500, 0.03},  {505, 0.035}, {510, 0.04},  {515, 0.045}, {520, 0.048},
    {525, 0.057}, {530, 0.063}, {535, 0.07},  {540, 0.075}, {545, 0.08},  {550, 0.085}, {555, 0.095}, {560, 0.103},
    {565, 0.110}, {570, 0.12},  {575, 0.122}, {580, 0.12},  {585, 0.118}, {590, 0.115}, {595, 0.12},  {600, 0.125},
    {605, 0.130}, {610, 0.12},  {620, 0.105}, {630, 0.09},  {640, 0.079}, {650, 0.067}, {660, 0.057}, {670, 0.048},
    {680, 0.036}, {690, 0.028}, {700, 0.023}, {710, 0.018}, {720, 0.014}, {730, 0.011}, {740, 0.010}, {750, 0.009},
    {760, 0.007}, {770, 0.004},
}};
constexpr std::array<std::array<double, 2>, 4> kMixedGases = {{{759, 0}, {760, 3.0}, {770, 0.210}, {771, 0}}};
constexpr std::array<std::array<double, 2>, 8> kWaterVapour = {
    {{689, 0}, {690, 0.016}, {700, 0.024}, {710, 0.0125}, {720, 1.0}, {730, 0.87}, {740, 0.061}, {750, 0.001}}};

/// Share of the sun's light that gets through the air, whose optical mass is `mass` of that towards the zenith.
double transmittance(double nanometers, double mass, double turbidity) {
  constexpr double kOzoneLength = 0.35, kWaterLength = 2;  // cm
  const double micrometers = nanometers / 1000;
  const double rayleigh = 0.008735 * std::pow(micrometers, -4.08) * mass;
  const double aerosol = (0.04608 * turbidity - 0.04586) * std::pow(micrometers, -1.3) * mass;
  const double ozone = lookUp(kOzone, nanometers) * kOzoneLength * mass;
  const double gas = lookUp(kMixedGases, nanometers) * mass;
  const double water = lookUp(kWaterVapour, nanometers) * kWaterLength * mass;
  return std::exp(-rayleigh - aerosol - ozone - 1.41 * gas / std::pow(1 + 118.93 * gas, 0.45) -
                  0.2385 * water / std::pow(1 + 20.07 * water, 0.45));
}

}  // namespace

Spectrum skyRadiance(const SunAndSky& daylight, const Vec3& direction) {
  const double t = daylight.turbidity;
  const Perez luminance{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                        -0.0670 * t + 0.3703};
  const Perez chromaX{-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
                      -0.0033 * t + 0.0452};
  const Perez chromaY{-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
                      -0.0109 * t + 0.0529};
  constexpr double kZenithX[3][4] = {
      {0.00166, -0.00375, 0.00209, 0}, {-0.02903, 0.06377, -0.03202, 0.00394}, {0.11693, -0.21196, 0.06052, 0.25886}};
  constexpr double kZenithY[3][4] = {
      {0.00275, -0.00610, 0.00317, 0}, {-0.04214, 0.08970, -0.04153, 0.00516}, {0.15346, -0.26756, 0.06670, 0.26688}};
  const double sunTheta = std::acos(std::clamp(double(daylight.sunDirection.y), 0.0, 1.0));
  const double chi = (4.0 / 9 - t / 120) * (kPiD - 2 * sunTheta);
  const double zenithLuminance = 1000 * ((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192);  // cd/m^2

  const double cosTheta = std::max(1e-3, double(direction.y));  // at the horizon the formula has no value
  const double gamma = std::acos(std::clamp(double(direction.dot(daylight.sunDirection)), -1.0, 1.0));
  const auto relative = [&](const Perez& perez) { return perez(cosTheta, gamma) / perez(1, sunTheta); };
  const double value = std::max(0.0, zenithLuminance * relative(luminance)) / (kLumensPerWatt * kSumOfCieY);
  return toRgb(value, zenithChromaticity(kZenithX, t, sunTheta) * relative(chromaX),
               zenithChromaticity(kZenithY, t, sunTheta) * relative(chromaY)) *
         float(daylight.skyScale);
}

Spectrum sunRadiance(const SunAndSky& daylight) {
  const double cosTheta = daylight.sunDirection.y;
  if (cosTheta <= 0) return Spectrum(0.0f);
  const double degrees = std::acos(std::min(1.0, cosTheta)) * 180 / kPiD;
  const double mass = 1 / (cosTheta + 0.15 * std::pow(93.885 - degrees, -1.253));
  std::vector<SpectralSample> spectrum;
  for (std::size_t i = 0; i < kSunSpectrum.size(); ++i) {
    const double nanometers = kSunFirst + kSunStep * double(i);
    spectrum.push_back({nanometers, 100 * kSunSpectrum[i] * transmittance(nanometers, mass, daylight.turbidity)});
  }
  const Spectrum rgb = spectrumToRgb(spectrum);
  const auto positive = [](float x) { return std::max(0.0f, x); };
  return Spectrum(positive(rgb.x), positive(rgb.y), positive(rgb.z)) * float(daylight.sunScale);
}

Image paint(const SunAndSky& daylight) {
  Image image(daylight.width, daylight.width / 2);
  const guiding::EnvironmentLayout layout(guiding::EnvironmentMapping::LatLong, image.width, image.height);
  for (int y = 0; daylight.hasSky && y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Vec3 w =
          layout.toDirection({(float(x) + 0.5f) / float(image.width), (float(y) + 0.5f) / float(image.height)});
      if (w.y > 0) image.at(x, y) = skyRadiance(daylight, w);
    }
  if (!daylight.hasSun) return image;
  PaintedLamp sun;
  sun.direction = daylight.sunDirection;
  sun.width = kSunDiameter * daylight.sunRadiusScale;
  const double widening = (1 - std::cos(sun.width / 2)) / (1 - std::cos(kSunDiameter / 2));
  sun.radiance = sunRadiance(daylight) * float(1 / widening);
  addLamp(sun, image);
  return image;
}

}  // namespace pt
