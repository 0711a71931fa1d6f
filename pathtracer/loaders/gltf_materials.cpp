#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "loaders/gltf_parts.h"
#include "loaders/gltf_textures.h"

namespace pt::gltf {
namespace {

/// An extension of the object, if it has it.
std::optional<json::ObjectReader> findExtension(json::ObjectReader& object, const char* name) {
  const auto extensions = object.find("extensions");
  if (!extensions) return std::nullopt;
  const auto found = json::ObjectReader(*extensions).find(name);
  return found ? std::optional(json::ObjectReader(*found)) : std::nullopt;
}

/// Reads one material.
class MaterialReader {
 public:
  MaterialReader(Context& context, TextureReader& textures, const json::Node& node)
      : m_context(context), m_textures(textures), m_object(node) {}

  Surface read() {
    m_name = m_object.string("name", "");
    readMetallicRoughness();
    readDielectric();
    readCoats();
    m_emission = readEmission();
    Surface surface;
    surface.material = add(m_principled);
    if (const auto normal = m_object.find("normalTexture")) surface.material = addNormalMap(surface.material, *normal);
    // Both sides are shown, whatever the file says of culling: a path tracer sees surfaces from everywhere.
    if (m_principled.transmission.value == 0)
      surface.material = add(TwoSidedMaterial{surface.material, surface.material});
    surface.material = addAlpha(surface.material);
    m_context.scene.materials[std::size_t(surface.material)].absorption = m_absorption;
    surface.emission = m_emission;
    return surface;
  }

 private:
  int add(decltype(MaterialDescription::kind) kind) {
    m_context.scene.materials.push_back({m_name, std::move(kind), m_object.node().source()});
    return int(m_context.scene.materials.size()) - 1;
  }

  int texture(json::ObjectReader& object, const char* key, TextureEncoding encoding, TextureChannel channel) {
    const auto info = object.find(key);
    return info ? m_textures.read(*info, encoding, channel) : kNone;
  }
  int color(json::ObjectReader& object, const char* key) {
    return texture(object, key, TextureEncoding::Srgb, TextureChannel::Color);
  }

  void readMetallicRoughness() {
    const nlohmann::json nothing = nlohmann::json::object();
    const auto pbr = m_object.find("pbrMetallicRoughness");
    json::ObjectReader reader(pbr ? *pbr : json::Node(nothing, m_object.node().source()));
    if (const auto factor = reader.find("baseColorFactor")) {
      const auto rgba = factor->numbers();
      if (rgba.size() != 4) factor->fail("must be four numbers [r, g, b, a]");
      m_principled.baseColor = Spectrum(Vec3(Vec3d(rgba[0], rgba[1], rgba[2])));
      m_alpha.value = float(rgba[3]);
    } else {
      m_principled.baseColor = Spectrum(1.0f);
    }
    m_principled.baseColor.texture = color(reader, "baseColorTexture");
    if (const auto info = reader.find("baseColorTexture")) m_alphaTexture = *info;
    m_principled.metallic = {
        reader.number("metallicFactor", 1),
        texture(reader, "metallicRoughnessTexture", TextureEncoding::Linear, TextureChannel::Blue)};
    m_principled.roughness = {
        reader.number("roughnessFactor", 1),
        texture(reader, "metallicRoughnessTexture", TextureEncoding::Linear, TextureChannel::Green)};
    if (findExtension(m_object, "KHR_materials_unlit")) note("is unlit in the file; here it is lit as any other");
  }

  void readDielectric() {
    if (auto ior = findExtension(m_object, "KHR_materials_ior")) m_principled.ior = ior->number("ior", 1.5f);
    if (auto specular = findExtension(m_object, "KHR_materials_specular")) {
      m_principled.specular = readColor(*specular, "specularColorFactor", 1) * specular->number("specularFactor", 1);
      m_principled.specular.texture = color(*specular, "specularColorTexture");
      if (specular->find("specularTexture")) note("has a specularTexture, which is not used");
    }
    if (auto transmission = findExtension(m_object, "KHR_materials_transmission")) {
      m_principled.transmission = {
          transmission->number("transmissionFactor", 0),
          texture(*transmission, "transmissionTexture", TextureEncoding::Linear, TextureChannel::Red)};
      readVolume();
    }
  }

  /// Without a volume the surface is a thin sheet.
  void readVolume() {
    auto volume = findExtension(m_object, "KHR_materials_volume");
    m_principled.thin = !volume || volume->number("thicknessFactor", 0) == 0;
    if (m_principled.thin || m_principled.transmission.value == 0 || !volume->find("attenuationDistance")) return;
    const float distance = volume->positive("attenuationDistance", 1);
    const Spectrum left = readColor(*volume, "attenuationColor", 1);
    for (int c = 0; c < 3; ++c) m_absorption[c] = -std::log(std::clamp(left[c], 1e-6f, 1.0f)) / distance;
  }

  void readCoats() {
    if (auto sheen = findExtension(m_object, "KHR_materials_sheen")) {
      m_principled.sheen = {readColor(*sheen, "sheenColorFactor", 0), color(*sheen, "sheenColorTexture")};
      for (const std::string key : {"sheenRoughnessFactor", "sheenRoughnessTexture"})
        if (sheen->find(key)) note(fmt::format("has a {}, which is not used", key));
    }
    if (auto coat = findExtension(m_object, "KHR_materials_clearcoat")) {
      m_principled.clearcoat = {coat->number("clearcoatFactor", 0),
                                texture(*coat, "clearcoatTexture", TextureEncoding::Linear, TextureChannel::Red)};
      m_principled.clearcoatRoughness = {
          coat->number("clearcoatRoughnessFactor", 0),
          texture(*coat, "clearcoatRoughnessTexture", TextureEncoding::Linear, TextureChannel::Green)};
      if (coat->find("clearcoatNormalTexture")) note("has a clearcoatNormalTexture, which is not used");
    }
  }

  std::optional<SpectrumParameter> readEmission() {
    Spectrum factor = readColor(m_object, "emissiveFactor", 0);
    if (auto strength = findExtension(m_object, "KHR_materials_emissive_strength"))
      factor *= strength->number("emissiveStrength", 1);
    if (isBlack(factor)) return std::nullopt;
    if (m_object.boolean("doubleSided", false))
      note("is double-sided and emits light; it does so from its front alone");
    return SpectrumParameter(factor, color(m_object, "emissiveTexture"));
  }

  int addNormalMap(int material, const json::Node& info) {
    NormalMapMaterial map;
    map.material = material;
    map.texture = m_textures.read(info, TextureEncoding::Linear, TextureChannel::Color);
    map.scale = json::ObjectReader(info).number("scale", 1);
    map.mirrorsWithUv = true;
    return add(map);
  }

  int addAlpha(int material) {
    const int mode = m_object.choice("alphaMode", {"OPAQUE", "MASK", "BLEND"}, 0);
    if (mode == 0) return material;
    if (m_alphaTexture && m_textures.hasAlpha(*m_alphaTexture))
      m_alpha.texture = m_textures.read(*m_alphaTexture, TextureEncoding::Linear, TextureChannel::Alpha);
    if (mode == 2 && m_alpha.value >= 1 && m_alpha.texture == kNone) return material;
    MaskMaterial mask;
    mask.material = material;
    mask.opacity = m_alpha;
    if (mode == 1) mask.cutoff = m_object.number("alphaCutoff", 0.5f);
    maskEmission(mask);
    return add(mask);
  }

  /// What is transparent does not glow.
  void maskEmission(const MaskMaterial& mask) {
    if (!m_emission) return;
    const float alpha = mask.opacity.value;
    if (mask.opacity.texture == kNone) {
      m_emission->value *= mask.cutoff ? float(alpha >= *mask.cutoff) : alpha;
      if (isBlack(m_emission->value)) m_emission.reset();
    } else if (!mask.cutoff && m_emission->texture == kNone) {
      m_emission = SpectrumParameter(m_emission->value * alpha, mask.opacity.texture);
    } else {
      note("glows where it is transparent, too");
    }
  }

  static Spectrum readColor(json::ObjectReader& object, const char* key, float fallback) {
    const auto color = object.find(key);
    return color ? Spectrum(Vec3(color->vector())) : Spectrum(fallback);
  }

  void note(const std::string& text) {
    m_context.scene.notes.push_back(fmt::format("{}: the material \"{}\" {}", m_object.node().source(), m_name, text));
  }

  Context& m_context;
  TextureReader& m_textures;
  json::ObjectReader m_object;
  std::string m_name;
  PrincipledMaterial m_principled;
  FloatParameter m_alpha{1.0f};
  std::optional<json::Node> m_alphaTexture;  ///< reference to it
  std::optional<SpectrumParameter> m_emission;
  Spectrum m_absorption{0.0f};
};

}  // namespace

std::vector<Surface> readMaterials(Context& context) {
  TextureReader textures(context);
  const std::vector<int> uvSets = readUvSets(context.document);
  std::vector<Surface> surfaces;
  json::ObjectReader root(context.document.root());
  if (const auto materials = root.find("materials"))
    for (const json::Node& material : materials->elements()) {
      textures.expectUvSet(uvSets[surfaces.size()]);
      surfaces.push_back(MaterialReader(context, textures, material).read());
    }
  return surfaces;
}

Surface defaultMaterial(Context& context) {
  PrincipledMaterial principled;  // what the format says a primitive without a material looks like
  principled.baseColor = Spectrum(1.0f);
  principled.metallic = 1;
  principled.roughness = 1;
  context.scene.materials.push_back({"default", principled, context.document.file.string()});
  const int front = int(context.scene.materials.size()) - 1;
  context.scene.materials.push_back({"default", TwoSidedMaterial{front, front}, context.document.file.string()});
  Surface surface;
  surface.material = int(context.scene.materials.size()) - 1;
  return surface;
}

}  // namespace pt::gltf
