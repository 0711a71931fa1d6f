#include "directional_quadtree.h"

#include <cmath>

namespace guiding {

double DirectionalQuadtree::build() {
  // Parents stand before their children, so a backward sweep meets children first.
  for (std::size_t i = m_nodes.size(); i-- > 0;) {
    Node& node = m_nodes[i];
    for (int c = 0; c < 4; ++c) {
      if (node.links.isLeaf(c)) continue;
      const std::uint32_t child = node.links.childIndex(c);
      node.sum[c] = totalOf(m_nodes[child].sum);
      if (learnsBsdf()) m_bsdf[i][c] = totalOf(m_bsdf[child]);
    }
  }
  return flux();
}

void DirectionalQuadtree::add(const DirectionalQuadtree& other, double fluxFactor, double bsdfFactor) noexcept {
  addBelow(0, other, 0, fluxFactor, bsdfFactor);
}

void DirectionalQuadtree::addBelow(std::uint32_t node, const DirectionalQuadtree& other, std::uint32_t from,
                                   double fluxFactor, double bsdfFactor) noexcept {
  const QuadtreeLinks &links = m_nodes[node].links, &fromLinks = other.m_nodes[from].links;
  for (int c = 0; c < 4; ++c) {
    if (!links.isLeaf(c) && !fromLinks.isLeaf(c)) {
      addBelow(links.childIndex(c), other, fromLinks.childIndex(c), fluxFactor, bsdfFactor);
      continue;
    }
    const Learned cell = other.cellOf(from, c);
    addToCell(node, c, {cell.flux * fluxFactor, cell.bsdf * bsdfFactor});
  }
}

/// What falls on a subdivided cell is spread evenly below it.
void DirectionalQuadtree::addToCell(std::uint32_t node, int c, const Learned& learned) noexcept {
  const QuadtreeLinks& links = m_nodes[node].links;
  if (links.isLeaf(c)) {
    m_nodes[node].sum[c] += learned.flux;
    if (learnsBsdf()) m_bsdf[node][c] += learned.bsdf;
    return;
  }
  for (int below = 0; below < 4; ++below) addToCell(links.childIndex(c), below, {learned.flux / 4, learned.bsdf / 4});
}

DirectionalQuadtree DirectionalQuadtree::refined(double total, double threshold, int maxDepth) const {
  constexpr std::uint32_t kBelowLeaf = ~0u;
  struct Cell {
    std::uint32_t source;  ///< node of this tree, or kBelowLeaf
    std::array<double, 4> sum;
    int depth;  ///< of the node's cells
  };

  DirectionalQuadtree next;
  std::vector<Cell> cells{{0, m_nodes[0].sum, 1}};  // parallel to next.m_nodes
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell cell = cells[i];
    QuadtreeLinks links;
    links.startAt(cells.size());
    for (int c = 0; c < 4; ++c) {
      if (cell.depth >= maxDepth || !(cell.sum[c] > threshold * total)) continue;
      links.mask |= 1u << c;
      const bool continues = cell.source != kBelowLeaf && !m_nodes[cell.source].links.isLeaf(c);
      if (continues) {
        const std::uint32_t child = m_nodes[cell.source].links.childIndex(c);
        cells.push_back({child, m_nodes[child].sum, cell.depth + 1});
      } else {
        const double quarter = cell.sum[c] / 4;
        cells.push_back({kBelowLeaf, {quarter, quarter, quarter, quarter}, cell.depth + 1});
      }
      next.m_nodes.emplace_back();
    }
    next.m_nodes[i] = {cell.sum, links};
  }
  next.m_nodes.shrink_to_fit();
  if (learnsBsdf()) next.learnBsdf();
  return next;
}

double DirectionalQuadtree::densityAt(SquarePoint point) const noexcept {
  double total = 0;
  for (const Node& node : m_nodes)
    for (int c = 0; c < 4; ++c)
      if (node.links.isLeaf(c)) total += node.sum[c];
  if (!(total > 0)) return 0;

  std::uint32_t index = 0;
  for (int depth = 0;; ++depth) {
    const Node& node = m_nodes[index];
    const int cell = point.cellAt(depth);
    if (node.links.isLeaf(cell)) return std::ldexp(node.sum[cell] / total, 2 * (depth + 1));
    index = node.links.childIndex(cell);
  }
}

}  // namespace guiding
