#include "synthetic/light_field.h"

namespace bench {

float LightField::radiance(const Imath::V3f& position, const Imath::V3f& wi) const noexcept {
  float sum = background;
  for (const SphericalLight& light : lights) {
    const Imath::V3f toCenter = light.center - position;
    const float along = toCenter.dot(wi);
    const float missed2 = toCenter.length2() - along * along;
    if (along > 0 && missed2 < light.radius * light.radius) sum += light.radiance;
  }
  return sum;
}

LightField nearLights() {
  LightField field;
  field.lights = {{{0.5f, 0.5f, 1.4f}, 0.15f, 20},
                  {{-0.3f, 0.2f, 0.6f}, 0.1f, 30},
                  {{1.3f, 0.9f, 0.3f}, 0.2f, 10},
                  {{0.6f, -0.5f, 0.1f}, 0.05f, 100}};
  field.background = 0.1f;
  return field;
}

}  // namespace bench
