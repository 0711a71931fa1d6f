#include "loaders/sun_position.h"

namespace pt {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180;
constexpr double kEarthRadius = 6371.01, kAstronomicalUnit = 149597890;  // km

/// Days since noon of 1 January 2000, universal time.
double daysSince2000(const DateAndPlace& when, double utcHours) {
  const long beforeMarch = (when.month - 14) / 12;
  const long julianDay = (1461 * (when.year + 4800 + beforeMarch)) / 4 +
                         (367 * (when.month - 2 - 12 * beforeMarch)) / 12 -
                         (3 * ((when.year + 4900 + beforeMarch) / 100)) / 4 + when.day - 32075;
  return double(julianDay) - 0.5 + utcHours / 24 - 2451545;
}

}  // namespace

Vec3 sunDirection(const DateAndPlace& when) {
  const double utcHours = when.hour - when.timezone + (when.minute + when.second / 60) / 60;
  const double days = daysSince2000(when, utcHours);

  // Ecliptic coordinates
  const double omega = 2.1429 - 0.0010394594 * days;
  const double meanLongitude = 4.8950630 + 0.017202791698 * days;
  const double anomaly = 6.2400600 + 0.0172019699 * days;
  const double longitude = meanLongitude + 0.03341607 * std::sin(anomaly) + 0.00034894 * std::sin(2 * anomaly) -
                           0.0001134 - 0.0000203 * std::sin(omega);
  const double obliquity = 0.4090928 - 6.2140e-9 * days + 0.0000396 * std::cos(omega);

  // Celestial coordinates
  const double rightAscension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
  const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));

  // Horizontal coordinates
  const double greenwichSiderealHours = 6.6974243242 + 0.0657098283 * days + utcHours;
  const double hourAngle = (greenwichSiderealHours * 15 + when.longitude) * kRadians - rightAscension;
  const double latitude = when.latitude * kRadians;
  const double zenith = std::acos(std::cos(latitude) * std::cos(hourAngle) * std::cos(declination) +
                                  std::sin(declination) * std::sin(latitude));
  const double azimuth = std::atan2(
      -std::sin(hourAngle), std::tan(declination) * std::cos(latitude) - std::sin(latitude) * std::cos(hourAngle));
  const double seenZenith = zenith + kEarthRadius / kAstronomicalUnit * std::sin(zenith);  // parallax
  return Vec3(float(std::sin(azimuth) * std::sin(seenZenith)), float(std::cos(seenZenith)),
              float(-std::cos(azimuth) * std::sin(seenZenith)));
}

}  // namespace pt
