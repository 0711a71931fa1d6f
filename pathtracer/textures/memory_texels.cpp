#include "textures/memory_texels.h"

#include <OpenImageIO/imagebufalgo.h>

#include "core/error.h"

namespace pt {

template <class Component, int Channels>
MemoryTexels<Component, Channels>::MemoryTexels(const PictureFile& picture)
    : m_srgb(picture.isSrgb()), m_table(makeByteTable(m_srgb)) {
  m_levels.push_back({picture.width(), picture.height(), picture.read<Component>()});
  if constexpr (std::is_same_v<Component, float>)
    if (m_srgb)
      for (float& x : m_levels[0].texels) x = srgbToLinear(x);
  findRange();
  for (int c = 0; c < 3; ++c)
    if (!std::isfinite(m_range.mean[c]))
      throw InputError(picture.key().file.string() + ": the picture has a NaN or infinite texel; mend it");
  if (picture.key().mipMapped) addCoarserLevels();
}

template <class Component, int Channels>
std::size_t MemoryTexels<Component, Channels>::memoryBytes() const noexcept {
  std::size_t bytes = 0;
  for (const Level& level : m_levels) bytes += level.texels.size() * sizeof(Component);
  return bytes;
}

template <class Component, int Channels>
Component MemoryTexels<Component, Channels>::encode(float x) const noexcept {
  if constexpr (std::is_same_v<Component, std::uint8_t>) {
    const float encoded = m_srgb ? linearToSrgb(x) : x;
    return std::uint8_t(std::clamp(encoded * 255 + 0.5f, 0.0f, 255.0f));
  } else {
    return Component(x);
  }
}

/// Means of the light, not of the encoded numbers.
template <class Component, int Channels>
void MemoryTexels<Component, Channels>::addCoarserLevels() {
  const auto spec = [](int width, int height) {
    return OIIO::ImageSpec(width, height, Channels, OIIO::TypeDesc::FLOAT);
  };
  std::vector<float> finer;
  for (const Component c : m_levels[0].texels) finer.push_back(decode(c));
  while (m_levels.back().width > 1 || m_levels.back().height > 1) {
    const int width = m_levels.back().width, height = m_levels.back().height;
    Level level{std::max(1, width / 2), std::max(1, height / 2), {}};
    std::vector<float> coarser(std::size_t(level.width) * std::size_t(level.height) * Channels);
    const OIIO::ImageBuf source(spec(width, height), finer.data());
    OIIO::ImageBuf target(spec(level.width, level.height), coarser.data());
    OIIO::ImageBufAlgo::resize(target, source, "box", 0, {}, 1);
    for (const float x : coarser) level.texels.push_back(encode(x));
    m_levels.push_back(std::move(level));
    finer = std::move(coarser);
  }
}

template <class Component, int Channels>
void MemoryTexels<Component, Channels>::findRange() {
  const std::vector<Component>& texels = m_levels[0].texels;
  for (int c = 0; c < Channels; ++c) {
    float least = std::numeric_limits<float>::infinity(), most = -least;
    double sum = 0;
    for (std::size_t i = std::size_t(c); i < texels.size(); i += Channels) {
      const float x = decode(texels[i]);
      least = std::min(least, x);
      most = std::max(most, x);
      sum += x;
    }
    m_range.least[c] = least;
    m_range.most[c] = most;
    m_range.mean[c] = float(sum / (double(texels.size()) / Channels));
  }
  if (Channels == 1) m_range = {Spectrum(m_range.least[0]), Spectrum(m_range.most[0]), Spectrum(m_range.mean[0])};
}

template class MemoryTexels<std::uint8_t, 1>;
template class MemoryTexels<std::uint8_t, 3>;
template class MemoryTexels<Imath::half, 1>;
template class MemoryTexels<Imath::half, 3>;
template class MemoryTexels<float, 1>;
template class MemoryTexels<float, 3>;

}  // namespace pt
