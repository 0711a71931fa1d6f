#include "scene/texture_use.h"

namespace pt {
namespace {

bool textured(const SpectrumParameter& p) {
  return p.texture != kNone;
}
bool textured(const std::optional<Roughness>& roughness) {
  return roughness && roughness->alpha.texture != kNone;
}

/// Asks each kind of material; nested ones are asked through the description.
struct TextureUse {
  const SceneDescription& description;

  bool operator()(const DiffuseMaterial& m) const { return textured(m.reflectance); }
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
