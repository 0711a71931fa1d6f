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

/// Asks each kind of material, and each material once: others may contain it at many places.
class TextureUse {
 public:
  explicit TextureUse(const SceneDescription& description)
      : m_description(description), m_known(description.materials.size()) {}

  bool operator()(int material) {
    std::optional<bool>& known = m_known[std::size_t(material)];
    if (!known) known = std::visit(*this, m_description.materials[std::size_t(material)].kind);
    return *known;
  }

  bool operator()(const DiffuseMaterial& m) { return textured(m.reflectance); }
  bool operator()(const RoughDiffuseMaterial& m) { return textured(m.reflectance) || textured(m.alpha); }
  bool operator()(const ConductorMaterial& m) { return textured(m.specularReflectance) || textured(m.roughness); }
  bool operator()(const DielectricMaterial& m) {
    return textured(m.specularReflectance) || textured(m.specularTransmittance) || textured(m.roughness);
  }
  bool operator()(const ThinDielectricMaterial& m) {
    return textured(m.specularReflectance) || textured(m.specularTransmittance);
  }
  bool operator()(const PlasticMaterial& m) {
    return textured(m.diffuseReflectance) || textured(m.specularReflectance) || textured(m.roughness);
  }
  bool operator()(const TwoSidedMaterial& m) { return (*this)(m.front) || (*this)(m.back); }
  bool operator()(const NullMaterial&) { return false; }
  bool operator()(const BlendMaterial& m) { return textured(m.weight) || (*this)(m.first) || (*this)(m.second); }
  bool operator()(const BumpMaterial&) { return true; }
  bool operator()(const NormalMapMaterial&) { return true; }
  bool operator()(const PrincipledMaterial& m) {
    return m.anisotropy != 0 || textured(m.baseColor) || textured(m.metallic) || textured(m.roughness) ||
           textured(m.specular) || textured(m.transmission) || textured(m.sheen) || textured(m.clearcoat) ||
           textured(m.clearcoatRoughness);
  }
  bool operator()(const MaskMaterial& m) { return textured(m.opacity) || (*this)(m.material); }

 private:
  const SceneDescription& m_description;
  std::vector<std::optional<bool>> m_known;
};

}  // namespace

std::vector<bool> findTextured(const SceneDescription& description) {
  TextureUse usesTexture(description);
  std::vector<bool> found;
  for (int i = 0; i < int(description.materials.size()); ++i) found.push_back(usesTexture(i));
  return found;
}

bool needsUvs(const std::vector<bool>& texturedMaterials, const ShapeDescription& shape) {
  const bool byMaterial = shape.material != kNone && texturedMaterials[std::size_t(shape.material)];
  return byMaterial || (shape.emission && textured(*shape.emission));
}

}  // namespace pt
