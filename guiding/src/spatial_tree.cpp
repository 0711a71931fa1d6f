#include "spatial_tree.h"

#include <algorithm>

namespace guiding {

SpatialTree::SpatialTree(const Imath::Box3f& bounds) : m_bounds(bounds) {
  const Imath::V3f size = bounds.size();
  float extent = std::max({size.x, size.y, size.z});
  if (!(extent > 0)) extent = 1;
  m_bounds.max = m_bounds.min + Imath::V3f(extent);
  m_scale = float(1 << kBitsPerAxis) / extent;
}

Imath::V3f SpatialTree::leafSizeAt(const Imath::V3f& position) const noexcept {
  std::uint64_t code = codeOf(position);
  std::uint32_t node = 0;
  Imath::V3f size = m_bounds.size();
  for (int axis = 0; !(m_nodes[node] & kLeafBit); axis = axis == 2 ? 0 : axis + 1) {
    size[axis] *= 0.5f;
    node = m_nodes[node] + std::uint32_t(code >> 63);
    code <<= 1;
  }
  return size;
}

int SpatialTree::depthBelow(std::uint32_t node) const noexcept {
  const std::uint32_t word = m_nodes[node];
  return word & kLeafBit ? 0 : 1 + std::max(depthBelow(word), depthBelow(word + 1));
}

std::vector<int> SpatialTree::leafDepths() const {
  std::vector<int> depth(m_nodes.size(), 0), ofLeaf(m_leafCount);
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {  // children stand behind their parents
    const std::uint32_t word = m_nodes[i];
    if (word & kLeafBit)
      ofLeaf[word & ~kLeafBit] = depth[i];
    else
      depth[word] = depth[word + 1] = depth[i] + 1;
  }
  return ofLeaf;
}

std::vector<std::uint32_t> SpatialTree::split(const std::vector<int>& levels) {
  std::vector<std::uint32_t> origin(m_leafCount);
  for (std::uint32_t i = 0; i < m_leafCount; ++i) origin[i] = i;

  std::vector<int> depth(m_nodes.size(), 0), remaining(m_nodes.size(), -1);
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {  // grows as leaves split
    const std::uint32_t word = m_nodes[i];
    if (!(word & kLeafBit)) {
      depth[word] = depth[word + 1] = depth[i] + 1;
      continue;
    }
    const std::uint32_t leaf = word & ~kLeafBit;
    const int left = remaining[i] >= 0 ? remaining[i] : levels[leaf];
    if (left == 0 || depth[i] >= kMaxDepth) continue;
    m_nodes[i] = std::uint32_t(m_nodes.size());
    m_nodes.push_back(kLeafBit | leaf);
    m_nodes.push_back(kLeafBit | m_leafCount++);
    origin.push_back(origin[leaf]);
    depth.insert(depth.end(), 2, depth[i] + 1);
    remaining.insert(remaining.end(), 2, left - 1);
  }
  return origin;
}

bool SpatialTree::assignNodes(std::vector<std::uint32_t> nodes) {
  if (nodes.empty()) return false;
  std::vector<int> depth(nodes.size(), -1);
  depth[0] = 0;
  std::vector<bool> seen;
  std::uint32_t leaves = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (depth[i] < 0 || depth[i] > kMaxDepth) return false;
    if (nodes[i] & kLeafBit) {
      const std::uint32_t leaf = nodes[i] & ~kLeafBit;
      if (leaf >= nodes.size()) return false;
      if (seen.size() <= leaf) seen.resize(leaf + 1, false);
      if (seen[leaf]) return false;
      seen[leaf] = true;
      ++leaves;
      continue;
    }
    const std::size_t child = nodes[i];
    if (child <= i || child + 1 >= nodes.size() || depth[child] >= 0 || depth[child + 1] >= 0) return false;
    depth[child] = depth[child + 1] = depth[i] + 1;
  }
  if (leaves != seen.size()) return false;
  m_nodes = std::move(nodes);
  m_leafCount = leaves;
  return true;
}

}  // namespace guiding
