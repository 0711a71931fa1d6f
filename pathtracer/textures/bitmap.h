#pragma once

#include "textures/uv_map.h"

namespace pt {

/// How a bitmap is read.
struct BitmapLookup {
  UvMap uvMap;
  TextureFilter filter = TextureFilter::Bilinear;
  TextureWrap wrapU = TextureWrap::Repeat, wrapV = TextureWrap::Repeat;
};

/// A picture over texture coordinates in [0, 1]^2; v = 0 is its first line. Texels is MemoryTexels or CachedTexels.
template <class Texels>
class Bitmap final : public Texture {
 public:
  using Value = typename Texels::Value;

  Bitmap(std::shared_ptr<const Texels> texels, const BitmapLookup& lookup) noexcept
      : m_texels(std::move(texels)), m_lookup(lookup) {}

  Spectrum color(const TexturePoint& point) const noexcept override { return Spectrum(value(point)); }
  float number(const TexturePoint& point) const noexcept override { return brightness(value(point)); }

  Vec2 gradient(const TexturePoint& point) const noexcept override {
    if (m_lookup.filter == TextureFilter::Nearest) return {0, 0};
    const Vec2 uv = m_lookup.uvMap(point).uv;
    const int w = m_texels->width(0), h = m_texels->height(0);
    const Cell x = cell(uv.x, m_lookup.wrapU, w, 0.5f), y = cell(uv.y, m_lookup.wrapV, h, 0.5f);
    const auto height = [&](int dx, int dy) { return brightness(texel(0, x.index + dx, y.index + dy)); };
    const float h00 = height(0, 0), h10 = height(1, 0), h01 = height(0, 1), h11 = height(1, 1);
    return m_lookup.uvMap.gradient({((h10 - h00) * (1 - y.fraction) + (h11 - h01) * y.fraction) * float(w),
                                    ((h01 - h00) * (1 - x.fraction) + (h11 - h10) * x.fraction) * float(h)});
  }

  TextureRange range() const noexcept override {
    TextureRange range = m_texels->range();
    if (m_lookup.wrapU == TextureWrap::Black || m_lookup.wrapV == TextureWrap::Black)
      for (int c = 0; c < 3; ++c) {
        range.least[c] = std::min(range.least[c], 0.0f);
        range.most[c] = std::max(range.most[c], 0.0f);
      }
    return range;
  }

 private:
  static float brightness(float value) noexcept { return value; }
  static float brightness(const Spectrum& value) noexcept { return luminance(value); }

  Value value(const TexturePoint& point) const noexcept {
    const TexturePoint p = m_lookup.uvMap(point);
    if (m_lookup.filter == TextureFilter::Nearest) return nearest(p.uv);
    if (m_lookup.filter == TextureFilter::Bilinear) return bilinear(0, p.uv);
    const float texels = p.width * float(std::max(m_texels->width(0), m_texels->height(0)));
    const int coarsest = m_texels->levels() - 1;
    if (!(texels > 1) || coarsest == 0) return bilinear(0, p.uv);
    const float level = std::min(std::log2(texels), float(coarsest));
    const int finer = std::min(int(level), coarsest - 1);
    const float fraction = level - float(finer);
    return bilinear(finer, p.uv) * (1 - fraction) + bilinear(finer + 1, p.uv) * fraction;
  }

  Value nearest(const Vec2& uv) const noexcept {
    const int w = m_texels->width(0), h = m_texels->height(0);
    return texel(0, cell(uv.x, m_lookup.wrapU, w, 0).index, cell(uv.y, m_lookup.wrapV, h, 0).index);
  }

  Value bilinear(int level, const Vec2& uv) const noexcept {
    const int w = m_texels->width(level), h = m_texels->height(level);
    const Cell x = cell(uv.x, m_lookup.wrapU, w, 0.5f), y = cell(uv.y, m_lookup.wrapV, h, 0.5f);
    const int x1 = x.index + 1, y1 = y.index + 1;
    return (texel(level, x.index, y.index) * (1 - x.fraction) + texel(level, x1, y.index) * x.fraction) *
               (1 - y.fraction) +
           (texel(level, x.index, y1) * (1 - x.fraction) + texel(level, x1, y1) * x.fraction) * y.fraction;
  }

  struct Cell {
    int index;
    float fraction;
  };

  /// The texel below a coordinate, in [-1, size], and how far above it the coordinate lies.
  static Cell cell(float u, TextureWrap wrap, int size, float center) noexcept {
    switch (wrap) {
      case TextureWrap::Repeat:
        u -= std::floor(u);
        break;
      case TextureWrap::Mirror:
        u = std::abs(u - 2 * std::floor(0.5f * u + 0.5f));
        break;
      case TextureWrap::Clamp:
        u = std::clamp(u, 0.0f, 1.0f);
        break;
      case TextureWrap::Black:
        u = std::clamp(u, -1.0f, 2.0f);
        break;
    }
    const float n = float(size), x = u * n - center;
    const float within = x >= -1 ? std::min(x, n) : -1.0f;  // also for NaN
    const float low = std::floor(within);
    return {int(low), within - low};
  }

  /// x and y in [-1, size + 1].
  Value texel(int level, int x, int y) const noexcept {
    const int w = m_texels->width(level), h = m_texels->height(level);
    const bool outside = unsigned(x) >= unsigned(w) || unsigned(y) >= unsigned(h);
    if (outside) [[unlikely]] {
      x = wrapped(x, w, m_lookup.wrapU);
      y = wrapped(y, h, m_lookup.wrapV);
      if (x < 0 || y < 0) return Value(0.0f);
    }
    return (*m_texels)(level, x, y);
  }

  /// -1 for nothing.
  static int wrapped(int i, int size, TextureWrap wrap) noexcept {
    if (i >= 0 && i < size) return i;
    if (wrap == TextureWrap::Black) return -1;
    if (wrap == TextureWrap::Repeat) return i < 0 ? size - 1 : (i - size) % size;
    return i < 0 ? 0 : size - 1;
  }

  std::shared_ptr<const Texels> m_texels;
  BitmapLookup m_lookup;
};

}  // namespace pt
