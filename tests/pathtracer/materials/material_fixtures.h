#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "materials/material.h"
#include "statistics/chi_square.h"
#include "statistics/quadrature.h"
#include "textures/texture_set.h"

/// Materials by description, for tests of BSDFs.
namespace test {

/// One built material, with those it refers to.
class BuiltMaterial {
 public:
  explicit BuiltMaterial(const decltype(pt::MaterialDescription::kind)& kind) : BuiltMaterial({}, kind) {}
  /// The textures are boards of which SurfaceInteraction() meets the first colour: grey 0.4, and grey 0.2.
  BuiltMaterial(std::vector<pt::MaterialDescription> others, const decltype(pt::MaterialDescription::kind)& kind) {
    pt::SceneDescription description;
    for (const float grey : {0.4f, 0.2f})
      description.textures.push_back({pt::CheckerboardTexture{pt::Spectrum(grey), pt::Spectrum(0.7f)}, {}, "test"});
    description.materials = std::move(others);
    description.materials.push_back({"tested", kind, "test#/materials/0"});
    m_textures = pt::TextureSet(description);
    m_materials = pt::createMaterials(description, m_textures);
  }

  const pt::Material& operator*() const { return *m_materials.back(); }
  const pt::Material* operator->() const { return m_materials.back().get(); }

 private:
  pt::TextureSet m_textures;
  std::vector<std::unique_ptr<pt::Material>> m_materials;
};

struct NamedMaterial {
  std::string name;
  decltype(pt::MaterialDescription::kind) kind;
  bool reflectsOnly = true;
  std::vector<pt::MaterialDescription> others = {};  ///< that `kind` contains

  BuiltMaterial build() const { return BuiltMaterial(others, kind); }
};

inline pt::Roughness rough(float alpha, pt::MicrofacetDistribution distribution, bool sampleVisible = true) {
  return {alpha, distribution, sampleVisible, {}};
}

/// Each of its layers alone, and all together.
inline std::vector<pt::PrincipledMaterial> principledMaterials() {
  std::vector<pt::PrincipledMaterial> all(1);
  const auto add = [&]() -> pt::PrincipledMaterial& {
    all.emplace_back().baseColor = pt::Spectrum(0.8f, 0.5f, 0.2f);
    return all.back();
  };
  add().roughness = 0.3f;
  add().metallic = 1;
  add().transmission = 1;
  add().sheen = pt::Spectrum(1.0f, 0.3f, 0.6f);
  pt::PrincipledMaterial& coated = add();
  coated.clearcoat = 1;
  coated.clearcoatRoughness = 0.3f;
  pt::PrincipledMaterial& thin = add();
  thin.transmission = 0.7f;
  thin.thin = true;
  pt::PrincipledMaterial& textured = add();
  textured.baseColor = {pt::Spectrum(1.0f), 0};
  textured.metallic = {1.0f, 1};
  textured.roughness = {1.2f, 0};
  pt::PrincipledMaterial& everything = add();
  everything.metallic = 0.3f;
  everything.anisotropy = 0.8f;
  everything.specular = pt::Spectrum(0.9f, 0.4f, 1.0f);
  everything.transmission = 0.5f;
  everything.sheen = 0.5f;
  everything.clearcoat = 0.6f;
  everything.clearcoatRoughness = 0.5f;
  return all;
}

/// Every kind that has a smooth lobe, over roughnesses and settings.
inline std::vector<NamedMaterial> smoothLobeMaterials() {
  using enum pt::MicrofacetDistribution;
  const pt::Spectrum eta(0.2f, 0.92f, 1.1f), k(3.9f, 2.45f, 2.14f);
  std::vector<NamedMaterial> all;
  all.push_back({"diffuse", pt::DiffuseMaterial{pt::Spectrum(0.2f, 0.5f, 0.9f)}});
  all.push_back({"plastic", pt::PlasticMaterial{1.5f, 1.0f, pt::Spectrum(0.5f, 0.2f, 0.7f), 1.0f, false, {}}});
  for (const auto distribution : {Ggx, Beckmann}) {
    const std::string d = distribution == Ggx ? "GGX" : "Beckmann";
    for (const float alpha : {0.05f, 0.2f, 0.7f}) {
      for (const bool visible : {true, false}) {
        if (!visible && alpha < 0.1f) continue;
        const std::string suffix = " " + d + " " + std::to_string(alpha) + (visible ? " visible" : " all");
        const pt::Roughness r = rough(alpha, distribution, visible);
        all.push_back({"conductor" + suffix, pt::ConductorMaterial{eta, k, 1.0f, r}});
        all.push_back({"dielectric" + suffix, pt::DielectricMaterial{1.5f, 1.0f, 1.0f, 1.0f, r}, false});
        all.push_back({"plastic" + suffix, pt::PlasticMaterial{1.5f, 1.0f, 0.5f, 1.0f, alpha > 0.1f, r}});
      }
    }
  }
  all.push_back({"rough diffuse", pt::RoughDiffuseMaterial{pt::Spectrum(0.2f, 0.5f, 0.9f), 0.7f, false}});
  all.push_back({"rough diffuse, fast", pt::RoughDiffuseMaterial{0.8f, 0.3f, true}});
  all.push_back({"textured diffuse", pt::DiffuseMaterial{{pt::Spectrum(0.5f, 1, 1), 0}}});
  const pt::Roughness texturedRoughness{{0.5f, 0}, Ggx, true, {}};
  all.push_back({"textured conductor", pt::ConductorMaterial{eta, k, {pt::Spectrum(1), 0}, texturedRoughness}});
  all.push_back({"textured dielectric",
                 pt::DielectricMaterial{1.5f, 1.0f, {pt::Spectrum(1), 0}, {pt::Spectrum(1), 1}, texturedRoughness},
                 false});
  all.push_back(
      {"textured plastic", pt::PlasticMaterial{1.5f, 1.0f, {pt::Spectrum(1), 0}, 1.0f, true, texturedRoughness}});
  all.push_back({"textured smooth plastic", pt::PlasticMaterial{1.5f, 1.0f, {pt::Spectrum(1), 0}, 0.5f, true, {}}});
  const std::vector<pt::MaterialDescription> glass = {
      {"glass", pt::DielectricMaterial{1.5f, 1.0f, 1.0f, 1.0f, rough(0.3f, Ggx)}, "inside"}};
  all.push_back({"mask", pt::MaskMaterial{0, 0.6f}, true, {{"coated", pt::PlasticMaterial{}, "inside"}}});
  all.push_back({"textured mask", pt::MaskMaterial{0, {0.8f, 0}}, true, {{"white", pt::DiffuseMaterial{}, "inside"}}});
  const std::vector<pt::MaterialDescription> pair = {
      {"metal", pt::ConductorMaterial{eta, k, 1.0f, rough(0.2f, Ggx)}, "inside"},
      {"coated", pt::PlasticMaterial{1.5f, 1.0f, 0.5f, 1.0f, false, {}}, "inside"}};
  all.push_back({"blend", pt::BlendMaterial{0, 1, 0.3f}, true, pair});
  all.push_back({"blend with black",
                 pt::BlendMaterial{0, 1, 0.8f},
                 true,
                 {{"black", pt::DiffuseMaterial{pt::Spectrum(0.0f)}, "inside"}, pair[1]}});
  all.push_back({"blend with glass",
                 pt::BlendMaterial{0, 1, {0.5f, 0}},
                 false,
                 {glass[0], {"chalk", pt::DiffuseMaterial{}, "inside"}}});
  for (const bool visible : {true, false}) {
    const std::string suffix = visible ? " visible" : " all";
    for (const auto distribution : {Ggx, Beckmann}) {
      const std::string d = distribution == Ggx ? "GGX" : "Beckmann";
      const pt::Roughness stretched{0.1f, distribution, visible, pt::FloatParameter(0.4f)};
      all.push_back({"stretched conductor " + d + suffix, pt::ConductorMaterial{eta, k, 1.0f, stretched}});
      all.push_back(
          {"stretched dielectric " + d + suffix, pt::DielectricMaterial{1.5f, 1.0f, 1.0f, 1.0f, stretched}, false});
    }
  }
  for (pt::PrincipledMaterial& m : principledMaterials())
    all.push_back({"principled " + std::to_string(all.size()), m, m.transmission.value == 0});
  all.push_back({"tinted dielectric", pt::DielectricMaterial{1.3f, 1.0f, 0.3f, 0.9f, rough(0.3f, Ggx)}, false});
  all.push_back({"dense exterior", pt::DielectricMaterial{1.0f, 1.4f, 1.0f, 1.0f, rough(0.3f, Beckmann)}, false});
  return all;
}

/// Unit direction at `degrees` from +z, in an oblique azimuth.
inline pt::Vec3 directionAt(float degrees, float azimuthDegrees = 25) {
  const float theta = degrees * pt::kPi / 180, phi = azimuthDegrees * pt::kPi / 180;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// Chi-square test of the smooth lobes of a material. Delta and failed draws count as failed samples.
inline ChiSquareResult chiSquareOfMaterial(const pt::Material& material, const pt::Vec3& wo,
                                           const ChiSquareSettings& settings,
                                           const pt::SurfaceInteraction& si = pt::SurfaceInteraction()) {
  const auto sample = [&](Random& random) -> std::optional<Imath::V3f> {
    const float uLobe = random.next1D();
    const pt::BsdfSample s = material.sample(si, wo, uLobe, random.next2D());
    if (s.isDelta || s.pdf == 0) return std::nullopt;
    return s.wi;
  };
  return chiSquareOnSphere(
      sample, [&](const Imath::V3f& wi) { return material.evaluate(si, wo, wi).pdf; }, settings);
}

/// Directional albedo: the mean over the channels of the integral of BSDF * cos over wi, smooth lobes.
inline double albedoOf(const pt::Material& material, const pt::Vec3& wo) {
  const pt::SurfaceInteraction si{};
  const auto f = [&](double phi, double theta) {
    const double s = std::sin(theta);
    const pt::Vec3 wi(float(s * std::cos(phi)), float(s * std::sin(phi)), float(std::cos(theta)));
    return pt::average(material.evaluate(si, wo, wi).bsdfCos) * s;
  };
  double sum = 0;
  constexpr int kPhi = 16, kTheta = 31;
  const double dPhi = 2 * M_PI / kPhi, dTheta = M_PI / kTheta;
  for (int i = 0; i < kPhi; ++i)
    for (int j = 0; j < kTheta; ++j) sum += integrate(f, dPhi * i, dPhi * (i + 1), dTheta * j, dTheta * (j + 1), 1e-7);
  return sum;
}

}  // namespace test
