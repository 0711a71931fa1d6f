#pragma once

#include <memory>
#include <vector>

#include "scene/scene_description.h"
#include "textures/texture.h"

namespace pt {

class TileCache;

/// The textures of a scene.
class TextureSet {
 public:
  TextureSet() = default;
  /// Reads pictures in parallel, each once; those that the scene's limit leaves no room for are read through a cache of
  /// tiles. Throws InputError.
  explicit TextureSet(const SceneDescription& description);

  /// By index of the description; null if there is no such texture.
  const Texture* find(int index) const noexcept {
    return index >= 0 && std::size_t(index) < m_textures.size() ? m_textures[std::size_t(index)].get() : nullptr;
  }

  std::size_t size() const noexcept { return m_textures.size(); }
  std::size_t memoryBytes() const noexcept { return m_memoryBytes; }  ///< of texels held
  std::size_t cachedPictures() const noexcept { return m_cachedPictures; }
  /// Of tiles, while textures are looked up: the file has changed. What should have been there is black; OpenImageIO
  /// tells once for all tiles that it reads together.
  std::uint64_t failedReads() const noexcept;

 private:
  std::vector<std::unique_ptr<const Texture>> m_textures;
  std::shared_ptr<const TileCache> m_cache;  ///< null if all pictures are in memory
  std::size_t m_memoryBytes = 0, m_cachedPictures = 0;
};

}  // namespace pt
