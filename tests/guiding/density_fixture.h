#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "freeze.h"
#include "guiding_density.h"
#include "statistics/random.h"

namespace test {

inline constexpr double kSphere = 4 * 3.14159265358979323846;

/// One frozen quadtree, alone in its density.
class FrozenQuadtree {
 public:
  FrozenQuadtree(guiding::DirectionMap map, const guiding::DirectionalQuadtree& learned,
                 guiding::CompensationForm form = guiding::CompensationForm::None, float assumedFraction = 0.5f)
      : m_density(map) {
    guiding::FrozenTree frozen = guiding::freeze(learned, form, assumedFraction);
    m_guided = frozen.guided;
    m_density.assign({frozen.tree}, std::move(frozen.nodes));
  }

  bool guided() const { return m_guided; }
  int maxDepth() const { return m_density.maxDepth(0); }
  const guiding::GuidingDensity::Tree& tree() const { return m_density.tree(0); }
  guiding::DirectionSample sample(const Imath::V2f& u) const { return m_density.sample(0, tree().grid, u); }
  float pdf(const Imath::V3f& wi) const { return m_density.pdf(0, tree().grid, wi); }

 private:
  guiding::GuidingDensity m_density;
  bool m_guided = false;
};

/// A leaf cell of a quadtree.
struct LeafCell {
  double x = 0, y = 0, size = 1;  ///< lower corner, edge
  double mass = 0;
  Imath::V2f middle() const { return Imath::V2f(float(x + size / 2), float(y + size / 2)); }
  double area() const { return size * size; }
};

inline std::vector<LeafCell> leafCellsOf(const guiding::DirectionalQuadtree& tree) {
  std::vector<LeafCell> cells;
  const std::function<void(std::uint32_t, LeafCell)> visit = [&](std::uint32_t index, LeafCell node) {
    for (int c = 0; c < 4; ++c) {
      const auto& n = tree.nodes()[index];
      const double half = node.size / 2;
      const LeafCell cell{node.x + (c & 1) * half, node.y + (c >> 1) * half, half, n.sum[c]};
      if (n.links.isLeaf(c))
        cells.push_back(cell);
      else
        visit(n.links.childIndex(c), cell);
    }
  };
  visit(0, {});
  return cells;
}

/// A quadtree that learned `draw` in a few rounds of splatting and refining; its sums are those of the last round.
template <class Draw>
guiding::DirectionalQuadtree learn(guiding::DirectionMap map, Draw&& draw, double threshold = 0.01, int maxDepth = 20,
                                   int rounds = 8, int samples = 50'000) {
  guiding::DirectionalQuadtree tree;
  for (int round = 0;; ++round) {
    for (int i = 0; i < samples; ++i) tree.splat(guiding::toSquarePoint(guiding::sphereToSquare(map, draw())), 1);
    const double total = tree.build();
    if (round + 1 == rounds) return tree;
    tree = tree.refined(total, threshold, maxDepth);
    tree.clear();
  }
}

/// Draws directions about an axis: uniform in a cube of half-width `radius` about it, normalised.
class SpikeLight {
 public:
  SpikeLight(const Imath::V3f& axis, float radius, std::uint64_t seed)
      : m_axis(axis.normalized()), m_radius(radius), m_random(seed) {}

  Imath::V3f operator()() {
    const Imath::V2f a = m_random.next2D(), b = m_random.next2D();
    return (m_axis + (Imath::V3f(a.x, a.y, b.x) - Imath::V3f(0.5f)) * (2 * m_radius)).normalized();
  }

 private:
  Imath::V3f m_axis;
  float m_radius;
  Random m_random;
};

/// Three lights of different size before a uniform background.
class MixedLight {
 public:
  explicit MixedLight(std::uint64_t seed)
      : m_random(seed),
        m_lights{{{0.3f, 0.5f, 0.8f}, 0.02f, seed + 1},
                 {{-0.7f, 0.1f, -0.2f}, 0.2f, seed + 2},
                 {{0.1f, -0.9f, 0.1f}, 0.6f, seed + 3}} {}

  Imath::V3f operator()() {
    const int light = int(4 * m_random.next1D());
    return light < 3 ? m_lights[light]() : guiding::squareToSphere(guiding::DirectionMap::Cylinder, m_random.next2D());
  }

 private:
  Random m_random;
  SpikeLight m_lights[3];
};

inline const auto kBothMaps = {guiding::DirectionMap::Cylinder, guiding::DirectionMap::Octahedral};
inline const auto kAllForms = {guiding::CompensationForm::None, guiding::CompensationForm::WaterFilling,
                               guiding::CompensationForm::ClipRenormalise};

}  // namespace test
