#pragma once

#include <half.h>

#include <type_traits>

#include "textures/byte_table.h"
#include "textures/picture.h"

namespace pt {

/// The texels of a picture in memory: as the file has them, decoded when they are read. Level 0 is the finest.
template <class Component, int Channels>
class MemoryTexels {
 public:
  using Value = std::conditional_t<Channels == 1, float, Spectrum>;

  /// `picture` holds such components and channels. Throws InputError.
  explicit MemoryTexels(const PictureFile& picture);

  int levels() const noexcept { return int(m_levels.size()); }
  int width(int level) const noexcept { return m_levels[std::size_t(level)].width; }
  int height(int level) const noexcept { return m_levels[std::size_t(level)].height; }

  Value operator()(int level, int x, int y) const noexcept {
    const Level& l = m_levels[std::size_t(level)];
    const Component* texel = &l.texels[(std::size_t(y) * std::size_t(l.width) + std::size_t(x)) * Channels];
    if constexpr (Channels == 1)
      return decode(texel[0]);
    else
      return {decode(texel[0]), decode(texel[1]), decode(texel[2])};
  }

  const TextureRange& range() const noexcept { return m_range; }
  std::size_t memoryBytes() const noexcept;

 private:
  struct Level {
    int width, height;
    std::vector<Component> texels;
  };

  float decode(Component c) const noexcept {
    if constexpr (std::is_same_v<Component, std::uint8_t>)
      return m_table[c];
    else
      return float(c);
  }
  Component encode(float x) const noexcept;
  void addCoarserLevels();
  void findRange();

  std::vector<Level> m_levels;
  TextureRange m_range;
  bool m_srgb = false;
  ByteTable m_table;  ///< of bytes
};

extern template class MemoryTexels<std::uint8_t, 1>;
extern template class MemoryTexels<std::uint8_t, 3>;
extern template class MemoryTexels<Imath::half, 1>;
extern template class MemoryTexels<Imath::half, 3>;
extern template class MemoryTexels<float, 1>;
extern template class MemoryTexels<float, 3>;

}  // namespace pt
