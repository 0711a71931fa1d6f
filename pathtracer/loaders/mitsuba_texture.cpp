#include <fmt/format.h>

#include "loaders/mitsuba_parts.h"

namespace pt::mitsuba {
namespace {

TextureFilter readFilter(Context& context, Reader& reader) {
  // Mitsuba 0.x's anisotropic filter, its default, comes down to the isotropic one here.
  constexpr TextureFilter kFilters[] = {TextureFilter::Nearest, TextureFilter::Bilinear, TextureFilter::Trilinear,
                                        TextureFilter::Trilinear};
  reader.ignore({"max_anisotropy"});
  return kFilters[reader.choice("filter_type", {"nearest", "bilinear", "trilinear", "ewa"}, context.isOld() ? 3 : 1)];
}

TextureWrap readWrap(Reader& reader, const std::string& name, TextureWrap fallback) {
  constexpr TextureWrap kWraps[] = {TextureWrap::Repeat, TextureWrap::Mirror, TextureWrap::Clamp, TextureWrap::Black};
  const auto known = std::find(std::begin(kWraps), std::end(kWraps), fallback);
  return kWraps[reader.choice(name, {"repeat", "mirror", "clamp", "zero"}, int(known - std::begin(kWraps)))];
}

TextureEncoding readEncoding(Context& context, Reader& reader) {
  if (!context.isOld()) return reader.boolean("raw", false) ? TextureEncoding::Linear : TextureEncoding::Srgb;
  const float gamma = reader.number("gamma", -1);
  if (gamma == 1) return TextureEncoding::Linear;
  if (gamma != -1 && gamma != 0 && std::abs(gamma - 2.2f) > 0.21f)
    throw UnsupportedError(reader.object().source,
                           fmt::format("gamma {} of a texture is not supported: 1 (linear) and -1 (sRGB) are", gamma));
  return TextureEncoding::Srgb;
}

TextureChannel readChannel(Reader& reader) {
  if (!reader.has("channel")) return TextureChannel::Color;
  return static_cast<TextureChannel>(1 + reader.choice("channel", {"r", "g", "b", "a"}, 0));
}

BitmapTexture readBitmap(Context& context, Reader& reader) {
  BitmapTexture bitmap;
  bitmap.file = reader.file("filename");
  bitmap.encoding = readEncoding(context, reader);
  bitmap.channel = readChannel(reader);
  bitmap.filter = readFilter(context, reader);
  const TextureWrap both = readWrap(reader, "wrap_mode", TextureWrap::Repeat);
  bitmap.wrapU = readWrap(reader, "wrap_mode_u", both);
  bitmap.wrapV = readWrap(reader, "wrap_mode_v", both);
  reader.ignore({"format", "accel", "cache"});
  return bitmap;
}

/// Row vectors: the part of to_uv that moves u and v, after Mitsuba 0.x's scales and offsets.
Matrix3 readUvTransform(Reader& reader) {
  const float scale = reader.number("uvscale", 1);
  const float u = reader.number("uscale", scale), v = reader.number("vscale", scale);
  const Matrix3 old(u, 0, 0, 0, v, 0, reader.number("uoffset", 0), reader.number("voffset", 0), 1);
  const Matrix4 m = reader.transform("to_uv");
  return old * Matrix3(m[0][0], m[0][1], 0, m[1][0], m[1][1], 0, m[3][0], m[3][1], 1);
}

SpectrumParameter addTexture(Context& context, TextureDescription texture) {
  context.scene.textures.push_back(std::move(texture));
  return {Spectrum(1.0f), static_cast<int>(context.scene.textures.size()) - 1};
}

SpectrumParameter readNew(Context& context, const Object& object) {
  Reader reader(context, object);
  SpectrumParameter result;
  if (object.type == "scale") {
    const auto inside = reader.children("texture");
    if (inside.size() != 1)
      failAt(object.source, fmt::format("{} needs one texture inside, not {}", reader.title(), inside.size()));
    result = readTexture(context, *inside.front());
    result.value *= reader.color("scale", Spectrum(1.0f));
  } else if (object.type == "bitmap") {
    const BitmapTexture bitmap = readBitmap(context, reader);
    result = addTexture(context, {bitmap, readUvTransform(reader), object.source});
  } else if (object.type == "checkerboard") {
    const CheckerboardTexture board{reader.color("color0", Spectrum(0.4f)), reader.color("color1", Spectrum(0.2f))};
    result = addTexture(context, {board, readUvTransform(reader), object.source});
  } else {
    throw UnsupportedError(object.source, fmt::format("texture '{}' is not supported", object.type));
  }
  reader.finish();
  return result;
}

}  // namespace

SpectrumParameter readTexture(Context& context, const Object& object) {
  if (object.tag != "texture")
    throw UnsupportedError(object.source, fmt::format("{} '{}' is not supported here", object.tag, object.type));
  const auto [known, isNew] = context.textures.emplace(&object, SpectrumParameter());
  if (isNew) return known->second = readNew(context, object);
  if (known->second.texture == kNone) failAt(object.source, fmt::format("texture '{}' contains itself", object.type));
  return known->second;
}

}  // namespace pt::mitsuba
