#include "bind_grid.h"

#include <bit>
#include <limits>

#include "water_level.h"

namespace guiding {

namespace {

struct PlainSum {
  Float8 sum{};
  void add(const Float8& x) noexcept { sum += x; }
  float total() const noexcept { return sumOfLanes(sum); }
};

/// Scales to a sum of 1; false if there is nothing to scale.
bool normalise(GridRows& rows) noexcept {
  PlainSum sum;
  for (const Float8& row : rows) sum.add(row);
  const float total = sum.total();
  if (!(total > std::numeric_limits<float>::min() && total <= std::numeric_limits<float>::max())) return false;
  const float scale = 1 / total;
  for (Float8& row : rows) row *= scale;
  return true;
}

/// target (normalised) becomes the free technique's masses. Same equations as compensate() in mis.h.
bool compensateGrid(GridRows& target, const GridRows& other, CompensationForm form, float alpha) noexcept {
  if (form == CompensationForm::None || !(alpha > 0)) return true;
  const auto forEachCells = [&](auto&& visit) {
    for (int x = 0; x < Grid::kSize; ++x) visit(target[x], other[x]);
  };
  const float lambda =
      form == CompensationForm::WaterFilling ? waterLevel<Float8, PlainSum, float>(forEachCells, alpha) : 1.0f;
  const float inverse = 1 / lambda;
  for (int x = 0; x < Grid::kSize; ++x) {
    target[x] = target[x] * inverse - other[x] * alpha;
    atLeast(target[x], Float8{});
  }
  return normalise(target);
}

/// Cell means of BSDF * cos (up to a factor) and of the BSDF sampler's density.
void describe(const GridGeometry& geometry, std::span<const Lobe> lobes, GridRows& reflected,
              GridRows& sampled) noexcept {
  reflected.fill(Float8{});
  sampled.fill(Float8{});
  GridRows shares;
  for (const Lobe& lobe : lobes) {
    geometry.lobeShares(lobe, shares);
    for (int x = 0; x < Grid::kSize; ++x) {
      reflected[x] += shares[x] * lobe.reflectance;
      sampled[x] += shares[x] * lobe.samplingShare;
    }
  }
}

}  // namespace

bool bindGrid(const GridGeometry& geometry, const Grid& learned, std::span<const Lobe> lobes, CompensationForm form,
              float assumedFraction, Grid& out) noexcept {
  GridRows target, sampled;
  if (lobes.empty()) {
    target.fill(Float8{} + 1.0f / Grid::kCells);
    sampled = target;
  } else {
    describe(geometry, lobes, target, sampled);
  }
  for (int x = 0; x < Grid::kSize; ++x)
    target[x] *= std::bit_cast<Float8>(learned.upTo[x + 1]) - std::bit_cast<Float8>(learned.upTo[x]);

  if (!normalise(target)) return false;
  if (!compensateGrid(target, sampled, form, assumedFraction)) return false;
  out.assign(std::bit_cast<std::array<Grid::Row, Grid::kSize>>(target));
  return true;
}

}  // namespace guiding
