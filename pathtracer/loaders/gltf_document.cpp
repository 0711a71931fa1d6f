#include "loaders/gltf_document.h"

#include <fmt/format.h>

#include <cstring>

#include "core/error.h"
#include "loaders/file_search.h"
#include "loaders/loader_error.h"

namespace pt::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a,
                        kBinaryChunk = 0x004e4942;  // "glTF", "JSON", "BIN"

std::uint32_t numberAt(std::string_view bytes, std::size_t at) {
  std::uint32_t number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

/// Takes the chunk that starts `bytes` off them.
std::string_view takeChunk(std::string_view& bytes, std::uint32_t type, const std::string& file) {
  constexpr std::size_t kHeader = 8;
  if (bytes.size() < kHeader || numberAt(bytes, 0) > bytes.size() - kHeader)
    throw InputError(file + ": the file ends within a chunk; it is damaged");
  if (numberAt(bytes, 4) != type) throw InputError(file + ": the chunks of the file are not those of a glTF binary");
  const std::string_view chunk = bytes.substr(kHeader, numberAt(bytes, 0));
  bytes.remove_prefix(kHeader + chunk.size());
  return chunk;
}

Document readBinary(const std::filesystem::path& file, const std::string& text) {
  const std::string name = file.string();
  constexpr std::size_t kHeader = 12;
  if (text.size() < kHeader || numberAt(text, 0) != kMagic) throw InputError(name + ": is no glTF binary");
  if (numberAt(text, 4) != 2)
    throw InputError(fmt::format("{}: version {} of glTF is not supported; convert it to 2", name, numberAt(text, 4)));
  std::string_view rest = std::string_view(text).substr(kHeader);
  const std::string_view json = takeChunk(rest, kJsonChunk, name);
  const std::string_view binary = rest.empty() ? rest : takeChunk(rest, kBinaryChunk, name);
  return {file, json::parseText(json, file), std::string(binary)};
}

/// Extensions that change what a file means and that we know.
const std::vector<std::string> kKnownExtensions = {
    "KHR_lights_punctual",  "KHR_texture_transform",  "KHR_materials_emissive_strength",
    "KHR_materials_ior",    "KHR_materials_specular", "KHR_materials_transmission",
    "KHR_materials_volume", "KHR_materials_sheen",    "KHR_materials_clearcoat",
    "KHR_materials_unlit"};

void checkVersion(const Document& document) {
  json::ObjectReader root(document.root());
  json::ObjectReader asset(root.require("asset"));
  const json::Node version = asset.require("version");
  if (!version.string().starts_with("2."))
    version.fail(fmt::format("version {} of glTF is not supported; convert it to 2.0", version.string()));
  if (const auto required = root.find("extensionsRequired"))
    for (const json::Node& extension : required->elements())
      if (!isKnownExtension(extension.string()))
        extension.fail(
            fmt::format("the extension {} is not supported; export the file without it", extension.string()));
}

}  // namespace

bool isKnownExtension(const std::string& name) {
  return std::find(kKnownExtensions.begin(), kKnownExtensions.end(), name) != kKnownExtensions.end();
}

Document readDocument(const std::filesystem::path& file) {
  const std::string text = readTextFile(file);
  Document document =
      lowerCaseEnding(file) == ".glb" ? readBinary(file, text) : Document{file, json::parseText(text, file), {}};
  checkVersion(document);
  return document;
}

json::Node elementOf(const Document& document, const std::string& name, const json::Node& user) {
  const auto found = document.json.find(name);
  const auto count = found != document.json.end() && found->is_array() ? found->size() : 0;
  const auto index = std::size_t(user.integer(0));
  if (index >= count) user.fail(fmt::format("there is no element {} in '{}', which has {}", index, name, count));
  return {(*found)[index], fmt::format("{}#/{}/{}", document.file.string(), name, index)};
}

std::string decodeUri(const std::string& uri) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool isCode = uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    name += isCode ? char(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    if (isCode) i += 2;
  }
  return name;
}

}  // namespace pt::gltf
