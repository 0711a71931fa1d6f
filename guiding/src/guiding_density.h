#pragma once

#include <cstdint>
#include <vector>

#include "directional_quadtree.h"
#include "guiding/distribution.h"
#include "guiding/settings.h"

namespace guiding {

/// The frozen quadtrees of all spatial leaves: compensated, normalised, immutable, sampled lock-free.
class GuidingDensity {
 public:
  static constexpr std::uint32_t kNoGuide = ~0u;

  struct Node {
    float share[4];       ///< of the node's mass, cells x + 2 y; they sum to 1
    QuadtreeLinks links;
  };

  /// One spatial leaf's share of the node array.
  struct Tree {
    std::uint32_t root = 0;
    std::uint32_t nodeCount = 0;
    float bsdfSamplingFraction = 1;
    float emptyArea = 0;  ///< share of the sphere where the density is zero
  };

  GuidingDensity() = default;
  explicit GuidingDensity(DirectionMap map) : m_map(map) {}

  /// Draws from tree `index`. The density returned is that of the returned float direction.
  DirectionSample sample(std::uint32_t index, const Imath::V2f& u) const noexcept;
  float pdf(std::uint32_t index, const Imath::V3f& wi) const noexcept;

  const Tree& tree(std::uint32_t index) const noexcept { return m_trees[index]; }
  const std::vector<Tree>& trees() const noexcept { return m_trees; }
  const std::vector<Node>& nodes() const noexcept { return m_nodes; }
  std::size_t memoryBytes() const noexcept { return m_nodes.capacity() * sizeof(Node) + m_trees.capacity() * sizeof(Tree); }
  int maxDepth(std::uint32_t index) const;

  /// Takes over trees and nodes whose roots and links have been laid out already.
  void assign(std::vector<Tree> trees, std::vector<Node> nodes) {
    m_trees = std::move(trees);
    m_nodes = std::move(nodes);
  }

 private:
  float squareDensity(const Node* root, SquarePoint point) const noexcept;

  DirectionMap m_map = DirectionMap::Cylinder;
  std::vector<Tree> m_trees;
  std::vector<Node> m_nodes;
};

/// One spatial leaf, frozen: links are relative to its root. No nodes: nothing to guide with.
struct FrozenTree {
  std::vector<GuidingDensity::Node> nodes;
  float emptyArea = 0;
};

/// Freezes a built quadtree: compensates its leaf cells against a uniform density, then sums up.
/// `assumedFraction` is the BSDF share that is compensated for, never above the share that is sampled.
FrozenTree freeze(const DirectionalQuadtree& learned, CompensationForm form, float assumedFraction);

}  // namespace guiding
