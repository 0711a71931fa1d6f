#include "guiding_density.h"

#include <bit>

namespace guiding {

namespace {

constexpr float kInvFourPi = 1 / (4 * kPiF);

float belowOne(float x) noexcept {
  return x < kOneMinusEpsilon ? x : kOneMinusEpsilon;
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
  Descent toX = choice.restX, toY = choice.restY;
  float density = Grid::kCells * kInvFourPi * grid.mass(choice.x, choice.y);
  int depth = Grid::kDepth, cellX = choice.x, cellY = choice.y;

  if (!tree.isLeafCell(gridCell)) {
    const Node* nodes = m_nodes.data() + tree.firstNode;
    const Node* node = nodes + tree.nodeOfCell(gridCell);
    for (;;) {
      const float splitX = toX.split(node->column0);
      const float splitY0 = toY.split(node->row0[0]), splitY1 = toY.split(node->row0[1]);
      const bool column = toX.isUpper(splitX);
      // The choice within both columns does not have to wait for the column.
      const bool row = bool((int(toY.isUpper(splitY0)) & int(!column)) | (int(toY.isUpper(splitY1)) & int(column)));
      const int cell = int(column) + 2 * int(row);
      toX.enter(column, splitX);
      toY.enter(row, select(column, splitY1, splitY0));
      density *= 4 * node->share(cell);
      ++depth;
      cellX = 2 * cellX + int(column);
      cellY = 2 * cellY + int(row);
      if (node->links.isLeaf(cell)) break;
      node = nodes + node->links.childIndex(cell);
    }
  }
  const float x = toX.rescaled(), y = toY.rescaled();
  const float size = std::bit_cast<float>((127u - std::uint32_t(depth)) << 23);  // 2^-depth
  const Imath::V2f corner = Imath::V2f(float(cellX), float(cellY)) * size;

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
