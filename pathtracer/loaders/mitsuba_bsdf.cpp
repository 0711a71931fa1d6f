#include <fmt/format.h>

#include <functional>

#include "core/near_name.h"
#include "loaders/mitsuba_parts.h"
#include "loaders/refraction_index.h"
#include "materials/conductor_presets.h"
#include "materials/material_parts.h"

namespace pt::mitsuba {
namespace {

using Kind = decltype(MaterialDescription::kind);

float readIndex(Reader& reader, const std::string& name, const char* fallback) {
  const auto property = reader.object().properties.find(name);
  if (property != reader.object().properties.end() && !std::holds_alternative<std::string>(property->second.value))
    return reader.number(name, 0);
  const std::string substance = reader.string(name, fallback);
  const auto index = findRefractionIndex(substance);
  if (!index)
    reader.fail(name, fmt::format("names no known substance: '{}'{}", substance,
                                  suggestName(substance, refractionIndexNames())));
  return *index;
}

Roughness readRoughness(Reader& reader) {
  Roughness roughness;
  if (reader.has("alpha_u") || reader.has("alpha_v")) {
    roughness.alpha = reader.numberOrTexture("alpha_u", 0.1f);
    roughness.alphaV = reader.numberOrTexture("alpha_v", 0.1f);
  } else {
    roughness.alpha = reader.numberOrTexture("alpha", 0.1f);
  }
  roughness.distribution = static_cast<MicrofacetDistribution>(reader.choice("distribution", {"beckmann", "ggx"}, 0));
  roughness.sampleVisible = reader.boolean("sample_visible", true);
  return roughness;
}

Kind readDiffuse(Context&, Reader& reader) {
  return DiffuseMaterial{reader.spectrum("reflectance", Spectrum(0.5f))};
}

Kind readRoughDiffuse(Context&, Reader& reader) {
  RoughDiffuseMaterial matt;
  matt.reflectance = reader.spectrum("reflectance", Spectrum(0.5f));
  matt.alpha = reader.numberOrTexture("alpha", 0.2f);
  matt.fastApproximation = reader.boolean("use_fast_approx", false);
  return matt;
}

ConductorMaterial readConductorBase(Context& context, Reader& reader) {
  ConductorMaterial conductor;
  const bool hasIndex = reader.has("eta") || reader.has("k");
  const std::string preset = reader.string("material", context.isOld() && !hasIndex ? "Cu" : "none");
  if (hasIndex && preset != "none") reader.fail("material", "excludes eta and k: give one or the other");
  if (preset != "none") {
    const auto found = findConductorPreset(preset);
    if (!found)
      throw UnsupportedError(reader.object().source,
                             fmt::format("the conductor '{}' is not known (give eta and k instead)", preset));
    conductor.eta = found->eta;
    conductor.k = found->k;
  }
  // Mitsuba 0.x leaves a missing half of the pair to copper; here as in Mitsuba 3 it is 0 + 1i.
  conductor.eta = reader.color("eta", conductor.eta);
  conductor.k = reader.color("k", conductor.k);
  const float exterior = readIndex(reader, "ext_eta", context.isOld() ? "air" : "vacuum");
  conductor.eta /= exterior;
  conductor.k /= exterior;
  conductor.specularReflectance = reader.spectrum("specular_reflectance", Spectrum(1.0f));
  return conductor;
}

Kind readConductor(Context& context, Reader& reader) {
  return readConductorBase(context, reader);
}

Kind readRoughConductor(Context& context, Reader& reader) {
  ConductorMaterial conductor = readConductorBase(context, reader);
  conductor.roughness = readRoughness(reader);
  return conductor;
}

template <class Dielectric>
Dielectric readDielectricBase(Reader& reader) {
  Dielectric dielectric;
  dielectric.intIor = readIndex(reader, "int_ior", "bk7");
  dielectric.extIor = readIndex(reader, "ext_ior", "air");
  dielectric.specularReflectance = reader.spectrum("specular_reflectance", Spectrum(1.0f));
  dielectric.specularTransmittance = reader.spectrum("specular_transmittance", Spectrum(1.0f));
  return dielectric;
}

Kind readDielectric(Context&, Reader& reader) {
  return readDielectricBase<DielectricMaterial>(reader);
}
Kind readThinDielectric(Context&, Reader& reader) {
  return readDielectricBase<ThinDielectricMaterial>(reader);
}

Kind readRoughDielectric(Context&, Reader& reader) {
  auto dielectric = readDielectricBase<DielectricMaterial>(reader);
  dielectric.roughness = readRoughness(reader);
  return dielectric;
}

PlasticMaterial readPlasticBase(Reader& reader) {
  PlasticMaterial plastic;
  plastic.intIor = readIndex(reader, "int_ior", "polypropylene");
  plastic.extIor = readIndex(reader, "ext_ior", "air");
  plastic.diffuseReflectance = reader.spectrum("diffuse_reflectance", Spectrum(0.5f));
  plastic.specularReflectance = reader.spectrum("specular_reflectance", Spectrum(1.0f));
  plastic.nonlinear = reader.boolean("nonlinear", false);
  return plastic;
}

Kind readPlastic(Context&, Reader& reader) {
  return readPlasticBase(reader);
}

Kind readRoughPlastic(Context& context, Reader& reader) {
  PlasticMaterial plastic = readPlasticBase(reader);
  plastic.roughness = readRoughness(reader);
  plastic.roughBoundary = context.isOld() ? RoughBoundary::KeepsMasked : RoughBoundary::LosesMasked;
  return plastic;
}

Kind readTwoSided(Context& context, Reader& reader) {
  const auto sides = reader.children("bsdf");
  if (sides.empty() || sides.size() > 2)
    failAt(reader.object().source,
           fmt::format("{} needs one or two bsdfs inside, not {}", reader.title(), sides.size()));
  TwoSidedMaterial twoSided;
  twoSided.front = readBsdf(context, *sides.front());
  twoSided.back = readBsdf(context, *sides.back());
  return twoSided;
}

Kind readBlend(Context& context, Reader& reader) {
  const auto inside = reader.children("bsdf");
  if (inside.size() != 2)
    failAt(reader.object().source, fmt::format("{} needs two bsdfs inside, not {}", reader.title(), inside.size()));
  BlendMaterial blend;
  blend.first = readBsdf(context, *inside[0]);
  blend.second = readBsdf(context, *inside[1]);
  blend.weight = reader.numberOrTexture("weight", 0.5f);
  return blend;
}

/// The BSDF inside another one.
int readNested(Context& context, Reader& reader) {
  const auto nested = reader.children("bsdf");
  if (nested.size() != 1)
    failAt(reader.object().source, fmt::format("{} needs one bsdf inside, not {}", reader.title(), nested.size()));
  return readBsdf(context, *nested.front());
}

Kind readMask(Context& context, Reader& reader) {
  MaskMaterial mask;
  mask.material = readNested(context, reader);
  mask.opacity = reader.numberOrTexture("opacity", 0.5f);
  return mask;
}

/// A BSDF and the texture that turns its normals, whatever its name; returns the texture's factor.
template <class Material>
float readTurned(Context& context, Reader& reader, Material& material) {
  material.material = readNested(context, reader);
  const auto textures = reader.children("texture");
  if (textures.size() != 1)
    failAt(reader.object().source, fmt::format("{} needs one texture inside, not {}", reader.title(), textures.size()));
  const SpectrumParameter texture = readTexture(context, *textures.front());
  material.texture = texture.texture;
  return luminance(texture.value);
}

Kind readBump(Context& context, Reader& reader) {
  BumpMaterial bump;
  bump.scale = readTurned(context, reader, bump) * reader.number("scale", 1);
  return bump;
}

Kind readNormalMap(Context& context, Reader& reader) {
  NormalMapMaterial normals;
  if (readTurned(context, reader, normals) != 1)
    failAt(reader.object().source, "the texture of a normalmap cannot be scaled");
  return normals;
}

/// White, or as far as `tint` says the hue of a colour.
Spectrum tinted(Reader& reader, const std::string& name, const SpectrumParameter& color) {
  const float tint = reader.number(name, 0);
  if (tint == 0) return Spectrum(1.0f);
  if (color.texture != kNone)
    throw UnsupportedError(reader.object().source,
                           fmt::format("{} of a base colour with a texture is not supported", reader.spelled(name)));
  const float brightness = luminance(color.value);
  const Spectrum hue = brightness > 0 ? color.value / brightness : Spectrum(1.0f);
  return Spectrum(1 - tint) + hue * tint;
}

/// Mitsuba 3's parameters of Disney's model, for our model of the same purpose: diffuse light is Lambert's here, and
/// the varnish GGX.
Kind readPrincipled(Context&, Reader& reader) {
  PrincipledMaterial m;
  m.baseColor = reader.spectrum("base_color", Spectrum(0.5f));
  m.metallic = reader.numberOrTexture("metallic", 0);
  m.roughness = reader.numberOrTexture("roughness", 0.5f);
  m.anisotropy = reader.number("anisotropic", 0);
  m.transmission = reader.numberOrTexture("spec_trans", 0);
  if (reader.has("eta") && reader.has("specular")) reader.fail("eta", "excludes specular: give one or the other");
  m.ior =
      reader.has("eta") ? reader.number("eta", 1.5f) : 2 / (1 - std::sqrt(0.08f * reader.number("specular", 0.5f))) - 1;
  const Spectrum specular = tinted(reader, "spec_tint", m.baseColor);
  m.specular = specular / std::max(1.0f, maxComponent(specular));
  const Spectrum sheen = tinted(reader, "sheen_tint", m.baseColor);
  const FloatParameter sheenAmount = reader.numberOrTexture("sheen", 0);
  m.sheen = {sheen * (sheenAmount.value / std::max(1.0f, maxComponent(sheen))), sheenAmount.texture};
  const FloatParameter coat = reader.numberOrTexture("clearcoat", 0);
  m.clearcoat = {0.25f * coat.value, coat.texture};
  m.clearcoatRoughness = std::sqrt(0.1f + (0.001f - 0.1f) * reader.number("clearcoat_gloss", 0));
  if (reader.number("flatness", 0) != 0) throw UnsupportedError(reader.object().source, "flatness is not supported");
  reader.ignore({"main_specular_sampling_rate", "clearcoat_sampling_rate", "diffuse_reflectance_sampling_rate"});
  return m;
}

const std::map<std::string, std::function<Kind(Context&, Reader&)>> kReaders = {
    {"diffuse", readDiffuse},
    {"conductor", readConductor},
    {"roughconductor", readRoughConductor},
    {"dielectric", readDielectric},
    {"roughdielectric", readRoughDielectric},
    {"thindielectric", readThinDielectric},
    {"plastic", readPlastic},
    {"roughplastic", readRoughPlastic},
    {"twosided", readTwoSided},
    {"roughdiffuse", readRoughDiffuse},
    {"blendbsdf", readBlend},
    {"bumpmap", readBump},
    {"normalmap", readNormalMap},
    {"principled", readPrincipled},
    {"mask", readMask},
    {"null", [](Context&, Reader&) { return NullMaterial{}; }},
};

Kind readKind(Context& context, const Object& object) {
  const auto found = kReaders.find(object.type);
  if (found == kReaders.end())
    throw UnsupportedError(object.source, fmt::format("bsdf '{}' is not supported", object.type));
  Reader reader(context, object);
  Kind kind = found->second(context, reader);
  reader.finish();
  return kind;
}

/// What stands in for a BSDF that is left out: the one it wraps, if it wraps exactly one, or a grey diffuse one.
int readStandIn(Context& context, const Object& object, const UnsupportedError& error) {
  const auto wrapped = Reader(context, object).children("bsdf");
  if (wrapped.size() == 1) {
    context.leaveOut(error, "the bsdf inside is used as it is");
    return readBsdf(context, *wrapped.front());
  }
  context.leaveOut(error, "grey diffuse instead");
  context.scene.materials.push_back({object.id, DiffuseMaterial{}, object.source});
  return static_cast<int>(context.scene.materials.size()) - 1;
}

}  // namespace

int readBsdf(Context& context, const Object& object) {
  const auto [known, isNew] = context.materials.emplace(&object, kNone);
  if (!isNew) {
    if (known->second == kNone) failAt(object.source, fmt::format("bsdf '{}' contains itself", object.type));
    return known->second;
  }
  if (++context.openMaterials > kMostMaterialParts)
    failAt(object.source, fmt::format("bsdfs are nested deeper than {} here", kMostMaterialParts));
  int index = kNone;
  try {
    Kind kind = readKind(context, object);
    context.scene.materials.push_back({object.id, std::move(kind), object.source});
    index = static_cast<int>(context.scene.materials.size()) - 1;
  } catch (const UnsupportedError& error) {
    index = readStandIn(context, object, error);
  }
  --context.openMaterials;
  return known->second = index;
}

}  // namespace pt::mitsuba
