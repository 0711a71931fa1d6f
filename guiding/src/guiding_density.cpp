#include "guiding_density.h"

#include "guiding/mis.h"

#include <cmath>

namespace guiding {

namespace {
constexpr float kInvFourPi = 1 / (4 * kPiF);

float belowOne(float x) { return x < kOneMinusEpsilon ? x : kOneMinusEpsilon; }
}  // namespace

float GuidingDensity::squareDensity(const Node* root, SquarePoint point) const noexcept {
  const Node* node = root;
  float density = 1;
  for (int depth = 0;; ++depth) {
    const int cell = point.cellAt(depth);
    density *= 4 * node->share[cell];
    if (node->links.isLeaf(cell)) return density;
    node = root + node->links.childIndex(cell);
  }
}

float GuidingDensity::pdf(std::uint32_t index, const Imath::V3f& wi) const noexcept {
  const Node* root = m_nodes.data() + m_trees[index].root;
  return squareDensity(root, toSquarePoint(sphereToSquare(m_map, wi))) * kInvFourPi;
}

DirectionSample GuidingDensity::sample(std::uint32_t index, const Imath::V2f& u) const noexcept {
  const Node* root = m_nodes.data() + m_trees[index].root;
  const Node* node = root;
  float x = u.x, y = u.y, density = 1, size = 1;
  Imath::V2f corner(0, 0);
  for (;;) {
    // Sums, never differences: an empty half has exactly zero mass and cannot be entered.
    const float* s = node->share;
    const float left = s[0] + s[2], right = s[1] + s[3];
    const float tx = x * (left + right);
    const int column = tx < left ? 0 : 1;
    x = belowOne(column ? (tx - left) / right : tx / left);
    const float lower = s[column], upper = s[column + 2];
    const float ty = y * (lower + upper);
    const int row = ty < lower ? 0 : 1;
    y = belowOne(row ? (ty - lower) / upper : ty / lower);

    const int cell = column + 2 * row;
    density *= 4 * s[cell];
    size *= 0.5f;
    corner += Imath::V2f(float(column), float(row)) * size;
    if (node->links.isLeaf(cell)) break;
    node = root + node->links.childIndex(cell);
  }

  const Imath::V3f wi = squareToSphere(m_map, corner + Imath::V2f(x, y) * size);
  // Close to its cell's border the float direction may belong to the neighbour; the direction is the truth.
  const float margin = squareRoundTripError(m_map, wi);
  const float inside = std::min(std::min(x, 1 - x), std::min(y, 1 - y)) * size;
  if (inside <= margin) return {wi, pdf(index, wi)};
  return {wi, density * kInvFourPi};
}

int GuidingDensity::maxDepth(std::uint32_t index) const {
  const Tree& tree = m_trees[index];
  std::vector<int> depth(tree.nodeCount, 1);
  int deepest = 0;
  for (std::uint32_t i = 0; i < tree.nodeCount; ++i) {
    const QuadtreeLinks links = m_nodes[tree.root + i].links;
    deepest = std::max(deepest, depth[i]);
    for (int c = 0; c < 4; ++c)
      if (!links.isLeaf(c)) depth[links.childIndex(c)] = depth[i] + 1;
  }
  return deepest;
}

namespace {

/// Leaf cells of a quadtree as flat arrays: what the solver eats.
struct LeafCells {
  std::vector<double> mass, area;
};

LeafCells leafCells(const std::vector<DirectionalQuadtree::Node>& nodes) {
  LeafCells cells;
  std::vector<double> cellArea(nodes.size(), 0.25);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (int c = 0; c < 4; ++c) {
      if (!nodes[i].links.isLeaf(c)) {
        cellArea[nodes[i].links.childIndex(c)] = cellArea[i] / 4;
        continue;
      }
      cells.mass.push_back(nodes[i].sum[c]);
      cells.area.push_back(cellArea[i]);
    }
  }
  return cells;
}

/// Writes the solved masses back into the leaf cells, in the order of leafCells(), and sums them into their parents.
void replaceLeafMasses(std::vector<DirectionalQuadtree::Node>& nodes, const std::vector<double>& mass) {
  std::size_t next = mass.size();
  for (std::size_t i = nodes.size(); i-- > 0;) {
    DirectionalQuadtree::Node& node = nodes[i];
    for (int c = 3; c >= 0; --c) {
      if (node.links.isLeaf(c)) {
        node.sum[c] = mass[--next];
      } else {
        const auto& s = nodes[node.links.childIndex(c)].sum;
        node.sum[c] = (s[0] + s[1]) + (s[2] + s[3]);
      }
    }
  }
}

/// Copies the nodes that hold mass, normalised; empty subtrees vanish.
std::vector<GuidingDensity::Node> normalisedNodes(const std::vector<DirectionalQuadtree::Node>& nodes) {
  std::vector<GuidingDensity::Node> out(1);
  std::vector<std::uint32_t> source{0};  // parallel to out
  for (std::size_t i = 0; i < out.size(); ++i) {
    const DirectionalQuadtree::Node& from = nodes[source[i]];
    const double total = (from.sum[0] + from.sum[1]) + (from.sum[2] + from.sum[3]);
    GuidingDensity::Node node{};
    node.links.first = std::uint32_t(out.size());
    for (int c = 0; c < 4; ++c) {
      node.share[c] = float(from.sum[c] / total);
      if (from.links.isLeaf(c) || !(node.share[c] > 0)) continue;
      node.links.mask |= 1u << c;
      source.push_back(from.links.childIndex(c));
      out.emplace_back();
    }
    out[i] = node;
  }
  return out;
}

}  // namespace

FrozenTree freeze(const DirectionalQuadtree& learned, CompensationForm form, float assumedFraction) {
  std::vector<DirectionalQuadtree::Node> nodes = learned.nodes();
  LeafCells cells = leafCells(nodes);
  const CompensationResult solved = compensate(cells.mass, cells.area, assumedFraction, form, cells.mass);
  if (solved.empty) return {};

  replaceLeafMasses(nodes, cells.mass);
  FrozenTree frozen{normalisedNodes(nodes), 0};
  for (std::size_t j = 0; j < cells.mass.size(); ++j)
    if (!(cells.mass[j] > 0)) frozen.emptyArea += float(cells.area[j]);
  return frozen;
}

}  // namespace guiding
