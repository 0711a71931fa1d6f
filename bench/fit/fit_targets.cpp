#include "fit/fit.h"

namespace bench {

namespace {

using Shape = Light::Shape;

LightField nearLobes() {
  return {{{Shape::NearLobe, {0.5f, 0.5f, 1.5f}, 110, 10},
           {Shape::NearLobe, {-0.5f, 0.3f, 0.6f}, 110, 10},
           {Shape::NearLobe, {1.5f, 0.8f, 0.3f}, 110, 10},
           {Shape::NearLobe, {0.6f, -0.6f, 0.2f}, 110, 10},
           {Shape::Background, {0, 0, 1}, 0, 0.01f}}};
}

LightField nearCaps() {
  return {{{Shape::Ball, {0.5f, 0.5f, 1.5f}, 0.1f, 10},
           {Shape::Ball, {-0.5f, 0.3f, 0.6f}, 0.1f, 10},
           {Shape::Ball, {1.5f, 0.8f, 0.3f}, 0.1f, 10},
           {Shape::Ball, {0.6f, -0.6f, 0.2f}, 0.1f, 10},
           {Shape::Background, {0, 0, 1}, 0, 0.002f}}};
}

LightField soft() {
  return {{{Shape::FarLobe, Imath::V3f(0.3f, 0.5f, 0.8f).normalized(), 6, 3}, {Shape::Background, {0, 0, 1}, 0, 0.5f}}};
}

LightField manyCaps() {
  Random random(24);
  LightField field;
  for (int i = 0; i < 24; ++i) {
    const Imath::V3f center = Imath::V3f(0.5f) + random.nextDirection() * 1.4f;
    field.lights.push_back({Shape::Ball, center, 0.12f, 1 + 9 * random.next1D()});
  }
  field.lights.push_back({Shape::Background, {0, 0, 1}, 0, 0.005f});
  return field;
}

LightField sunAndSky() {
  const Imath::V3f sun = Imath::V3f(0.5f, 0.2f, 0.7f).normalized();
  return {{{Shape::FarLobe, sun, 3000, 2000},
           {Shape::Hemisphere, {0, 0, 1}, 0, 1},
           {Shape::Background, {0, 0, 1}, 0, 0.2f}}};
}

}  // namespace

std::vector<FitTarget> fitTargets() {
  return {{"4 near lobes", nearLobes()},
          {"4 near caps", nearCaps()},
          {"soft", soft()},
          {"24 caps", manyCaps()},
          {"sun and sky", sunAndSky()}};
}

}  // namespace bench
