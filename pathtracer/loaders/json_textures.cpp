#include <fmt/format.h>

#include "core/near_name.h"
#include "loaders/json_parts.h"

namespace pt::json {
namespace {

/// One for both coordinates or one for each.
Vec2 readPair(ObjectReader& reader, const std::string& key, float fallback) {
  const auto node = reader.find(key);
  if (!node) return Vec2(fallback);
  if (node->isNumber()) return Vec2(static_cast<float>(node->number()));
  const auto numbers = node->numbers();
  if (numbers.size() != 2) node->fail("must be a number or two numbers [u, v]");
  return {static_cast<float>(numbers[0]), static_cast<float>(numbers[1])};
}

/// Coordinates are scaled, turned, and moved.
Matrix3 readUvTransform(ObjectReader& reader) {
  const Vec2 scale = readPair(reader, "uvScale", 1), offset = readPair(reader, "uvOffset", 0);
  const float angle = reader.number("uvRotation", 0) * kPi / 180;
  const float c = std::cos(angle), s = std::sin(angle);
  return Matrix3(scale.x * c, scale.x * s, 0, -scale.y * s, scale.y * c, 0, offset.x, offset.y, 1);
}

TextureWrap readWrap(ObjectReader& reader, const std::string& key, TextureWrap fallback) {
  return static_cast<TextureWrap>(
      reader.choice(key, {"repeat", "mirror", "clamp", "black"}, static_cast<int>(fallback)));
}

BitmapTexture readBitmap(Context& context, ObjectReader& reader, TextureEncoding encoding) {
  BitmapTexture bitmap;
  const Node name = reader.require("file");
  const auto path = context.search.find(name.string());
  if (!path) name.fail(fmt::format("there is no file '{}'", name.string()));
  bitmap.file = *path;
  bitmap.encoding =
      static_cast<TextureEncoding>(reader.choice("encoding", {"srgb", "linear"}, static_cast<int>(encoding)));
  bitmap.channel = static_cast<TextureChannel>(reader.choice("channel", {"color", "red", "green", "blue", "alpha"}, 0));
  bitmap.filter = static_cast<TextureFilter>(reader.choice("filter", {"nearest", "bilinear", "trilinear"}, 1));
  const TextureWrap both = readWrap(reader, "wrap", TextureWrap::Repeat);
  bitmap.wrapU = readWrap(reader, "wrapU", both);
  bitmap.wrapV = readWrap(reader, "wrapV", both);
  return bitmap;
}

/// Node of a parameter's texture.
struct TextureUse {
  Node texture;
  std::optional<Node> scale;
};

TextureUse readUse(const Node& node) {
  ObjectReader reader(node);
  TextureUse use{reader.require("texture"), reader.find("scale")};
  reader.finish();
  return use;
}

}  // namespace

int readTexture(Context& context, const Node& node, TextureEncoding encoding) {
  if (node.isString()) {
    const auto named = context.textureNodes.find(node.string());
    if (named != context.textureNodes.end() && !named->second.isString())
      return readTexture(context, named->second, encoding);
    std::vector<std::string> known;
    for (const auto& [name, texture] : context.textureNodes) known.push_back(name);
    node.fail(fmt::format("there is no texture '{}'{}", node.string(), suggestName(node.string(), known)));
  }
  ObjectReader reader(node);
  TextureDescription texture;
  texture.source = node.source();
  if (reader.choice("type", {"bitmap", "checkerboard"}, 0) == 0)
    texture.kind = readBitmap(context, reader, encoding);
  else
    texture.kind = CheckerboardTexture{reader.color("color0", Spectrum(0.4f)), reader.color("color1", Spectrum(0.2f))};
  texture.uvTransform = readUvTransform(reader);
  reader.finish();
  context.scene.textures.push_back(std::move(texture));
  return static_cast<int>(context.scene.textures.size()) - 1;
}

SpectrumParameter readSpectrum(Context& context, const Node& node) {
  if (!node.isObject()) return node.color();
  const TextureUse use = readUse(node);
  return {use.scale ? use.scale->color() : Spectrum(1.0f), readTexture(context, use.texture, TextureEncoding::Srgb)};
}

SpectrumParameter readSpectrum(Context& context, ObjectReader& reader, const std::string& key,
                               const Spectrum& fallback) {
  const auto node = reader.find(key);
  return node ? readSpectrum(context, *node) : fallback;
}

FloatParameter readNumber(Context& context, ObjectReader& reader, const std::string& key, float fallback) {
  const auto node = reader.find(key);
  if (!node) return fallback;
  if (!node->isObject()) return static_cast<float>(node->number());
  const TextureUse use = readUse(*node);
  return {use.scale ? static_cast<float>(use.scale->number()) : 1.0f,
          readTexture(context, use.texture, TextureEncoding::Linear)};
}

}  // namespace pt::json
