#pragma once

#include <OpenImageIO/imagecache.h>

#include <atomic>
#include <cstdint>
#include <type_traits>

#include "textures/byte_table.h"
#include "textures/picture.h"

namespace pt {

/// Tiles of pictures that are too large to be held in memory, read when they are asked for and forgotten when others
/// need the space: OpenImageIO's ImageCache. Its look-ups cost about ten times those of MemoryTexels.
class TileCache {
 public:
  explicit TileCache(std::size_t bytes);

  OIIO::ImageCache& operator*() const noexcept { return *m_cache; }

  void countFailedRead() const noexcept { m_failedReads.fetch_add(1, std::memory_order_relaxed); }
  std::uint64_t failedReads() const noexcept { return m_failedReads.load(std::memory_order_relaxed); }

 private:
  struct Destroy {
    void operator()(OIIO::ImageCache* cache) const { OIIO::ImageCache::destroy(cache); }
  };
  std::unique_ptr<OIIO::ImageCache, Destroy> m_cache;
  mutable std::atomic<std::uint64_t> m_failedReads{0};
};

/// The same texels as MemoryTexels, through a TileCache; coarser levels are means of encoded numbers.
template <int Channels>
class CachedTexels {
 public:
  using Value = std::conditional_t<Channels == 1, float, Spectrum>;

  /// Reads the whole picture once, for its range. Throws InputError.
  CachedTexels(const PictureFile& picture, std::shared_ptr<const TileCache> cache);

  int levels() const noexcept { return int(m_sizes.size()); }
  int width(int level) const noexcept { return m_sizes[std::size_t(level)].x; }
  int height(int level) const noexcept { return m_sizes[std::size_t(level)].y; }
  Value operator()(int level, int x, int y) const noexcept;

  const TextureRange& range() const noexcept { return m_range; }
  std::size_t memoryBytes() const noexcept { return 0; }

 private:
  bool get(int level, int x, int y, int columns, int rows, float* values) const noexcept;
  float decode(float x) const noexcept;
  void findRange(const std::string& file);

  std::shared_ptr<const TileCache> m_cache;
  OIIO::ImageCache::ImageHandle* m_file;
  std::vector<Imath::V2i> m_sizes;
  int m_firstChannel;
  bool m_srgb, m_bytes;
  ByteTable m_table;
  TextureRange m_range;
};

extern template class CachedTexels<1>;
extern template class CachedTexels<3>;

}  // namespace pt
