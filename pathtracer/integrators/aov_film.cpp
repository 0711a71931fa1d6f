#include "integrators/aov_film.h"

namespace pt {

AovFilm::AovFilm(int width, int height, const AovSelection& selection) : m_width(width), m_height(height) {
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  if (selection.albedo) m_albedo.assign(pixels, Imath::V3d(0.0));
  if (selection.normal) m_normal.assign(pixels, Imath::V3d(0.0));
  if (selection.depth) m_depth.assign(pixels, 0.0);
  m_samples.assign(pixels, 0);
  m_hits.assign(pixels, 0);
}

void AovFilm::add(int x, int y, const FirstHit& hit) noexcept {
  const std::size_t i = std::size_t(y) * std::size_t(m_width) + std::size_t(x);
  ++m_samples[i];
  if (!(hit.distance > 0)) return;
  ++m_hits[i];
  if (!m_albedo.empty()) m_albedo[i] += Imath::V3d(hit.albedo);
  if (!m_normal.empty()) m_normal[i] += Imath::V3d(hit.normal);
  if (!m_depth.empty()) m_depth[i] += double(hit.distance);
}

AovImages AovFilm::images() const {
  const auto meanImage = [&](const auto& sums, const std::vector<std::uint32_t>& counts) -> std::optional<Image> {
    if (sums.empty()) return std::nullopt;
    Image image(m_width, m_height);
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (counts[i] > 0) image.pixels[i] = Spectrum(Vec3(Imath::V3d(sums[i] / double(counts[i]))));
    return image;
  };
  AovImages images;
  images.albedo = meanImage(m_albedo, m_samples);
  images.normal = meanImage(m_normal, m_samples);
  images.depth = meanImage(m_depth, m_hits);
  return images;
}

}  // namespace pt
