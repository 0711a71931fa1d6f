#pragma once

#include <ImathBox.h>
#include <ImathVec.h>

#include <cstdint>
#include <vector>

namespace guiding {

/// Binary tree over a cube: midpoint splits along x, y, z in turn [Müller et al. 2017, Sec. 3.1].
///
/// A position becomes one interleaved code whose bits, from the top, are the decisions from the root down.
class SpatialTree {
 public:
  static constexpr int kBitsPerAxis = 21;
  static constexpr int kMaxDepth = 3 * kBitsPerAxis;
  static constexpr std::uint32_t kMaxLeaves = 1u << 30;  ///< 31 bits number the nodes

  /// One leaf, index 0. `bounds` is enlarged to a cube from its lower corner.
  explicit SpatialTree(const Imath::Box3f& bounds);

  /// Index of the leaf that contains the point; points outside belong to the nearest leaf.
  std::uint32_t leafAt(const Imath::V3f& position) const noexcept {
    std::uint64_t code = codeOf(position);
    std::uint32_t word = m_nodes[m_entries[code >> (64 - kEntryDepth)]];
    for (code <<= kEntryDepth; !(word & kLeafBit); code <<= 1) word = m_nodes[word + std::uint32_t(code >> 63)];
    return word & ~kLeafBit;
  }

  /// Edge lengths of a leaf.
  Imath::V3f leafSize(std::uint32_t leaf) const noexcept;
  /// The middle of every leaf.
  std::vector<Imath::V3f> leafCentres() const;

  bool contains(const Imath::V3f& position) const noexcept { return m_bounds.intersects(position); }
  const Imath::Box3f& bounds() const noexcept { return m_bounds; }  ///< the cube

  std::uint32_t leafCount() const noexcept { return m_leafCount; }
  std::size_t memoryBytes() const noexcept {
    return (m_nodes.capacity() + m_entries.capacity()) * sizeof(std::uint32_t) + m_depths.capacity();
  }
  int maxDepth() const noexcept;
  const std::vector<std::uint8_t>& leafDepths() const noexcept { return m_depths; }  ///< splits above each leaf

  /// Replaces every leaf i by 2^levels[i] leaves, at most kMaxLeaves in all. Returns for each new leaf the old leaf it
  /// came from; the first child of a split leaf keeps its index.
  std::vector<std::uint32_t> split(const std::vector<int>& levels);

  /// Node words: kLeafBit | leaf index, or the index of the first of two children. For writing and reading fields.
  const std::vector<std::uint32_t>& nodes() const noexcept { return m_nodes; }
  /// False (and unchanged) if the words are no tree with leaves 0..n-1.
  bool assignNodes(std::vector<std::uint32_t> nodes);

  static constexpr std::uint32_t kLeafBit = 0x80000000u;

 private:
  /// Levels that a look-up passes at once.
  static constexpr int kEntryDepth = 12;

  std::uint64_t codeOf(const Imath::V3f& position) const noexcept;
  void index();
  void indexBelow(std::uint32_t node, int depth, std::uint32_t prefix);
  void centresBelow(std::uint32_t node, int depth, const Imath::Box3f& box, std::vector<Imath::V3f>& centres) const;

  Imath::Box3f m_bounds;
  float m_scale;  ///< cells per unit length at full depth
  std::vector<std::uint32_t> m_nodes{kLeafBit};
  std::uint32_t m_leafCount = 1;
  std::vector<std::uint32_t>
      m_entries;                       ///< by the first bits of the code: the node at that depth, or the leaf above it
  std::vector<std::uint8_t> m_depths;  ///< of every leaf
};

/// Spreads the low 21 bits of x to every third bit.
inline std::uint64_t spreadBits3(std::uint64_t x) noexcept {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x001f00000000ffffull;
  x = (x | x << 16) & 0x001f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  x = (x | x << 2) & 0x1249249249249249ull;
  return x;
}

inline std::uint64_t SpatialTree::codeOf(const Imath::V3f& position) const noexcept {
  constexpr float kMax = float((1 << kBitsPerAxis) - 1);
  const auto cell = [&](int axis) {
    const float x = (position[axis] - m_bounds.min[axis]) * m_scale;
    return spreadBits3(std::uint64_t(x > 0 ? (x < kMax ? x : kMax) : 0.0f));  // NaN goes to 0
  };
  return (cell(0) << 2 | cell(1) << 1 | cell(2)) << 1;
}

}  // namespace guiding
