#include "textures/cached_texels.h"

#include <fmt/format.h>

#include "core/error.h"

namespace pt {

TileCache::TileCache(std::size_t bytes) : m_cache(OIIO::ImageCache::create(false)) {
  m_cache->attribute("max_memory_MB", float(double(bytes) / (1 << 20)));
  m_cache->attribute("autotile", 64);
  m_cache->attribute("automip", 1);
  m_cache->attribute("unassociatedalpha", 1);
  m_cache->attribute("failure_retries", 2);
}

template <int Channels>
CachedTexels<Channels>::CachedTexels(const PictureFile& picture, std::shared_ptr<const TileCache> cache)
    : m_cache(std::move(cache)),
      m_file((**m_cache).get_image_handle(OIIO::ustring(picture.key().file.string()))),
      m_firstChannel(picture.firstChannel()),
      m_srgb(picture.isSrgb()),
      m_bytes(picture.isBytes()),
      m_table(makeByteTable(m_srgb)) {
  int levels = 1;
  if (picture.key().mipMapped) {
    OIIO::ImageSpec spec;
    while ((**m_cache).get_imagespec(m_file, nullptr, spec, 0, levels)) ++levels;
    (**m_cache).geterror();  // that of the level that is not there
  }
  for (int i = 0; i < levels; ++i)
    m_sizes.emplace_back(std::max(1, picture.width() >> i), std::max(1, picture.height() >> i));
  findRange(picture.key().file.string());
}

template <int Channels>
bool CachedTexels<Channels>::get(int level, int x, int y, int columns, int rows, float* values) const noexcept {
  return (**m_cache).get_pixels(m_file, nullptr, 0, level, x, x + columns, y, y + rows, 0, 1, m_firstChannel,
                                m_firstChannel + Channels, OIIO::TypeDesc::FLOAT, values);
}

template <int Channels>
float CachedTexels<Channels>::decode(float x) const noexcept {
  if (m_bytes) return m_table[std::size_t(std::clamp(x * 255 + 0.5f, 0.0f, 255.0f))];
  return m_srgb ? srgbToLinear(x) : x;
}

template <int Channels>
auto CachedTexels<Channels>::operator()(int level, int x, int y) const noexcept -> Value {
  float values[Channels] = {};
  if (!get(level, x, y, 1, 1, values)) m_cache->countFailedRead();
  if constexpr (Channels == 1)
    return decode(values[0]);
  else
    return {decode(values[0]), decode(values[1]), decode(values[2])};
}

template <int Channels>
void CachedTexels<Channels>::findRange(const std::string& file) {
  constexpr int kRows = 64;
  std::vector<float> rows(std::size_t(width(0)) * kRows * Channels);
  Spectrum least(std::numeric_limits<float>::infinity()), most(-least);
  Imath::V3d sum(0.0);
  for (int y = 0; y < height(0); y += kRows) {
    const int count = std::min(kRows, height(0) - y);
    if (!get(0, 0, y, width(0), count, rows.data()))
      throw InputError(fmt::format("{}: the picture is damaged: {}", file, (**m_cache).geterror()));
    for (std::size_t i = 0; i < std::size_t(width(0)) * std::size_t(count) * Channels; ++i) {
      const int c = int(i % Channels);
      const float x = decode(rows[i]);
      least[c] = std::min(least[c], x);
      most[c] = std::max(most[c], x);
      sum[c] += x;
    }
  }
  sum /= double(width(0)) * height(0);
  if (!std::isfinite(sum.x + sum.y + sum.z))
    throw InputError(file + ": the picture has a NaN or infinite texel; mend it");
  m_range = {least, most, Spectrum(Vec3(sum))};
  if (Channels == 1) m_range = {Spectrum(least[0]), Spectrum(most[0]), Spectrum(float(sum[0]))};
}

template class CachedTexels<1>;
template class CachedTexels<3>;

}  // namespace pt
