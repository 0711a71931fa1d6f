#include "spatial_tree.h"

#include <algorithm>
#include <bit>

namespace guiding {

SpatialTree::SpatialTree(const Imath::Box3f& bounds) : m_bounds(bounds) {
  const Imath::V3f size = bounds.size();
  float extent = std::max({size.x, size.y, size.z});
  if (!(extent > 0)) extent = 1;
  m_bounds.max = m_bounds.min + Imath::V3f(extent);
  m_scale = float(1 << kBitsPerAxis) / extent;
  index();
}

Imath::V3f SpatialTree::leafSize(std::uint32_t leaf) const noexcept {
  Imath::V3f size = m_bounds.size();
  for (int axis = 0; axis < 3; ++axis) {
    const int halvings = (m_depths[leaf] + 2 - axis) / 3;
    size[axis] *= std::bit_cast<float>(std::uint32_t(127 - halvings) << 23);  // 2^-halvings
  }
  return size;
}

std::vector<Imath::V3f> SpatialTree::leafCentres() const {
  std::vector<Imath::V3f> centres(m_leafCount);
  centresBelow(0, 0, m_bounds, centres);
  return centres;
}

void SpatialTree::centresBelow(std::uint32_t node, int depth, const Imath::Box3f& box,
                               std::vector<Imath::V3f>& centres) const {
  const std::uint32_t word = m_nodes[node];
  if (word & kLeafBit) {
    centres[word & ~kLeafBit] = box.center();
    return;
  }
  const int axis = depth % 3;
  Imath::Box3f lower = box, upper = box;
  lower.max[axis] = upper.min[axis] = box.center()[axis];
  centresBelow(word, depth + 1, lower, centres);
  centresBelow(word + 1, depth + 1, upper, centres);
}

int SpatialTree::maxDepth() const noexcept {
  return *std::max_element(m_depths.begin(), m_depths.end());
}

void SpatialTree::index() {
  m_entries.resize(std::size_t(1) << kEntryDepth);
  m_depths.resize(m_leafCount);
  indexBelow(0, 0, 0);
}

/// `prefix`: the decisions from the root down to the node.
void SpatialTree::indexBelow(std::uint32_t node, int depth, std::uint32_t prefix) {
  const std::uint32_t word = m_nodes[node];
  const bool isLeaf = word & kLeafBit;
  if (isLeaf) m_depths[word & ~kLeafBit] = std::uint8_t(depth);
  if (depth == kEntryDepth) m_entries[prefix] = node;
  if (isLeaf && depth < kEntryDepth) {
    const std::size_t count = std::size_t(1) << (kEntryDepth - depth);
    std::fill_n(m_entries.begin() + std::ptrdiff_t(prefix * count), count, node);
  }
  if (isLeaf) return;
  indexBelow(word, depth + 1, prefix * 2);
  indexBelow(word + 1, depth + 1, prefix * 2 + 1);
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
  index();
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
  index();
  return true;
}

}  // namespace guiding
