#include "loaders/gltf_textures.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "loaders/base64.h"
#include "loaders/file_search.h"

namespace pt::gltf {
namespace {

TextureWrap readWrap(json::ObjectReader& sampler, const char* key) {
  const int code = sampler.integer(key, 10497, 0);
  if (code == 33071) return TextureWrap::Clamp;
  if (code == 33648) return TextureWrap::Mirror;
  if (code != 10497) sampler.require(key).fail("must be 10497 (repeat), 33071 (clamp) or 33648 (mirror)");
  return TextureWrap::Repeat;
}

void readSampler(const json::Node& node, BitmapTexture& bitmap) {
  json::ObjectReader sampler(node);
  bitmap.wrapU = readWrap(sampler, "wrapS");
  bitmap.wrapV = readWrap(sampler, "wrapT");
  constexpr int kNearest = 9728;
  if (sampler.integer("magFilter", 0, 0) == kNearest) bitmap.filter = TextureFilter::Nearest;
}

/// KHR_texture_transform: scale, then rotation, then offset.
Matrix3 readTransform(const json::Node& node) {
  json::ObjectReader reader(node);
  const auto pair = [&](const char* key, double fallback) {
    const auto value = reader.find(key);
    if (!value) return Imath::V2d(fallback);
    const auto numbers = value->numbers();
    if (numbers.size() != 2) value->fail("must be two numbers");
    return Imath::V2d(numbers[0], numbers[1]);
  };
  const Imath::V2d offset = pair("offset", 0), scale = pair("scale", 1);
  const double angle = double(reader.number("rotation", 0)), c = std::cos(angle), s = std::sin(angle);
  return Matrix3(float(c * scale.x), float(s * scale.x), 0, float(-s * scale.y), float(c * scale.y), 0, float(offset.x),
                 float(offset.y), 1);
}

/// Of a PNG, by its header and what stands before its pixels; other formats of the web have none.
bool hasAlphaChannel(std::string_view bytes) {
  constexpr std::size_t kColorType = 25;
  if (!bytes.starts_with("\x89PNG") || bytes.size() <= kColorType) return false;
  const bool isOwnChannel = (bytes[kColorType] & 4) != 0;
  return isOwnChannel || bytes.substr(0, bytes.find("IDAT")).find("tRNS") != std::string_view::npos;
}

std::optional<json::Node> findTransform(const json::Node& info) {
  const auto extensions = json::ObjectReader(info).find("extensions");
  return extensions ? json::ObjectReader(*extensions).find("KHR_texture_transform") : std::nullopt;
}

/// Of a material's reference to a texture.
int uvSetOf(const json::Node& info) {
  if (const auto transform = findTransform(info))
    if (const auto set = json::ObjectReader(*transform).find("texCoord")) return set->integer(0);
  return json::ObjectReader(info).integer("texCoord", 0, 0);
}

/// The first reference to a texture anywhere in a material.
std::optional<json::Node> findTexture(const json::Node& node) {
  if (!node.isObject()) return std::nullopt;
  for (const auto& [key, child] : node.members()) {
    const std::string name = key;
    if (child.isObject() && (name.ends_with("Texture") || name == "texture")) return child;
    if (const auto found = findTexture(child)) return found;
  }
  return std::nullopt;
}

}  // namespace

int TextureReader::read(const json::Node& info, TextureEncoding encoding, TextureChannel channel) {
  json::ObjectReader reference(info);
  json::ObjectReader texture(elementOf(m_context.document, "textures", reference.require("index")));
  BitmapTexture bitmap;
  readImage(texture.require("source"), bitmap);
  bitmap.encoding = encoding;
  bitmap.channel = channel;
  if (const auto sampler = texture.find("sampler"))
    readSampler(elementOf(m_context.document, "samplers", *sampler), bitmap);
  TextureDescription description;
  description.kind = std::move(bitmap);
  description.source = info.source();
  if (const auto transform = findTransform(info)) description.uvTransform = readTransform(*transform);
  if (uvSetOf(info) != m_uvSet)
    m_context.scene.notes.push_back(fmt::format("{}: reads texture coordinates {}; its material's {} are used instead",
                                                info.source(), uvSetOf(info), m_uvSet));
  m_context.scene.textures.push_back(std::move(description));
  return int(m_context.scene.textures.size()) - 1;
}

bool TextureReader::hasAlpha(const json::Node& info) {
  json::ObjectReader texture(elementOf(m_context.document, "textures", json::ObjectReader(info).require("index")));
  BitmapTexture bitmap;
  readImage(texture.require("source"), bitmap);
  if (bitmap.bytes) return hasAlphaChannel(*bitmap.bytes);
  std::ifstream file(bitmap.file, std::ios::binary);
  std::string start(4096, '\0');
  file.read(start.data(), std::streamsize(start.size()));
  start.resize(std::size_t(file.gcount()));
  return hasAlphaChannel(start);
}

void TextureReader::readImage(const json::Node& index, BitmapTexture& bitmap) {
  json::ObjectReader image(elementOf(m_context.document, "images", index));
  const auto known = m_images.find(index.integer(0));
  if (known != m_images.end()) {
    bitmap = known->second;
    return;
  }
  const auto uri = image.find("uri");
  constexpr std::string_view kBase64 = ";base64,";
  if (!uri) {
    bitmap.bytes = embedded(image.require("bufferView"));
  } else if (uri->string().starts_with("data:")) {
    const std::size_t start = uri->string().find(kBase64);
    if (start == std::string::npos) uri->fail("must be a file or base64 data");
    bitmap.bytes = std::make_shared<std::string>(decodeBase64(uri->string().substr(start + kBase64.size())));
  } else {
    bitmap.file = m_context.document.file.parent_path() / decodeUri(uri->string());
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(bitmap.file, ignored))
      uri->fail(fmt::format("there is no file '{}'", decodeUri(uri->string())));
  }
  if (bitmap.bytes) bitmap.file = image.node().source();  // for messages
  m_images.emplace(index.integer(0), bitmap);
}

std::shared_ptr<const std::string> TextureReader::embedded(const json::Node& index) {
  json::ObjectReader view(elementOf(m_context.document, "bufferViews", index));
  json::ObjectReader buffer(elementOf(m_context.document, "buffers", view.require("buffer")));
  const auto length = std::size_t(view.require("byteLength").integer(0));
  const auto offset = std::size_t(view.integer("byteOffset", 0, 0));
  std::string bytes;
  if (const auto uri = buffer.find("uri")) {
    const std::size_t data = uri->string().find(";base64,");
    bytes = uri->string().starts_with("data:") && data != std::string::npos
                ? decodeBase64(uri->string().substr(data + 8))
                : readTextFile(m_context.document.file.parent_path() / decodeUri(uri->string()));
  } else {
    bytes = m_context.document.binary;
  }
  if (offset > bytes.size() || length > bytes.size() - offset)
    view.node().fail(fmt::format("does not fit into its buffer of {} bytes", bytes.size()));
  return std::make_shared<std::string>(bytes.substr(offset, length));
}

std::vector<int> readUvSets(const Document& document) {
  std::vector<int> sets;
  json::ObjectReader root(document.root());
  if (const auto materials = root.find("materials"))
    for (const json::Node& material : materials->elements()) {
      const auto main = json::ObjectReader(material).find("pbrMetallicRoughness");
      const auto mainTexture = main ? findTexture(*main) : std::nullopt;
      const auto texture = mainTexture ? mainTexture : findTexture(material);
      sets.push_back(texture ? uvSetOf(*texture) : 0);
    }
  return sets;
}

}  // namespace pt::gltf
