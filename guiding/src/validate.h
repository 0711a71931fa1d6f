#pragma once

#include "field_state.h"

namespace guiding {

/// Field::validate().
Status validateState(const Field::State& state);

/// Links of a breadth-first forest of `count` nodes whose first `roots` nodes are the roots, with cells at `rootDepth`:
/// every other node is the child of exactly one node before it, and no cell is deeper than `maxDepth`. Works for both
/// kinds of quadtree node.
template <class Node>
bool linksAreSound(const Node* nodes, std::size_t count, std::size_t roots, int rootDepth, int maxDepth) {
  if (roots > count) return false;
  std::vector<int> depth(count, rootDepth);
  std::size_t next = roots;
  for (std::size_t i = 0; i < count; ++i) {
    const QuadtreeLinks links = nodes[i].links;
    if (links.mask == 0) continue;
    if (links.first != next || depth[i] >= maxDepth) return false;
    for (int c = 0; c < 4; ++c) {
      if (links.isLeaf(c)) continue;
      if (next >= count) return false;
      depth[next++] = depth[i] + 1;
    }
  }
  return next == count;
}

}  // namespace guiding
