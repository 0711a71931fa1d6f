#pragma once

#include <map>

#include "loaders/gltf_parts.h"

namespace pt::gltf {

/// Reads the textures that materials name.
class TextureReader {
 public:
  explicit TextureReader(Context& context) : m_context(context) {}

  /// `info` is a material's reference to a texture, with a transform of its own. Index into scene.textures.
  int read(const json::Node& info, TextureEncoding encoding, TextureChannel channel);

  /// Whether the picture of a texture has an alpha channel.
  bool hasAlpha(const json::Node& info);

  /// Textures that read another set of texture coordinates than this one are noted: shapes keep one set.
  void expectUvSet(int set) { m_uvSet = set; }

 private:
  void readImage(const json::Node& index, BitmapTexture& bitmap);
  std::shared_ptr<const std::string> embedded(const json::Node& bufferView);

  Context& m_context;
  int m_uvSet = 0;
  std::map<int, BitmapTexture> m_images;  ///< read already, by index
};

}  // namespace pt::gltf
