#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "sphere_map.h"

namespace guiding {

/// Four child slots of a quadtree node. Children that are themselves subdivided stand together in the node array.
struct QuadtreeLinks {
  std::uint32_t first : 28 = 0;  ///< index of the first subdivided child
  std::uint32_t mask : 4 = 0;    ///< bit c: child c is subdivided

  /// Throws std::length_error for more nodes than a tree can have.
  void startAt(std::size_t child) {
    if (child >= 1u << 28) throw std::length_error("more nodes in a quadtree than 28 bits count");
    first = std::uint32_t(child) & 0xfffffffu;
  }
  bool isLeaf(int child) const noexcept { return !(mask >> child & 1u); }
  std::uint32_t childIndex(int child) const noexcept {
    return first + std::uint32_t(__builtin_popcount(mask & ((1u << child) - 1u)));
  }
};

/// The quadtree that learns: flux per cell, as sums over recorded samples. Never compensated, never sampled.
class DirectionalQuadtree {
 public:
  struct Node {
    std::array<double, 4> sum{};  ///< filled for leaf cells while learning; for all cells after build()
    QuadtreeLinks links;
  };

  /// One node: four cells.
  DirectionalQuadtree() : m_nodes(1) {}

  /// Adds `value` to the leaf cell that contains the point.
  void splat(SquarePoint point, double value) noexcept {
    std::uint32_t index = 0;
    for (int depth = 0;; ++depth) {
      Node& node = m_nodes[index];
      const int cell = point.cellAt(depth);
      if (node.links.isLeaf(cell)) {
        node.sum[cell] += value;
        return;
      }
      index = node.links.childIndex(cell);
    }
  }

  /// From now on learns the BSDF's density beside the flux.
  void learnBsdf() { m_bsdf.resize(m_nodes.size()); }
  bool learnsBsdf() const noexcept { return !m_bsdf.empty(); }
  /// Depth of the leaf cell that contains the point; 1: a quarter of the square.
  int depthAt(SquarePoint point) const noexcept {
    std::uint32_t index = 0;
    for (int depth = 0;; ++depth) {
      const QuadtreeLinks links = m_nodes[index].links;
      const int cell = point.cellAt(depth);
      if (links.isLeaf(cell)) return depth + 1;
      index = links.childIndex(cell);
    }
  }
  /// Adds `value` to what the leaf cell that contains the point has of the BSDF's density. Returns depthAt(point).
  int splatBsdf(SquarePoint point, double value) noexcept {
    std::uint32_t index = 0;
    for (int depth = 0;; ++depth) {
      const QuadtreeLinks links = m_nodes[index].links;
      const int cell = point.cellAt(depth);
      if (links.isLeaf(cell)) {
        m_bsdf[index][cell] += value;
        return depth + 1;
      }
      index = links.childIndex(cell);
    }
  }
  /// By node, as the flux; empty unless learned.
  const std::vector<std::array<double, 4>>& bsdfSums() const noexcept { return m_bsdf; }
  std::vector<std::array<double, 4>>& bsdfSums() noexcept { return m_bsdf; }

  /// Sums the leaf cells into their parents and returns the total flux.
  double build();
  /// All flux, and all of the BSDF's density; require build().
  double flux() const noexcept { return totalOf(m_nodes[0].sum); }
  double bsdf() const noexcept { return learnsBsdf() ? totalOf(m_bsdf[0]) : 0; }

  /// Adds what another tree learned, times these factors, to the leaf cells: the sums of its finer cells, and of its
  /// coarser ones what falls on each cell if they are evenly filled. Requires build() of the other tree, and of this
  /// one afterwards.
  void add(const DirectionalQuadtree& other, double fluxFactor, double bsdfFactor) noexcept;

  /// The tree to learn into next: cells with more than `threshold` of the total flux are subdivided, up to `maxDepth`;
  /// those with less are merged; below a former leaf the flux counts as evenly spread [Müller et al. 2017, Sec. 3.2].
  /// It still shows the flux, but not the BSDF's density. Requires build() and a positive total.
  DirectionalQuadtree refined(double total, double threshold, int maxDepth) const;

  void clear() noexcept {
    for (Node& node : m_nodes) node.sum = {};
    for (auto& sums : m_bsdf) sums = {};
  }
  /// Share of all flux per unit area of the square, at a point; 0 without flux.
  double densityAt(SquarePoint point) const noexcept;

  const std::vector<Node>& nodes() const noexcept { return m_nodes; }
  std::vector<Node>& nodes() noexcept { return m_nodes; }
  std::size_t memoryBytes() const noexcept {
    return m_nodes.capacity() * sizeof(Node) + m_bsdf.capacity() * sizeof(m_bsdf[0]);
  }

 private:
  /// Of one cell.
  struct Learned {
    double flux, bsdf;
  };
  static double totalOf(const std::array<double, 4>& sum) noexcept { return (sum[0] + sum[1]) + (sum[2] + sum[3]); }
  Learned cellOf(std::uint32_t node, int c) const noexcept {
    return {m_nodes[node].sum[c], learnsBsdf() ? m_bsdf[node][c] : 0};
  }
  void addToCell(std::uint32_t node, int c, const Learned& learned) noexcept;
  void addBelow(std::uint32_t node, const DirectionalQuadtree& other, std::uint32_t from, double fluxFactor,
                double bsdfFactor) noexcept;

  std::vector<Node> m_nodes;  ///< root first, parents before children
  std::vector<std::array<double, 4>>
      m_bsdf;  ///< sums of the BSDF's density over the density of the samples; for all cells after build()
};

}  // namespace guiding
