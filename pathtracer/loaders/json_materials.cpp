#include <fmt/format.h>

#include <functional>

#include "core/near_name.h"
#include "loaders/json_parts.h"
#include "loaders/refraction_index.h"
#include "materials/conductor_presets.h"
#include "materials/material_parts.h"

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
std::optional<Roughness> readRoughness(Context& context, ObjectReader& reader) {
  const auto alpha = reader.find("alpha");
  const auto distribution = reader.find("distribution");
  const auto sampleVisible = reader.find("sampleVisible");
  const auto alphaV = reader.find("alphaV");
  if (!alpha) {
    if (alphaV) alphaV->fail("needs a roughness along u: give 'alpha' too");
    if (distribution) distribution->fail("needs a roughness: give 'alpha' too");
    if (sampleVisible) sampleVisible->fail("needs a roughness: give 'alpha' too");
    return std::nullopt;
  }
  Roughness roughness;
  roughness.alpha = alpha->isNumber() ? alpha->positive() : readNumber(context, reader, "alpha", 0);
  if (alphaV) roughness.alphaV = readNumber(context, reader, "alphaV", 0);
  roughness.distribution = static_cast<MicrofacetDistribution>(reader.choice("distribution", {"beckmann", "ggx"}, 1));
  roughness.sampleVisible = reader.boolean("sampleVisible", true);
  return roughness;
}

Kind readDiffuse(Context& context, ObjectReader& reader) {
  return DiffuseMaterial{readSpectrum(context, reader, "reflectance", Spectrum(0.5f))};
}

Kind readConductor(Context& context, ObjectReader& reader) {
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
  conductor.specularReflectance = readSpectrum(context, reader, "specularReflectance", Spectrum(1.0f));
  conductor.roughness = readRoughness(context, reader);
  return conductor;
}

template <class Dielectric>
Dielectric readDielectricBase(Context& context, ObjectReader& reader) {
  Dielectric dielectric;
  dielectric.intIor = readIndex(reader, "intIor", "bk7");
  dielectric.extIor = readIndex(reader, "extIor", "air");
  dielectric.specularReflectance = readSpectrum(context, reader, "specularReflectance", Spectrum(1.0f));
  dielectric.specularTransmittance = readSpectrum(context, reader, "specularTransmittance", Spectrum(1.0f));
  return dielectric;
}

Kind readDielectric(Context& context, ObjectReader& reader) {
  auto dielectric = readDielectricBase<DielectricMaterial>(context, reader);
  dielectric.roughness = readRoughness(context, reader);
  return dielectric;
}

Kind readThinDielectric(Context& context, ObjectReader& reader) {
  return readDielectricBase<ThinDielectricMaterial>(context, reader);
}

Kind readPlastic(Context& context, ObjectReader& reader) {
  PlasticMaterial plastic;
  plastic.intIor = readIndex(reader, "intIor", "polypropylene");
  plastic.extIor = readIndex(reader, "extIor", "air");
  plastic.diffuseReflectance = readSpectrum(context, reader, "diffuseReflectance", Spectrum(0.5f));
  plastic.specularReflectance = readSpectrum(context, reader, "specularReflectance", Spectrum(1.0f));
  plastic.nonlinear = reader.boolean("nonlinear", false);
  plastic.roughness = readRoughness(context, reader);
  return plastic;
}

Kind readTwoSided(Context& context, ObjectReader& reader) {
  TwoSidedMaterial twoSided;
  twoSided.front = readMaterial(context, reader.require("front"));
  const auto back = reader.find("back");
  twoSided.back = back ? readMaterial(context, *back) : twoSided.front;
  return twoSided;
}

Kind readRoughDiffuse(Context& context, ObjectReader& reader) {
  RoughDiffuseMaterial matt;
  matt.reflectance = readSpectrum(context, reader, "reflectance", Spectrum(0.5f));
  matt.alpha = readNumber(context, reader, "alpha", 0.2f);
  matt.fastApproximation = reader.boolean("fastApproximation", false);
  return matt;
}

Kind readMask(Context& context, ObjectReader& reader) {
  MaskMaterial mask;
  mask.material = readMaterial(context, reader.require("material"));
  mask.opacity = readNumber(context, reader, "opacity", 0.5f);
  if (const auto cutoff = reader.find("cutoff")) mask.cutoff = float(cutoff->number());
  return mask;
}

Kind readBlend(Context& context, ObjectReader& reader) {
  BlendMaterial blend;
  blend.first = readMaterial(context, reader.require("first"));
  blend.second = readMaterial(context, reader.require("second"));
  blend.weight = readNumber(context, reader, "weight", 0.5f);
  return blend;
}

/// Height and normal maps are linear unless they say otherwise.
template <class Material>
Kind readTurned(Context& context, ObjectReader& reader) {
  Material turned;
  turned.material = readMaterial(context, reader.require("material"));
  turned.texture = readTexture(context, reader.require("texture"), TextureEncoding::Linear);
  turned.scale = reader.number("scale", 1);
  return turned;
}

Kind readPrincipled(Context& context, ObjectReader& reader) {
  PrincipledMaterial m;
  m.baseColor = readSpectrum(context, reader, "baseColor", Spectrum(0.5f));
  m.metallic = readNumber(context, reader, "metallic", 0);
  m.roughness = readNumber(context, reader, "roughness", 0.5f);
  m.anisotropy = reader.number("anisotropy", 0);
  m.ior = reader.find("ior") ? readIndex(reader, "ior", "") : m.ior;
  m.specular = readSpectrum(context, reader, "specular", Spectrum(1.0f));
  m.transmission = readNumber(context, reader, "transmission", 0);
  m.thin = reader.boolean("thin", false);
  m.sheen = readSpectrum(context, reader, "sheen", Spectrum(0.0f));
  m.clearcoat = readNumber(context, reader, "clearcoat", 0);
  m.clearcoatRoughness = readNumber(context, reader, "clearcoatRoughness", 0);
  return m;
}

const std::map<std::string, std::function<Kind(Context&, ObjectReader&)>> kReaders = {
    {"diffuse", readDiffuse},
    {"conductor", readConductor},
    {"dielectric", readDielectric},
    {"thinDielectric", readThinDielectric},
    {"plastic", readPlastic},
    {"twoSided", readTwoSided},
    {"roughDiffuse", readRoughDiffuse},
    {"mask", readMask},
    {"blend", readBlend},
    {"bump", readTurned<BumpMaterial>},
    {"normalMap", readTurned<NormalMapMaterial>},
    {"principled", readPrincipled},
    {"null", [](Context&, ObjectReader&) { return NullMaterial{}; }},
};

int readMaterialObject(Context& context, const Node& node, const std::string& name) {
  if (++context.openMaterials > kMostMaterialParts)
    node.fail(fmt::format("materials are nested deeper than {} here", kMostMaterialParts));
  ObjectReader reader(node);
  const Node type = reader.require("type");
  const auto found = kReaders.find(type.string());
  if (found == kReaders.end())
    type.fail(fmt::format("'{}' is no known material{}", type.string(), suggestName(type.string(), keysOf(kReaders))));
  MaterialDescription material{name, found->second(context, reader), node.source()};
  if (std::holds_alternative<DielectricMaterial>(material.kind))
    material.absorption = reader.color("absorption", material.absorption);
  reader.finish();
  --context.openMaterials;
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
