#include "scene/texture_use.h"

namespace pt {
namespace {

bool textured(const SpectrumParameter& p) {
  return p.texture != kNone;
}
bool textured(const FloatParameter& p) {
  return p.texture != kNone;
}
/// Highlights that are stretched follow the texture coordinates.
bool textured(const std::optional<Roughness>& roughness) {
  return roughness && (textured(roughness->alpha) || roughness->alphaV);
}

/// Asks each kind of material; nested ones are asked through the description.
struct TextureUse {
  const SceneDescription& description;

  bool operator()(const DiffuseMaterial& m) const { return textured(m.reflectance); }
  bool operator()(const RoughDiffuseMaterial& m) const { return textured(m.reflectance) || textured(m.alpha); }
  bool operator()(const ConductorMaterial& m) const { return textured(m.specularReflectance) || textured(m.roughness); }
  bool operator()(const DielectricMaterial& m) const {
    return textured(m.specularReflectance) || textured(m.specularTransmittance) || textured(m.roughness);
  }
  bool operator()(const ThinDielectricMaterial& m) const {
    return textured(m.specularReflectance) || textured(m.specularTransmittance);
  }
  bool operator()(const PlasticMaterial& m) const {
    return textured(m.diffuseReflectance) || textured(m.specularReflectance) || textured(m.roughness);
  }
  bool operator()(const TwoSidedMaterial& m) const {
    return usesTexture(description, m.front) || usesTexture(description, m.back);
  }
  bool operator()(const NullMaterial&) const { return false; }
  bool operator()(const BlendMaterial& m) const {
    return textured(m.weight) || usesTexture(description, m.first) || usesTexture(description, m.second);
  }
  bool operator()(const BumpMaterial&) const { return true; }
  bool operator()(const NormalMapMaterial&) const { return true; }
  bool operator()(const PrincipledMaterial& m) const {
    return m.anisotropy != 0 || textured(m.baseColor) || textured(m.metallic) || textured(m.roughness) ||
           textured(m.specular) || textured(m.transmission) || textured(m.sheen) || textured(m.clearcoat) ||
           textured(m.clearcoatRoughness);
  }
  bool operator()(const MaskMaterial& m) const { return textured(m.opacity) || usesTexture(description, m.material); }
};

}  // namespace

bool usesTexture(const SceneDescription& description, int material) {
  if (material == kNone) return false;
  return std::visit(TextureUse{description}, description.materials[std::size_t(material)].kind);
}

bool needsUvs(const SceneDescription& description, const ShapeDescription& shape) {
  return usesTexture(description, shape.material) || (shape.emission && textured(*shape.emission));
}

}  // namespace pt
