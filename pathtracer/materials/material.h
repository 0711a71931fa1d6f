#pragma once

#include <guiding/lobes.h>
#include <guiding/mixture.h>

#include <memory>
#include <vector>

#include "core/types.h"
#include "scene/interaction.h"
#include "scene/scene_description.h"

namespace pt {

class TextureSet;

/// Value and density for a pair of directions; delta lobes take no part.
using BsdfEvaluation = guiding::BsdfEvaluation<Spectrum>;

/// A sampled direction, local frame.
struct BsdfSample {
  Vec3 wi;
  Spectrum weight{0.0f};  ///< BSDF * |cos| / pdf
  float pdf = 0;  ///< per solid angle (the density evaluate() returns); for a delta lobe the probability of choosing
                  ///< it; 0: the sample failed
  bool isDelta = false;
};

/// A BSDF whose parameters may vary over the surface. Directions are in the local shading frame, wo towards the camera,
/// wi towards the light; values carry radiance and include |cos(wi)| and, for refraction, Mitsuba's 1/eta^2. Immutable,
/// thread-safe.
class Material {
 public:
  /// What the material can do, known when it is built.
  struct Traits {
    bool hasSmooth = false;
    bool hasDelta = false;
    bool transmits = false;
    bool needsTangents = false;  ///< reads si.dpdu and dpdv, or tells frame.s from others
    float eta = 1;  ///< index of refraction behind the surface over the one before it (the side of the normal); 1 where
                    ///< no ray bends
  };

  virtual ~Material() = default;

  const Traits& traits() const noexcept { return m_traits; }

  /// Absorption coefficient of the medium behind the surface, per unit of length; 0: clear.
  const Spectrum& absorption() const noexcept { return m_absorption; }
  void setAbsorption(const Spectrum& absorption) noexcept { m_absorption = absorption; }

  /// Relative index of refraction that a scattering from wo to wi crosses; 1 for reflection. Told by the sides alone,
  /// so that it also holds for directions that the material did not sample itself.
  float etaCrossed(const Vec3& wo, const Vec3& wi) const noexcept {
    if (wo.z * wi.z >= 0) return 1;
    return wo.z > 0 ? m_traits.eta : 1 / m_traits.eta;
  }

  /// Smooth lobes only.
  virtual BsdfEvaluation evaluate(const SurfaceInteraction& si, const Vec3& wo, const Vec3& wi) const noexcept = 0;

  /// uLobe in [0,1) chooses among lobes, u in [0,1)^2 the direction.
  virtual BsdfSample sample(const SurfaceInteraction& si, const Vec3& wo, float uLobe,
                            const Vec2& u) const noexcept = 0;

  /// Adds a rough description of the smooth lobes seen from wo, local frame, for the guide to multiply with. A material
  /// that cannot tell adds nothing.
  virtual void describeLobes(const SurfaceInteraction&, const Vec3&, guiding::LobeSet&) const noexcept {}

  /// Total reflectance for a denoiser's albedo layer, in [0, 1].
  virtual Spectrum albedo(const SurfaceInteraction& si) const noexcept = 0;

 protected:
  explicit Material(const Traits& traits) : m_traits(traits) {}

 private:
  Traits m_traits;
  Spectrum m_absorption{0.0f};
};

/// One Material per description, in order; the textures outlive them. Throws InputError (with the description's source)
/// for impossible parameters.
std::vector<std::unique_ptr<Material>> createMaterials(const SceneDescription& description, const TextureSet& textures);

}  // namespace pt
