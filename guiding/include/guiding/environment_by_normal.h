#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "guiding/environment.h"

namespace guiding {

/// A table's density multiplied by the cosine for every direction of a surface's normal.
///
/// Normals fall into bins of five degrees, the picture into some hundreds of blocks, and a bin holds a mass for every
/// block: the table's, times the mean cosine. Within a block the density is the table's.
///
/// Immutable and thread-safe; sampling allocates nothing.
class EnvironmentProduct {
 public:
  /// `table` is not empty and outlives this. Fails for want of memory.
  static Result<EnvironmentProduct> create(const EnvironmentTable& table);

  /// The bin of a unit normal in the space of the map.
  std::uint32_t bin(const Imath::V3f& normal) const noexcept;

  /// As those of EnvironmentTable.
  DirectionSample sample(std::uint32_t bin, const Imath::V2f& u) const noexcept {
    const Imath::V3f wi = draw(bin, u);
    return {wi, pdf(bin, wi)};
  }
  float pdf(std::uint32_t bin, const Imath::V3f& direction) const noexcept {
    return pdf(bin, m_table->layout().locate(direction));
  }
  Imath::V3f draw(std::uint32_t bin, const Imath::V2f& u) const noexcept;
  float pdf(std::uint32_t bin, const EnvironmentPoint& point) const noexcept;

  /// Mean over the table's density of the cosine, clipped at the horizon, for the normals of a bin.
  float meanCosine(std::uint32_t bin) const noexcept { return m_meanCosine[bin]; }

  std::size_t memoryBytes() const noexcept;

 private:
  struct Moments;
  struct Block;

  friend class EnvironmentByNormal;
  /// The table has been moved there.
  void moveTo(const EnvironmentTable& table) noexcept { m_table = &table; }

  explicit EnvironmentProduct(const EnvironmentTable& table) noexcept : m_table(&table) {}
  void partition();
  void fillBins();
  void storeBin(int bin, const std::vector<double>& masses);
  std::vector<Block> lookAtBlocks() const;

  std::size_t blockOf(int patchX, int patchY) const noexcept {
    return std::size_t(m_rowOf[std::size_t(patchY)]) * std::size_t(m_columns) + m_columnOf[std::size_t(patchX)];
  }
  const double* marginalOf(int column) const noexcept { return &m_marginal[std::size_t(column) * m_marginalSize]; }

  /// Masses of a bin's blocks, summed up: rows first, then the blocks of each row.
  const float* massesOf(std::uint32_t bin) const noexcept { return m_masses.data() + bin * m_binSize; }
  const float* blocksOf(std::uint32_t bin, int row) const noexcept {
    return massesOf(bin) + (m_rows + 1) + row * (m_columns + 1);
  }

  const EnvironmentTable* m_table;
  int m_columns = 0, m_rows = 0;                  ///< of blocks
  std::vector<int> m_firstX, m_firstY;            ///< first patch of every column and row of blocks, and the end
  std::vector<std::uint8_t> m_columnOf, m_rowOf;  ///< of a patch
  std::size_t m_marginalSize = 0;
  std::vector<double> m_marginal;    ///< of the table, for each column of blocks by itself
  std::vector<float> m_inverseMass;  ///< 1 / the table's mass of a block; 0 for an empty one
  std::size_t m_binSize = 0;
  std::vector<float> m_masses;
  std::vector<float> m_meanCosine;  ///< of every bin
};

/// The normal-dependent form of MIS compensation: q(w|n) ~ cos max(0, L(w) - (1 - c) E(n)/pi), with the irradiance E(n)
/// of a surface of normal n [Karlík et al. 2019, Eq. 13, the clipping inside of the cosine]. For a diffuse surface; any
/// other that reflects to the side of its normal may use it too.
///
/// Two tables do for all normals, less 1 - c and 2 (1 - c) times the map's mean: for each normal the one whose amount
/// is nearer to (1 - c) E(n)/pi. Against the best amount for each normal they lose a few per cent.
///
/// Immutable and thread-safe; sampling allocates nothing.
class EnvironmentByNormal {
 public:
  /// `complete` is the table of the image without compensation. lightShare c: see EnvironmentSettings. Fails as
  /// EnvironmentTable::create() does.
  static Result<EnvironmentByNormal> create(const EnvironmentImage& image, const EnvironmentTable& complete,
                                            float lightShare);

  /// Nothing is left that light sampling does better than sampling the BSDF alone.
  bool empty() const noexcept { return !m_less; }

  /// For surfaces that light reaches from both sides. Requires that this is not empty.
  const EnvironmentTable& table() const noexcept { return (m_more ? m_more : m_less)->table; }

  // The others require it too, and mean the same as EnvironmentProduct's.
  std::uint32_t bin(const Imath::V3f& normal) const noexcept {
    const std::uint32_t bin = m_less->product.bin(normal);
    return m_takesMore[bin] ? bin | kMore : bin;
  }
  DirectionSample sample(std::uint32_t bin, const Imath::V2f& u) const noexcept {
    return product(bin).sample(bin & ~kMore, u);
  }
  Imath::V3f draw(std::uint32_t bin, const Imath::V2f& u) const noexcept { return product(bin).draw(bin & ~kMore, u); }
  float pdf(std::uint32_t bin, const Imath::V3f& direction) const noexcept {
    return product(bin).pdf(bin & ~kMore, direction);
  }
  float pdf(std::uint32_t bin, const EnvironmentPoint& point) const noexcept {
    return product(bin).pdf(bin & ~kMore, point);
  }

  std::size_t memoryBytes() const noexcept;

 private:
  struct Level {
    EnvironmentTable table;
    EnvironmentProduct product;  ///< of that table
  };
  static constexpr std::uint32_t kMore = 1u << 31;  ///< flag of a bin

  static Result<std::unique_ptr<const Level>> makeLevel(const EnvironmentImage& image, float lightShare);
  const EnvironmentProduct& product(std::uint32_t bin) const noexcept {
    return (bin & kMore ? m_more : m_less)->product;
  }

  std::unique_ptr<const Level> m_less, m_more;  ///< by how much is subtracted; null: nothing is left
  std::vector<std::uint8_t> m_takesMore;        ///< of every bin
};

}  // namespace guiding
