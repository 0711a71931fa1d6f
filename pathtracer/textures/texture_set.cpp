#include "textures/texture_set.h"

#include <exception>
#include <functional>
#include <map>

#include "core/error.h"
#include "core/parallel.h"
#include "textures/bitmap.h"
#include "textures/cached_texels.h"
#include "textures/checkerboard.h"
#include "textures/memory_texels.h"

namespace pt {
namespace {

/// Of the cache of tiles, even where the pictures in memory have used up the limit.
constexpr std::size_t kLeastCacheBytes = std::size_t(64) << 20;

/// One picture and how bitmaps that show it are made.
struct Picture {
  SourceLocation source;
  std::unique_ptr<PictureFile> file;
  bool isCached = false;
  std::size_t memoryBytes = 0;
  std::function<std::unique_ptr<const Texture>(const BitmapLookup&)> makeBitmap;
};

PictureKey keyOf(const BitmapTexture& bitmap) {
  return {bitmap.file, bitmap.bytes, bitmap.encoding, bitmap.channel, bitmap.filter == TextureFilter::Trilinear};
}

template <class Texels, class... Arguments>
void load(Picture& picture, const Arguments&... arguments) {
  const auto texels = std::make_shared<const Texels>(*picture.file, arguments...);
  picture.memoryBytes = texels->memoryBytes();
  picture.makeBitmap = [texels](const BitmapLookup& lookup) {
    return std::make_unique<const Bitmap<Texels>>(texels, lookup);
  };
}

template <class Component>
void loadIntoMemory(Picture& picture) {
  if (picture.file->channels() == 1)
    load<MemoryTexels<Component, 1>>(picture);
  else
    load<MemoryTexels<Component, 3>>(picture);
}

void load(Picture& picture, const std::shared_ptr<const TileCache>& cache) {
  const PictureFile& file = *picture.file;
  if (picture.isCached && file.channels() == 1)
    load<CachedTexels<1>>(picture, cache);
  else if (picture.isCached)
    load<CachedTexels<3>>(picture, cache);
  else if (file.isBytes())
    loadIntoMemory<std::uint8_t>(picture);
  else if (file.isHalf())
    loadIntoMemory<Imath::half>(picture);
  else
    loadIntoMemory<float>(picture);
  picture.file.reset();
}

using Pictures = std::map<PictureKey, Picture>;

/// In parallel; of several faults the first in order is reported.
template <class F>
void forEachPicture(Pictures& pictures, F f) {
  std::vector<Pictures::value_type*> all;
  for (auto& entry : pictures) all.push_back(&entry);
  std::vector<std::exception_ptr> faults(all.size());
  parallelFor(all.size(), [&](std::size_t i) {
    try {
      f(all[i]->first, all[i]->second);
    } catch (const InputError& error) {
      faults[i] = std::make_exception_ptr(InputError(all[i]->second.source + ": " + error.what()));
    } catch (...) {
      faults[i] = std::current_exception();
    }
  });
  for (const auto& fault : faults)
    if (fault) std::rethrow_exception(fault);
}

/// Chooses those that are cached, and returns their cache.
std::shared_ptr<const TileCache> shareMemory(Pictures& pictures, std::size_t limit) {
  std::size_t used = 0;
  bool someCached = false;
  for (auto& [key, picture] : pictures) {
    const std::size_t bytes = picture.file->memoryBytes();
    picture.isCached = bytes > limit - std::min(used, limit) && picture.file->isFile();
    someCached |= picture.isCached;
    if (!picture.isCached) used += bytes;
  }
  return someCached ? std::make_shared<const TileCache>(std::max(limit - std::min(used, limit), kLeastCacheBytes))
                    : nullptr;
}

UvMap uvMapOf(const TextureDescription& texture) {
  const Matrix3& m = texture.uvTransform;
  for (int i = 0; i < 9; ++i)
    if (!std::isfinite(m[i / 3][i % 3]) || (i % 3 == 2 && m[i / 3][2] != (i == 8 ? 1.0f : 0.0f)))
      throw InputError(texture.source + ": the transform of texture coordinates must be affine and finite");
  return UvMap(m);
}

}  // namespace

TextureSet::TextureSet(const SceneDescription& description) {
  Pictures pictures;
  for (const TextureDescription& texture : description.textures)
    if (const auto* bitmap = std::get_if<BitmapTexture>(&texture.kind))
      pictures[keyOf(*bitmap)].source = texture.source;
  forEachPicture(pictures,
                 [](const PictureKey& key, Picture& picture) { picture.file = std::make_unique<PictureFile>(key); });
  m_cache = shareMemory(pictures, description.textureMemoryBytes);
  forEachPicture(pictures, [&](const PictureKey&, Picture& picture) { load(picture, m_cache); });

  for (const TextureDescription& texture : description.textures) {
    const UvMap uvMap = uvMapOf(texture);
    if (const auto* board = std::get_if<CheckerboardTexture>(&texture.kind)) {
      m_textures.push_back(std::make_unique<const Checkerboard>(board->color0, board->color1, uvMap));
    } else {
      const auto& bitmap = std::get<BitmapTexture>(texture.kind);
      m_textures.push_back(pictures.at(keyOf(bitmap)).makeBitmap({uvMap, bitmap.filter, bitmap.wrapU, bitmap.wrapV}));
    }
  }
  for (const auto& [key, picture] : pictures) {
    m_memoryBytes += picture.memoryBytes;
    m_cachedPictures += picture.isCached ? 1 : 0;
  }
}

std::uint64_t TextureSet::failedReads() const noexcept {
  return m_cache ? m_cache->failedReads() : 0;
}

}  // namespace pt
