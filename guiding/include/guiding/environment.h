#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "guiding/distribution.h"
#include "guiding/environment_layout.h"
#include "guiding/result.h"

namespace guiding {

/// An HDR map as light sampling sees it.
struct EnvironmentImage {
  EnvironmentLayout layout;
  std::span<const float> luminance;  ///< one per texel, row by row from the top; finite, >= 0
};

/// How the density of light sampling is sharpened against the BSDF sampling that it is combined with.
enum class EnvironmentCompensation {
  None,          ///< in proportion to the luminance L: for light sampling that is not MIS-weighted
  SubtractMean,  ///< ~ max(0, L - 2 (1 - c) mean), whatever the surface's normal [Karlík et al. 2019]
  WaterFilling,  ///< exact optimum for a BSDF sampler that is uniform over the sphere (see compensate())
};

struct EnvironmentSettings {
  EnvironmentCompensation compensation = EnvironmentCompensation::None;
  /// c: expected number of light samples of this environment divided by that of all samples, BSDF samples counted in.
  /// Range: (0, 1]; 1: nothing but light samples, so nothing is compensated.
  float lightShare = 0.5f;
};

/// What sharpening a map did.
struct EnvironmentSharpening {
  double mean = 0;         ///< of the luminance over the sphere
  double removedMass = 0;  ///< share of the map's light in texels that end up with density 0, in [0, 1]
  /// Nothing is left to sample: the map is black; or nearly constant (its standard deviation over the sphere is below
  /// 1% of its mean) or nowhere brighter than 2 (1 - c) times the mean, which BSDF sampling alone does best.
  bool empty = false;
};

/// Writes the luminance by which light sampling should go: that of the image sharpened, in proportions of a density
/// over the sphere (all 0 if `empty`). `out` has one value per texel and may be the image's own memory. Fails for sizes
/// that do not fit, luminances that are negative or not finite and settings out of range.
Result<EnvironmentSharpening> sharpenEnvironment(const EnvironmentImage& image, const EnvironmentSettings& settings,
                                                 std::span<float> out) noexcept;

/// Draws directions in proportion to an HDR map, bilinearly interpolated between the middles of its texels. A host that
/// looks its radiance up with EnvironmentLayout::footprint() gets from an uncompensated table a density that is
/// positive wherever there is radiance, and in proportion to it up to its colour.
///
/// Immutable and thread-safe; sampling allocates nothing.
class EnvironmentTable {
 public:
  /// Fails as sharpenEnvironment() does.
  static Result<EnvironmentTable> create(const EnvironmentImage& image, const EnvironmentSettings& settings = {});

  /// No direction can be sampled; the density is 0 everywhere.
  bool empty() const noexcept { return m_marginal.empty(); }

  /// Draws a unit direction in the space of the map; the density is that of the very float direction returned. Nearby u
  /// give nearby directions. u in [0,1)^2. pdf 0: no sample.
  DirectionSample sample(const Imath::V2f& u) const noexcept {
    const Imath::V3f wi = draw(u);
    return {wi, pdf(wi)};
  }

  /// Density of a unit direction per solid angle.
  float pdf(const Imath::V3f& direction) const noexcept { return pdf(m_layout.locate(direction)); }

  /// The same in two steps, for a host that turns directions or looks up radiance at the same point: a direction, and
  /// the density of one. Empty tables return any direction.
  Imath::V3f draw(const Imath::V2f& u) const noexcept;
  float pdf(const EnvironmentPoint& point) const noexcept;

  const EnvironmentLayout& layout() const noexcept { return m_layout; }
  const EnvironmentSharpening& sharpening() const noexcept { return m_sharpening; }
  std::size_t memoryBytes() const noexcept;

 private:
  EnvironmentTable(const EnvironmentLayout& layout, const EnvironmentSharpening& sharpening) noexcept
      : m_layout(layout), m_sharpening(sharpening) {}
  void build(std::span<const float> luminance);

  friend class EnvironmentProduct;
  /// Patches of the grid, the ends excluded.
  struct Patches {
    int x0, x1, y0, y1;
  };
  Patches allPatches() const noexcept;
  /// Draws among some patches only. marginal[y]: what the rows of patches before y weigh, within x0 and x1.
  Imath::V3f draw(const Patches& among, const double* marginal, const Imath::V2f& u) const noexcept;
  /// Integral of a row of patches from x0 to x1.
  double rowMass(int y, int x0, int x1) const noexcept;

  EnvironmentLayout m_layout;
  EnvironmentSharpening m_sharpening;
  // A grid of vertices, those inside the picture at the middles of texels; the density on the picture is bilinear
  // between them.
  std::size_t m_columns = 0;     ///< vertices in a row
  std::vector<float> m_density;  ///< per area of the picture
  // Sums of very unequal numbers, of which differences are taken.
  std::vector<double> m_conditional;  ///< integral of each row of vertices from the left edge to every vertex
  std::vector<double> m_marginal;     ///< integral of the density from the top edge to every row
};

}  // namespace guiding
