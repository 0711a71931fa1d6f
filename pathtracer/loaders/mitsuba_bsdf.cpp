#include <fmt/format.h>

#include <functional>

#include "core/near_name.h"
#include "loaders/mitsuba_parts.h"
#include "loaders/refraction_index.h"
#include "materials/conductor_presets.h"

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
    const float u = reader.number("alpha_u", 0.1f), v = reader.number("alpha_v", 0.1f);
    if (u != v)
      throw UnsupportedError(reader.object().source,
                             fmt::format("anisotropic roughness of {} is not supported", reader.title()));
    roughness.alpha = u;
  } else {
    roughness.alpha = reader.number("alpha", 0.1f);
  }
  roughness.distribution = static_cast<MicrofacetDistribution>(reader.choice("distribution", {"beckmann", "ggx"}, 0));
  roughness.sampleVisible = reader.boolean("sample_visible", true);
  return roughness;
}

Kind readDiffuse(Context&, Reader& reader) {
  return DiffuseMaterial{reader.color("reflectance", Spectrum(0.5f))};
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
  conductor.specularReflectance = reader.color("specular_reflectance", Spectrum(1.0f));
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
  dielectric.specularReflectance = reader.color("specular_reflectance", Spectrum(1.0f));
  dielectric.specularTransmittance = reader.color("specular_transmittance", Spectrum(1.0f));
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
  plastic.diffuseReflectance = reader.color("diffuse_reflectance", Spectrum(0.5f));
  plastic.specularReflectance = reader.color("specular_reflectance", Spectrum(1.0f));
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
  int index = kNone;
  try {
    Kind kind = readKind(context, object);
    context.scene.materials.push_back({object.id, std::move(kind), object.source});
    index = static_cast<int>(context.scene.materials.size()) - 1;
  } catch (const UnsupportedError& error) {
    index = readStandIn(context, object, error);
  }
  return known->second = index;
}

}  // namespace pt::mitsuba
