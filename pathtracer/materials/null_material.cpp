#include "materials/make_material.h"

namespace pt {

namespace {

/// A surface that is not there.
class Null final : public Material {
 public:
  Null() : Material({.hasDelta = true, .transmits = true}) {}

  BsdfEvaluation evaluate(const SurfaceInteraction&, const Vec3&, const Vec3&) const noexcept override {
    return {Spectrum(0.0f), 0};
  }
  BsdfSample sample(const SurfaceInteraction&, const Vec3& wo, float, const Vec2&) const noexcept override {
    return {.wi = -wo, .weight = Spectrum(1.0f), .pdf = 1, .isDelta = true};
  }
  Spectrum albedo(const SurfaceInteraction&) const noexcept override { return Spectrum(1.0f); }
};

}  // namespace

std::unique_ptr<Material> makeNull() {
  return std::make_unique<Null>();
}

}  // namespace pt
