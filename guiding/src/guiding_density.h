#pragma once

#include <cstdint>
#include <vector>

#include "directional_quadtree.h"
#include "grid_geometry.h"
#include "guiding/detail/branchless.h"
#include "guiding/detail/grid.h"
#include "guiding/distribution.h"
#include "guiding/settings.h"

namespace guiding {

/// The frozen quadtrees of all spatial leaves: compensated, normalised, immutable, sampled lock-free.
///
/// The top three levels of a quadtree are one grid of 8 x 8 cells, found and sampled in one step each; the levels below
/// are nodes of four cells. Cells of a quadtree that are coarser than the grid are spread evenly over it.
class GuidingDensity {
 public:
  static constexpr std::uint32_t kNoGuide = ~0u;
  /// Flag of a tree's index in a leaf that does not offer it, because sampling the BSDF alone does as well.
  static constexpr std::uint32_t kResting = 1u << 31;

  /// Four cells, by conditional probabilities. A density is what these floats say: sample() and pdf() read the same
  /// ones, and the shares of siblings add up to 1 by construction.
  struct Node {
    float column0;        ///< probability of the half x < 1/2
    float row0[2];        ///< of the half y < 1/2, given either column
    QuadtreeLinks links;  ///< within the tree's nodes

    float share(int cell) const noexcept {
      const int column = cell & 1, row = cell >> 1;
      return mirroredIf(column, 1, column0) * mirroredIf(row, 1, row0[column]);
    }
  };

  /// One spatial leaf.
  struct Tree {
    Grid grid{};
    float bsdfSamplingFraction = 1;
    float emptyArea = 0;          ///< share of the sphere that compensation emptied
    std::uint32_t firstNode = 0;  ///< in the array of all trees' nodes
    std::uint32_t nodeCount = 0;
    std::uint64_t subdivided =
        0;  ///< bit 8 x + y: the grid cell goes on in a node; those nodes stand first, in this order

    bool isLeafCell(int cell) const noexcept { return !(subdivided >> cell & 1u); }
    std::uint32_t nodeOfCell(int cell) const noexcept {
      return std::uint32_t(__builtin_popcountll(subdivided & ((std::uint64_t(1) << cell) - 1)));
    }
  };

  explicit GuidingDensity(DirectionMap map) : m_map(map), m_geometry(map) {}

  /// Starts to bring a tree's grid and its first nodes near, while the host still evaluates its BSDF.
  void prefetch(std::uint32_t index) const noexcept {
    constexpr std::size_t kLine = 64, kNodeBytes = 512;
    // As numbers: nodes may be fewer than that, or none, and a pointer may not go beyond them.
    const auto fetch = [](const void* begin, std::size_t size) {
      for (std::size_t offset = 0; offset < size; offset += kLine)
        __builtin_prefetch(reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(begin) + offset));
    };
    fetch(&m_trees[index], sizeof(Tree));
    fetch(m_nodes.data() + m_trees[index].firstNode, kNodeBytes);
  }

  /// Draws from tree `index`. The density returned is that of the returned float direction.
  /// `grid` takes the place of the tree's own top where the density is bound to a shading point.
  DirectionSample sample(std::uint32_t index, const Grid& grid, const Imath::V2f& u) const noexcept;
  float pdf(std::uint32_t index, const Grid& grid, const Imath::V3f& wi) const noexcept;

  const GridGeometry& geometry() const noexcept { return m_geometry; }
  const Tree& tree(std::uint32_t index) const noexcept { return m_trees[index]; }
  const std::vector<Tree>& trees() const noexcept { return m_trees; }
  const std::vector<Node>& nodes() const noexcept { return m_nodes; }
  std::size_t memoryBytes() const noexcept {
    return m_nodes.capacity() * sizeof(Node) + m_trees.capacity() * sizeof(Tree);
  }
  /// Depth of the deepest cell of a tree; the grid alone is Grid::kDepth.
  int maxDepth(std::uint32_t index) const noexcept;

  /// Takes over trees and nodes that have been laid out already.
  void assign(std::vector<Tree> trees, std::vector<Node> nodes) noexcept {
    m_trees = std::move(trees);
    m_nodes = std::move(nodes);
  }

 private:
  DirectionMap m_map;
  GridGeometry m_geometry;
  std::vector<Tree> m_trees;
  std::vector<Node> m_nodes;
};

}  // namespace guiding
