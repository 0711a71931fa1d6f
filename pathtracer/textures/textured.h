#pragma once

#include <type_traits>

#include "scene/interaction.h"
#include "textures/texture.h"

namespace pt {

/// A parameter of a material or a light: a constant, or a texture times a constant factor.
template <class T>
class Textured {
 public:
  Textured() = default;
  Textured(const T& value, const Texture* texture = nullptr) noexcept : m_value(value), m_texture(texture) {}

  T operator()(const TexturePoint& point) const noexcept {
    if (!m_texture) [[likely]]
      return m_value;
    if constexpr (std::is_same_v<T, float>)
      return m_value * m_texture->number(point);
    else
      return m_value * m_texture->color(point);
  }
  T operator()(const SurfaceInteraction& si) const noexcept {
    if (!m_texture) [[likely]]
      return m_value;
    return operator()(TexturePoint{si.uv, si.uvWidth});
  }

  bool isConstant() const noexcept { return !m_texture; }
  T least() const noexcept { return scaled(m_texture ? m_texture->range().least : Spectrum(1.0f)); }
  T most() const noexcept { return scaled(m_texture ? m_texture->range().most : Spectrum(1.0f)); }
  T mean() const noexcept { return scaled(m_texture ? m_texture->range().mean : Spectrum(1.0f)); }

  bool operator==(const Textured& other) const = default;

 private:
  T scaled(const Spectrum& value) const noexcept {
    if constexpr (std::is_same_v<T, float>)
      return m_value * luminance(value);
    else
      return m_value * value;
  }

  T m_value{};
  const Texture* m_texture = nullptr;
};

using TexturedSpectrum = Textured<Spectrum>;
using TexturedFloat = Textured<float>;

}  // namespace pt
