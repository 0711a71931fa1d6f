#include "loaders/painted_environment.h"

#include <guiding/environment_layout.h>

namespace pt {
namespace {

constexpr int kSubsamples = 8;  // per axis of a texel

/// Where a lamp is on the sphere.
class LampOutline {
 public:
  explicit LampOutline(const PaintedLamp& lamp)
      : m_direction(lamp.direction),
        m_isDisk(lamp.height == 0),
        m_width(lamp.width),
        m_height(lamp.height),
        m_chord(float(2 * std::sin(lamp.width / 4))),
        m_tangents(float(std::tan(lamp.width / 2)), float(std::tan(lamp.height / 2))) {
    const Vec3 up = std::abs(m_direction.y) < 0.999f ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    m_right = m_direction.cross(up).normalized();
    m_up = m_right.cross(m_direction);
  }

  bool contains(const Vec3& w) const {
    if (m_isDisk) return (w - m_direction).length() <= m_chord;
    const float along = w.dot(m_direction);
    return along > 0 && std::abs(w.dot(m_right)) <= m_tangents.x * along &&
           std::abs(w.dot(m_up)) <= m_tangents.y * along;
  }

  double solidAngle() const {
    return m_isDisk ? 2 * double(kPi) * (1 - std::cos(m_width / 2))
                    : 4 * std::asin(std::sin(m_width / 2) * std::sin(m_height / 2));
  }

 private:
  Vec3 m_direction, m_right, m_up;
  bool m_isDisk;
  double m_width, m_height;
  float m_chord;    ///< between the middle and the edge of a disk
  Vec2 m_tangents;  ///< of a rectangle's half sides
};

/// Calls visit(direction, solid angle, texel) for the subsamples of every texel.
template <class Visit>
void forEachSubsample(const guiding::EnvironmentLayout& layout, Visit&& visit) {
  for (int y = 0; y < layout.height() * kSubsamples; ++y) {
    const float v = (float(y) + 0.5f) / float(layout.height() * kSubsamples);
    const double solidAngle = 4 * double(kPi) * layout.texelShare(y / kSubsamples) / (kSubsamples * kSubsamples);
    for (int x = 0; x < layout.width() * kSubsamples; ++x)
      visit(layout.toDirection({(float(x) + 0.5f) / float(layout.width() * kSubsamples), v}), solidAngle,
            std::size_t(y / kSubsamples) * std::size_t(layout.width()) + std::size_t(x / kSubsamples));
  }
}

void paintSky(const PaintedEnvironment& environment, const guiding::EnvironmentLayout& layout, Image& image) {
  for (int y = 0; y < image.height; ++y) {
    const float elevation = layout.toDirection({0, (float(y) + 0.5f) / float(image.height)}).y;
    const Spectrum colour = elevation < 0
                                ? environment.ground
                                : environment.horizon + (environment.zenith - environment.horizon) * elevation;
    for (int x = 0; x < image.width; ++x) image.at(x, y) = colour;
  }
}

}  // namespace

void addLamp(const PaintedLamp& lamp, Image& image) {
  const guiding::EnvironmentLayout layout(guiding::EnvironmentMapping::LatLong, image.width, image.height);
  const LampOutline outline(lamp);
  const std::size_t middle = [&] {
    const Vec2 uv = layout.toPicture(lamp.direction);
    const int x = std::min(int(uv.x * float(image.width)), image.width - 1);
    const int y = std::min(int(uv.y * float(image.height)), image.height - 1);
    return std::size_t(y) * std::size_t(image.width) + std::size_t(x);
  }();
  std::vector<double> covered(image.pixels.size());  // solid angle
  double sum = 0;
  forEachSubsample(layout, [&](const Vec3& w, double solidAngle, std::size_t texel) {
    if (!outline.contains(w)) return;
    covered[texel] += solidAngle;
    sum += solidAngle;
  });
  if (sum == 0) sum = covered[middle] = outline.solidAngle();
  const double scale = outline.solidAngle() / sum;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    const double texel = 4 * double(kPi) * layout.texelShare(int(i / std::size_t(image.width)));
    image.pixels[i] += lamp.radiance * float(covered[i] * scale / texel);
  }
}

Image paint(const PaintedEnvironment& environment) {
  Image image(environment.width, environment.height);
  const guiding::EnvironmentLayout layout(guiding::EnvironmentMapping::LatLong, image.width, image.height);
  paintSky(environment, layout, image);
  for (const PaintedLamp& lamp : environment.lamps) addLamp(lamp, image);
  return image;
}

}  // namespace pt
