#include "directional_filter.h"

#include <algorithm>

namespace guiding {

namespace {

/// Coordinates in units of 2^-24; the square is [0, kOne)^2.
constexpr std::int64_t kOne = std::int64_t(1) << SquarePoint::kBits;

struct Box {
  std::int64_t x0, x1, y0, y1;
  double area() const noexcept { return double(x1 - x0) * double(y1 - y0); }
};

/// Splats a box that lies inside a node; `density` is value per unit area.
void splatInto(std::vector<DirectionalQuadtree::Node>& nodes, std::uint32_t index, std::int64_t x, std::int64_t y,
               std::int64_t half, const Box& box, double density) noexcept {
  // Down to the node whose cells part the box: most have all of it in one.
  for (;;) {
    const bool right = box.x0 >= x + half, upper = box.y0 >= y + half;
    if ((!right && box.x1 > x + half) || (!upper && box.y1 > y + half)) break;
    const int c = (right ? 1 : 0) + (upper ? 2 : 0);
    const QuadtreeLinks links = nodes[index].links;
    if (links.isLeaf(c)) {
      nodes[index].sum[c] += box.area() * density;
      return;
    }
    index = links.childIndex(c);
    x += right ? half : 0;
    y += upper ? half : 0;
    half /= 2;
  }
  for (int c = 0; c < 4; ++c) {
    const std::int64_t cx = x + (c & 1) * half, cy = y + (c >> 1) * half;
    const Box part{std::max(box.x0, cx), std::min(box.x1, cx + half), std::max(box.y0, cy),
                   std::min(box.y1, cy + half)};
    if (part.x0 >= part.x1 || part.y0 >= part.y1) continue;
    const QuadtreeLinks links = nodes[index].links;
    if (links.isLeaf(c))
      nodes[index].sum[c] += part.area() * density;
    else
      splatInto(nodes, links.childIndex(c), cx, cy, half / 2, part, density);
  }
}

/// Moves a box that lies beyond one edge of the square to where its directions are. The cylinder's y runs around the
/// pole axis and its x ends at the poles, behind which the sphere goes on half a turn away. An edge of the octahedron
/// is folded about its middle.
Box continueOnSphere(DirectionMap map, Box box) noexcept {
  const auto mirror = [](std::int64_t& a, std::int64_t& b, std::int64_t about2) {
    const std::int64_t was = a;
    a = about2 - b;
    b = about2 - was;
  };
  const bool beyondX = box.x0 < 0 || box.x1 > kOne;
  if (map == DirectionMap::Octahedral) {
    if (beyondX) {
      mirror(box.x0, box.x1, box.x0 < 0 ? 0 : 2 * kOne);
      mirror(box.y0, box.y1, kOne);
    } else {
      mirror(box.y0, box.y1, box.y0 < 0 ? 0 : 2 * kOne);
      mirror(box.x0, box.x1, kOne);
    }
    return box;
  }
  std::int64_t shift = 0;
  if (beyondX) {
    mirror(box.x0, box.x1, box.x0 < 0 ? 0 : 2 * kOne);
    shift = box.y0 < kOne / 2 ? kOne / 2 : -kOne / 2;
  } else {
    shift = box.y0 < 0 ? kOne : -kOne;
  }
  box.y0 += shift;
  box.y1 += shift;
  return box;
}

/// Splats what lies inside the square and continues the rest, at most around a corner.
void splatAnywhere(std::vector<DirectionalQuadtree::Node>& nodes, DirectionMap map, const Box& box, double density,
                   int turns) noexcept {
  const auto part = [&](std::int64_t x0, std::int64_t x1, std::int64_t y0, std::int64_t y1, bool inside) {
    const Box b{std::max(box.x0, x0), std::min(box.x1, x1), std::max(box.y0, y0), std::min(box.y1, y1)};
    if (b.x0 >= b.x1 || b.y0 >= b.y1) return;
    if (inside)
      splatInto(nodes, 0, 0, 0, kOne / 2, b, density);
    else if (turns > 0)
      splatAnywhere(nodes, map, continueOnSphere(map, b), density, turns - 1);
  };
  part(0, kOne, 0, kOne, true);
  part(-kOne, 0, -kOne, 2 * kOne, false);
  part(kOne, 2 * kOne, -kOne, 2 * kOne, false);
  part(0, kOne, -kOne, 0, false);
  part(0, kOne, kOne, 2 * kOne, false);
}

}  // namespace

void splatBox(DirectionalQuadtree& tree, DirectionMap map, SquarePoint point, int depth, double value) noexcept {
  const std::int64_t size = kOne >> depth;
  if (size <= 1) return tree.splat(point, value);
  const std::int64_t x = std::int64_t(point.x) - size / 2, y = std::int64_t(point.y) - size / 2;
  splatAnywhere(tree.nodes(), map, {x, x + size, y, y + size}, value / (double(size) * double(size)), 3);
}

}  // namespace guiding
