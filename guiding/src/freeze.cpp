#include "freeze.h"

#include <array>

#include "guiding/mis.h"

namespace guiding {

namespace {

using LearnedNode = DirectionalQuadtree::Node;

double massOf(const LearnedNode& node) {
  return (node.sum[0] + node.sum[1]) + (node.sum[2] + node.sum[3]);
}

/// Leaf cells of a quadtree as flat arrays: what the solver eats.
struct LeafCells {
  std::vector<double> mass, area;
  std::vector<double> bsdf;  ///< shares of the BSDF's density; empty unless learned
};

LeafCells leafCells(const DirectionalQuadtree& learned) {
  const std::vector<LearnedNode>& nodes = learned.nodes();
  LeafCells cells;
  double bsdfTotal = 0;
  std::vector<double> cellArea(nodes.size(), 0.25);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (int c = 0; c < 4; ++c) {
      if (!nodes[i].links.isLeaf(c)) {
        cellArea[nodes[i].links.childIndex(c)] = cellArea[i] / 4;
        continue;
      }
      cells.mass.push_back(nodes[i].sum[c]);
      cells.area.push_back(cellArea[i]);
      if (!learned.learnsBsdf()) continue;
      cells.bsdf.push_back(learned.bsdfSums()[i][c]);
      bsdfTotal += cells.bsdf.back();
    }
  }
  if (!(bsdfTotal > 0)) cells.bsdf.clear();
  for (double& bsdf : cells.bsdf) bsdf /= bsdfTotal;
  return cells;
}

/// Writes the solved masses back into the leaf cells, in the order of leafCells(), and sums them into their parents.
void replaceLeafMasses(std::vector<LearnedNode>& nodes, const std::vector<double>& mass) {
  std::size_t next = mass.size();
  for (std::size_t i = nodes.size(); i-- > 0;) {
    LearnedNode& node = nodes[i];
    for (int c = 3; c >= 0; --c)
      node.sum[c] = node.links.isLeaf(c) ? mass[--next] : massOf(nodes[node.links.childIndex(c)]);
  }
}

/// Lays the top levels out as the grid. `roots` receives the learned node behind each subdivided grid cell.
class GridFiller {
 public:
  GridFiller(const std::vector<LearnedNode>& nodes, GuidingDensity::Tree& tree) : m_nodes(nodes), m_tree(tree) {}

  std::vector<std::uint32_t> fill() {
    m_rootOfCell.fill(0);
    visit(0, 0, 0, 0);
    double total = 0;
    for (const double mass : m_mass) total += mass;
    std::array<Grid::Row, Grid::kSize> masses;
    for (int c = 0; c < Grid::kCells; ++c) masses[c / Grid::kSize][c % Grid::kSize] = float(m_mass[c] / total);
    m_tree.grid.assign(masses);

    std::vector<std::uint32_t> roots;
    for (int c = 0; c < Grid::kCells; ++c) {
      if (m_rootOfCell[c] == 0 || !(m_tree.grid.mass(c / Grid::kSize, c % Grid::kSize) > 0))
        continue;  // empty subtrees vanish
      m_tree.subdivided |= std::uint64_t(1) << c;
      roots.push_back(m_rootOfCell[c]);
    }
    return roots;
  }

 private:
  /// (x, y): lower corner of the node, in grid cells.
  void visit(std::uint32_t index, int depth, int x, int y) {
    const int half = Grid::kSize >> (depth + 1);
    for (int c = 0; c < 4; ++c) {
      const int cx = x + (c & 1) * half, cy = y + (c >> 1) * half;
      const LearnedNode& node = m_nodes[index];
      if (node.links.isLeaf(c)) {
        spread(node.sum[c], half, cx, cy);
      } else if (half > 1) {
        visit(node.links.childIndex(c), depth + 1, cx, cy);
      } else {
        m_mass[cx * Grid::kSize + cy] = node.sum[c];
        m_rootOfCell[cx * Grid::kSize + cy] = node.links.childIndex(c);
      }
    }
  }

  void spread(double mass, int size, int x, int y) {
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) m_mass[(x + i) * Grid::kSize + y + j] = mass / (size * size);
  }

  const std::vector<LearnedNode>& m_nodes;
  GuidingDensity::Tree& m_tree;
  std::array<double, Grid::kCells> m_mass{};
  std::array<std::uint32_t, Grid::kCells> m_rootOfCell{};  ///< 0: the cell is a leaf (node 0 is the tree's root)
};

/// Conditional probabilities of a node's cells; half and half where there is nothing.
GuidingDensity::Node conditional(const LearnedNode& from) {
  const auto first = [](double a, double b) { return a + b > 0 ? float(a / (a + b)) : 0.5f; };
  GuidingDensity::Node node{};
  node.column0 = first(from.sum[0] + from.sum[2], from.sum[1] + from.sum[3]);
  node.row0[0] = first(from.sum[0], from.sum[2]);
  node.row0[1] = first(from.sum[1], from.sum[3]);
  return node;
}

/// The nodes below the grid, normalised, breadth first; empty subtrees vanish.
std::vector<GuidingDensity::Node> nodesBelow(const std::vector<LearnedNode>& learned,
                                             std::vector<std::uint32_t> source) {
  std::vector<GuidingDensity::Node> out;
  for (std::size_t i = 0; i < source.size(); ++i) {  // `source` grows as children are found
    const LearnedNode& from = learned[source[i]];
    GuidingDensity::Node node = conditional(from);
    node.links.startAt(source.size());
    for (int c = 0; c < 4; ++c) {
      if (from.links.isLeaf(c) || !(node.share(c) > 0)) continue;
      node.links.mask |= 1u << c;
      source.push_back(from.links.childIndex(c));
    }
    out.push_back(node);
  }
  return out;
}

}  // namespace

FrozenTree freeze(const DirectionalQuadtree& learned, CompensationForm form, float assumedFraction) {
  std::vector<LearnedNode> nodes = learned.nodes();
  LeafCells cells = leafCells(learned);
  FrozenTree frozen{};
  const std::vector<double> uncompensated = cells.mass;
  const CompensationResult solved =
      compensate(cells.mass, cells.bsdf.empty() ? cells.area : cells.bsdf, assumedFraction, form, cells.mass);
  if (solved.empty) return frozen;

  replaceLeafMasses(nodes, cells.mass);
  frozen.guided = true;
  frozen.nodes = nodesBelow(nodes, GridFiller(nodes, frozen.tree).fill());
  frozen.tree.nodeCount = std::uint32_t(frozen.nodes.size());
  double empty = 0;
  for (std::size_t j = 0; j < cells.mass.size(); ++j)
    if (uncompensated[j] > 0 && !(cells.mass[j] > 0)) empty += cells.area[j];
  frozen.tree.emptyArea = float(empty);
  return frozen;
}

}  // namespace guiding
