#include <fmt/format.h>

#include <functional>

#include "core/near_name.h"
#include "loaders/json_parts.h"
#include "loaders/refraction_index.h"
#include "materials/conductor_presets.h"

namespace pt::json {
namespace {

using Kind = decltype(MaterialDescription::kind);

std::vector<std::string> keysOf(const auto& map) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : map) keys.push_back(key);
  return keys;
}

/// A number or a substance's name.
float readIndex(ObjectReader& reader, const std::string& key, const char* fallback) {
  const auto value = reader.find(key);
  if (!value) return *findRefractionIndex(fallback);
  if (!value->isString()) return value->positive();
  const auto index = findRefractionIndex(value->string());
  if (!index)
    value->fail(fmt::format("'{}' is no known substance{}", value->string(),
                            suggestName(value->string(), refractionIndexNames())));
  return *index;
}

/// Rough where "alpha" is given.
std::optional<Roughness> readRoughness(ObjectReader& reader) {
  const auto alpha = reader.find("alpha");
  const auto distribution = reader.find("distribution");
  const auto sampleVisible = reader.find("sampleVisible");
  if (!alpha) {
    if (distribution) distribution->fail("needs a roughness: give 'alpha' too");
    if (sampleVisible) sampleVisible->fail("needs a roughness: give 'alpha' too");
    return std::nullopt;
  }
  Roughness roughness;
  roughness.alpha = alpha->positive();
  roughness.distribution = static_cast<MicrofacetDistribution>(reader.choice("distribution", {"beckmann", "ggx"}, 1));
  roughness.sampleVisible = reader.boolean("sampleVisible", true);
  return roughness;
}

Kind readDiffuse(Context&, ObjectReader& reader) {
  return DiffuseMaterial{reader.color("reflectance", Spectrum(0.5f))};
}

Kind readConductor(Context&, ObjectReader& reader) {
  ConductorMaterial conductor;
  const auto eta = reader.find("eta"), k = reader.find("k"), preset = reader.find("preset");
  if (preset && (eta || k)) preset->fail("excludes eta and k: give one or the other");
  if (eta || k) {
    conductor.eta = reader.require("eta").color();
    conductor.k = reader.require("k").color();
  } else {
    const std::string name = preset ? preset->string() : "none";
    const auto found = findConductorPreset(name);
    if (!found) preset->fail(fmt::format("'{}' is no known conductor; give eta and k instead", name));
    conductor.eta = found->eta;
    conductor.k = found->k;
  }
  const float exterior = readIndex(reader, "extIor", "vacuum");
  conductor.eta /= exterior;
  conductor.k /= exterior;
  conductor.specularReflectance = reader.color("specularReflectance", Spectrum(1.0f));
  conductor.roughness = readRoughness(reader);
  return conductor;
}

template <class Dielectric>
Dielectric readDielectricBase(ObjectReader& reader) {
  Dielectric dielectric;
  dielectric.intIor = readIndex(reader, "intIor", "bk7");
  dielectric.extIor = readIndex(reader, "extIor", "air");
  dielectric.specularReflectance = reader.color("specularReflectance", Spectrum(1.0f));
  dielectric.specularTransmittance = reader.color("specularTransmittance", Spectrum(1.0f));
  return dielectric;
}

Kind readDielectric(Context&, ObjectReader& reader) {
  auto dielectric = readDielectricBase<DielectricMaterial>(reader);
  dielectric.roughness = readRoughness(reader);
  return dielectric;
}

Kind readThinDielectric(Context&, ObjectReader& reader) {
  return readDielectricBase<ThinDielectricMaterial>(reader);
}

Kind readPlastic(Context&, ObjectReader& reader) {
  PlasticMaterial plastic;
  plastic.intIor = readIndex(reader, "intIor", "polypropylene");
  plastic.extIor = readIndex(reader, "extIor", "air");
  plastic.diffuseReflectance = reader.color("diffuseReflectance", Spectrum(0.5f));
  plastic.specularReflectance = reader.color("specularReflectance", Spectrum(1.0f));
  plastic.nonlinear = reader.boolean("nonlinear", false);
  plastic.roughness = readRoughness(reader);
  return plastic;
}

Kind readTwoSided(Context& context, ObjectReader& reader) {
  TwoSidedMaterial twoSided;
  twoSided.front = readMaterial(context, reader.require("front"));
  const auto back = reader.find("back");
  twoSided.back = back ? readMaterial(context, *back) : twoSided.front;
  return twoSided;
}

const std::map<std::string, std::function<Kind(Context&, ObjectReader&)>> kReaders = {
    {"diffuse", readDiffuse},       {"conductor", readConductor},
    {"dielectric", readDielectric}, {"thinDielectric", readThinDielectric},
    {"plastic", readPlastic},       {"twoSided", readTwoSided},
};

int readMaterialObject(Context& context, const Node& node, const std::string& name) {
  ObjectReader reader(node);
  const Node type = reader.require("type");
  const auto found = kReaders.find(type.string());
  if (found == kReaders.end())
    type.fail(fmt::format("'{}' is no known material{}", type.string(), suggestName(type.string(), keysOf(kReaders))));
  MaterialDescription material{name, found->second(context, reader), node.source()};
  if (std::holds_alternative<DielectricMaterial>(material.kind))
    material.absorption = reader.color("absorption", material.absorption);
  reader.finish();
  context.scene.materials.push_back(std::move(material));
  return static_cast<int>(context.scene.materials.size()) - 1;
}

}  // namespace

int readMaterial(Context& context, const Node& node) {
  if (!node.isString()) return readMaterialObject(context, node, {});
  const std::string& name = node.string();
  const auto described = context.materialNodes.find(name);
  if (described == context.materialNodes.end())
    node.fail(fmt::format("there is no material '{}'{}", name, suggestName(name, keysOf(context.materialNodes))));
  const auto [known, isNew] = context.materials.emplace(name, kNone);
  if (isNew) {
    known->second = readMaterialObject(context, described->second, name);
  } else if (known->second == kNone) {
    node.fail(fmt::format("the material '{}' contains itself", name));
  }
  return known->second;
}

}  // namespace pt::json
