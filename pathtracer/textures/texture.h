#pragma once

#include "core/types.h"

namespace pt {

/// Where a texture is read.
struct TexturePoint {
  Vec2 uv{0, 0};
  float width = 0;  ///< of a pixel of the picture, in units of uv; 0: as sharp as the texture goes
};

/// The values that a texture takes, before any factor.
struct TextureRange {
  Spectrum least{0.0f}, most{1.0f}, mean{0.5f};
};

/// Values over the surface. Immutable, thread-safe; looking up allocates nothing.
class Texture {
 public:
  virtual ~Texture() = default;

  virtual Spectrum color(const TexturePoint& point) const noexcept = 0;
  /// Luminance, where the texture has colours.
  virtual float number(const TexturePoint& point) const noexcept = 0;

  /// Derivatives of number() with respect to uv, at the finest level.
  virtual Vec2 gradient(const TexturePoint& point) const noexcept = 0;

  /// Bounds on what color() and number() can return.
  virtual TextureRange range() const noexcept = 0;
};

}  // namespace pt
