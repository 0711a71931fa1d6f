#include "guiding_density.h"

#include <bit>

namespace guiding {

namespace {

constexpr float kInvFourPi = 1 / (4 * kPiF);

float belowOne(float x) noexcept {
  return x < kOneMinusEpsilon ? x : kOneMinusEpsilon;
}

/// Chooses the upper half with probability 1 - p, with x in [0,1), and rescales x for reuse. p = 0 and p = 1 never
/// choose the empty half.
int chooseHalf(float p, float& x) noexcept {
  const bool upper = x >= p;
  x = belowOne((x - select(upper, p, 0.0f)) / select(upper, 1 - p, p));
  return upper;
}

}  // namespace

float GuidingDensity::pdf(std::uint32_t index, const Grid& grid, const Imath::V3f& wi) const noexcept {
  const Tree& tree = m_trees[index];
  const SquarePoint point = toSquarePoint(sphereToSquare(m_map, wi));
  constexpr int kShift = SquarePoint::kBits - Grid::kDepth;
  const int gridX = int(point.x >> kShift), gridY = int(point.y >> kShift);
  const int gridCell = gridX * Grid::kSize + gridY;
  float density = Grid::kCells * kInvFourPi * grid.mass(gridX, gridY);
  if (tree.isLeafCell(gridCell)) return density;

  const Node* nodes = m_nodes.data() + tree.firstNode;
  const Node* node = nodes + tree.nodeOfCell(gridCell);
  for (int depth = Grid::kDepth;; ++depth) {
    const int cell = point.cellAt(depth);
    density *= 4 * node->share(cell);
    if (node->links.isLeaf(cell)) return density;
    node = nodes + node->links.childIndex(cell);
  }
}

DirectionSample GuidingDensity::sample(std::uint32_t index, const Grid& grid, const Imath::V2f& u) const noexcept {
  const Tree& tree = m_trees[index];
  const Grid::Choice choice = grid.sample({belowOne(u.x), belowOne(u.y)});
  const int gridCell = choice.x * Grid::kSize + choice.y;
  float x = choice.rest.x, y = choice.rest.y;
  float density = Grid::kCells * kInvFourPi * grid.mass(choice.x, choice.y);
  float size = 1.0f / Grid::kSize;
  Imath::V2f corner(float(choice.x) * size, float(choice.y) * size);

  if (!tree.isLeafCell(gridCell)) {
    const Node* nodes = m_nodes.data() + tree.firstNode;
    const Node* node = nodes + tree.nodeOfCell(gridCell);
    for (;;) {
      const int column = chooseHalf(node->column0, x);
      const int row = chooseHalf(node->row0[column], y);
      const int cell = column + 2 * row;
      density *= 4 * node->share(cell);
      size *= 0.5f;
      corner += Imath::V2f(float(column), float(row)) * size;
      if (node->links.isLeaf(cell)) break;
      node = nodes + node->links.childIndex(cell);
    }
  }

  const Imath::V3f wi = squareToSphere(m_map, corner + Imath::V2f(x, y) * size);
  // Close to its cell's border the float direction may belong to the neighbour; the direction is the truth.
  const float inside = std::min(std::min(x, 1 - x), std::min(y, 1 - y)) * size;
  if (inside > squareRoundTripError(m_map, wi)) return {wi, density};
  if (const float pdfThere = pdf(index, grid, wi); pdfThere > 0) return {wi, pdfThere};
  // Next to an empty cell the border is taken back to where there is something.
  const Imath::V3f middle = squareToSphere(m_map, corner + Imath::V2f(0.5f * size));
  return {middle, pdf(index, grid, middle)};
}

int GuidingDensity::maxDepth(std::uint32_t index) const noexcept {
  const Tree& tree = m_trees[index];
  const Node* nodes = m_nodes.data() + tree.firstNode;
  int depth = Grid::kDepth;
  // Nodes stand level by level.
  for (std::uint32_t begin = 0, end = std::uint32_t(std::popcount(tree.subdivided)); begin < end; ++depth) {
    std::uint32_t children = 0;
    for (std::uint32_t i = begin; i < end; ++i) children += std::uint32_t(std::popcount(nodes[i].links.mask));
    begin = end;
    end += children;
  }
  return depth;
}

}  // namespace guiding
