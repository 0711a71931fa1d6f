#include <fmt/format.h>

#include "core/error.h"
#include "materials/make_material.h"
#include "materials/material_parts.h"

namespace pt {

namespace {

/// Makes each material after those inside it.
class MaterialBuilder {
 public:
  MaterialBuilder(const SceneDescription& description, const TextureSet& textures)
      : m_description(description),
        m_textures(textures),
        m_materials(description.materials.size()),
        m_parts(description.materials.size(), 1),
        m_isBegun(description.materials.size()) {}

  std::vector<std::unique_ptr<Material>> build() {
    for (std::size_t i = 0; i < m_materials.size(); ++i)
      if (!m_materials[i]) make(i);
    return std::move(m_materials);
  }

 private:
  using Result = std::unique_ptr<Material>;

  /// A material that is being made.
  struct Open {
    std::size_t index;
    std::vector<const Material*> inside;
  };

  void make(std::size_t index) {
    const MaterialDescription& material = m_description.materials[index];
    m_isBegun[index] = true;
    const Parameters parameters(material.source, m_textures);
    m_open.push_back({index, {}});
    if (int(m_open.size()) > kMostMaterialParts) failOfParts(m_open.front().index);
    m_materials[index] = std::visit([&](const auto& kind) { return make(kind, parameters); }, material.kind);
    m_materials[index]->setAbsorption(absorption(material, *m_materials[index], parameters));
    m_open.pop_back();
  }

  /// Of the medium behind a surface; one without its own has that of the materials inside it.
  Spectrum absorption(const MaterialDescription& material, const Material& made, const Parameters& parameters) const {
    Spectrum found = parameters.nonNegative(material.absorption, "absorption coefficient");
    if (!isBlack(found)) {
      if (!made.traits().transmits)
        parameters.fail("a medium is of no use behind a surface that lets no light through");
      return found;
    }
    for (const Material* inside : m_open.back().inside) {
      if (isBlack(inside->absorption())) continue;
      if (!isBlack(found) && found != inside->absorption())
        parameters.fail("two materials of different absorption cannot be blended; give both the same");
      found = inside->absorption();
    }
    return found;
  }

  Result make(const DiffuseMaterial& m, const Parameters& p) { return makeDiffuse(m, p); }
  Result make(const RoughDiffuseMaterial& m, const Parameters& p) { return makeRoughDiffuse(m, p); }
  Result make(const ConductorMaterial& m, const Parameters& p) { return makeConductor(m, p); }
  Result make(const DielectricMaterial& m, const Parameters& p) { return makeDielectric(m, p); }
  Result make(const ThinDielectricMaterial& m, const Parameters& p) { return makeThinDielectric(m, p); }
  Result make(const PlasticMaterial& m, const Parameters& p) { return makePlastic(m, p, m_cache); }
  Result make(const NullMaterial&, const Parameters&) { return makeNull(); }
  Result make(const MaskMaterial& m, const Parameters& p) { return makeMask(nested(m.material, p), m, p); }
  Result make(const BumpMaterial& m, const Parameters& p) { return makeBump(nested(m.material, p), m, p); }
  Result make(const NormalMapMaterial& m, const Parameters& p) { return makeNormalMap(nested(m.material, p), m, p); }
  Result make(const PrincipledMaterial& m, const Parameters& p) { return makePrincipled(m, p); }
  Result make(const BlendMaterial& m, const Parameters& p) {
    const Material& first = nested(m.first, p);
    return makeBlend(first, nested(m.second, p), m, p);
  }
  Result make(const TwoSidedMaterial& m, const Parameters& p) {
    const Material& front = nested(resolveSide(m.front, p), p);
    return makeTwoSided(front, nested(resolveSide(m.back, p), p), p);
  }

  /// The material that another one contains.
  const Material& nested(int index, const Parameters& user) {
    const std::size_t i = checked(index, user);
    if (!m_materials[i]) {
      if (m_isBegun[i]) user.fail("materials contain each other in a circle");
      make(i);
    }
    Open& outer = m_open.back();
    outer.inside.push_back(m_materials[i].get());
    m_parts[outer.index] += m_parts[i];
    if (m_parts[outer.index] > kMostMaterialParts) failOfParts(outer.index);
    return *m_materials[i];
  }

  [[noreturn]] void failOfParts(std::size_t index) const {
    const MaterialDescription& material = m_description.materials[index];
    throw InputError(
        fmt::format("{}: the material \"{}\" consists of more than {} materials, one inside the other; use fewer",
                    material.source, material.name, kMostMaterialParts));
  }

  /// The one-sided material that a side of a two-sided one names. A two-sided material as a side shows its own front.
  int resolveSide(int side, const Parameters& user) const {
    for (int step = 0; step < kMostMaterialParts; ++step) {
      const auto* twoSided = std::get_if<TwoSidedMaterial>(&m_description.materials[checked(side, user)].kind);
      if (!twoSided) return side;
      side = twoSided->front;
    }
    user.fail("two-sided materials name each other in a circle, or too many times");
  }

  std::size_t checked(int index, const Parameters& user) const {
    if (index < 0 || std::size_t(index) >= m_materials.size())
      user.fail(fmt::format("the material inside is number {}, which does not exist", index));
    return std::size_t(index);
  }

  const SceneDescription& m_description;
  const TextureSet& m_textures;
  RoughTransmittanceCache m_cache;
  std::vector<std::unique_ptr<Material>> m_materials;
  std::vector<int> m_parts;  ///< of those that are made, themselves included; one that is used twice counts twice
  std::vector<bool> m_isBegun;
  std::vector<Open> m_open;  ///< the innermost last
};

}  // namespace

std::vector<std::unique_ptr<Material>> createMaterials(const SceneDescription& description,
                                                       const TextureSet& textures) {
  return MaterialBuilder(description, textures).build();
}

}  // namespace pt
