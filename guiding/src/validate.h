#pragma once

#include "field_state.h"

namespace guiding {

/// Field::validate().
Status validateState(const Field::State& state);

/// Links of a tree of `count` nodes: every node but the root is the child of exactly one node before it, and no deeper than `maxDepth`.
/// Works for both kinds of quadtree node.
template <class Node>
bool linksAreSound(const Node* nodes, std::size_t count, int maxDepth) {
  std::vector<int> depth(count, 0);
  std::size_t next = 1;
  if (count == 0) return false;
  depth[0] = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const QuadtreeLinks links = nodes[i].links;
    if (links.mask > 15) return false;
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
