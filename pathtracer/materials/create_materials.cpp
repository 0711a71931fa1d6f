#include <fmt/format.h>

#include "materials/make_material.h"

namespace pt {

namespace {

struct MakeMaterial {
  const Parameters& parameters;

  std::unique_ptr<Material> operator()(const DiffuseMaterial& m) const { return makeDiffuse(m, parameters); }
  /// Made later, when its sides exist.
  std::unique_ptr<Material> operator()(const TwoSidedMaterial&) const { return nullptr; }
  template <class Kind>
  std::unique_ptr<Material> operator()(const Kind&) const {
    parameters.fail("only diffuse and two-sided materials are built yet");
  }
};

/// The one-sided material that a side of a two-sided one names. A two-sided material as a side shows its own front.
int resolveSide(const SceneDescription& description, int side, const Parameters& parameters) {
  for (std::size_t step = 0; step <= description.materials.size(); ++step) {
    if (side < 0 || std::size_t(side) >= description.materials.size())
      parameters.fail(fmt::format("a two-sided material names material {}, which does not exist", side));
    const auto* nested = std::get_if<TwoSidedMaterial>(&description.materials[side].kind);
    if (!nested) return side;
    side = nested->front;
  }
  parameters.fail("two-sided materials name each other in a circle");
}

}  // namespace

std::vector<std::unique_ptr<Material>> createMaterials(const SceneDescription& description) {
  std::vector<std::unique_ptr<Material>> materials;
  materials.reserve(description.materials.size());
  for (const MaterialDescription& m : description.materials)
    materials.push_back(std::visit(MakeMaterial{Parameters(m.source)}, m.kind));

  for (std::size_t i = 0; i < materials.size(); ++i) {
    const MaterialDescription& m = description.materials[i];
    const auto* twoSided = std::get_if<TwoSidedMaterial>(&m.kind);
    if (!twoSided) continue;
    const Parameters parameters(m.source);
    materials[i] = makeTwoSided(*materials[resolveSide(description, twoSided->front, parameters)],
                                *materials[resolveSide(description, twoSided->back, parameters)], parameters);
  }
  return materials;
}

}  // namespace pt
