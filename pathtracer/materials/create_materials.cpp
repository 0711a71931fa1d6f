#include <fmt/format.h>

#include "materials/make_material.h"

namespace pt {

namespace {

struct MakeMaterial {
  const Parameters& parameters;
  RoughTransmittanceCache& cache;

  using Result = std::unique_ptr<Material>;
  Result operator()(const DiffuseMaterial& m) const { return makeDiffuse(m, parameters); }
  Result operator()(const ConductorMaterial& m) const { return makeConductor(m, parameters); }
  Result operator()(const DielectricMaterial& m) const { return makeDielectric(m, parameters); }
  Result operator()(const ThinDielectricMaterial& m) const { return makeThinDielectric(m, parameters); }
  Result operator()(const PlasticMaterial& m) const { return makePlastic(m, parameters, cache); }
  /// Made later, when its sides exist.
  Result operator()(const TwoSidedMaterial&) const { return nullptr; }
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
  RoughTransmittanceCache cache;
  for (const MaterialDescription& m : description.materials)
    materials.push_back(std::visit(MakeMaterial{Parameters(m.source), cache}, m.kind));

  for (std::size_t i = 0; i < materials.size(); ++i) {
    const MaterialDescription& m = description.materials[i];
    const auto* twoSided = std::get_if<TwoSidedMaterial>(&m.kind);
    if (!twoSided) continue;
    const Parameters parameters(m.source);
    const int front = resolveSide(description, twoSided->front, parameters);
    const int back = resolveSide(description, twoSided->back, parameters);
    materials[i] = makeTwoSided(*materials[front], *materials[back], parameters);
  }
  return materials;
}

}  // namespace pt
