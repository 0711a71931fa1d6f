#include "join_neighbours.h"

#include "training_fixture.h"

using namespace guiding;
using namespace test;

namespace {

/// A field of eight equal leaves, of which each has one cell of light: that of its own number, if below 4.
struct Octants {
  Field::State state{kUnitCube, settings()};
  std::vector<Imath::V3f> centres;

  explicit Octants(double samplesOfNeighbours) {
    state.tree.split({3});
    state.leaves.resize(8);
    for (std::uint32_t i = 0; i < 8; ++i) {
      SpatialLeaf& leaf = state.leaves[i];
      if (i < 4) leaf.building.nodes()[0].sum[i] = 100.0 * (i + 1);
      leaf.sampleCount = std::uint64_t(i == 0 ? 1000 : samplesOfNeighbours);
      leaf.building.build();
    }
    centres = state.tree.leafCentres();
  }

  static FieldSettings settings() {
    FieldSettings s;
    s.neighbourWeight = 0.5f;
    return s;
  }
};

/// Relative error of the density at the light, root of the mean square over places, after training on few samples.
double errorOfDensity(float neighbourWeight, const Radiance& radiance, double truth) {
  FieldSettings settings = FieldSettings::mueller2017();
  settings.sTreeThreshold = 100;
  settings.neighbourWeight = neighbourWeight;
  Random random(3);
  const Field field = train(settings, radiance, 3, 20'000);
  double sum = 0;
  constexpr int kPlaces = 2000;
  for (int i = 0; i < kPlaces; ++i) {
    const GuidingDistribution guide = field.bind(uniformPosition(random));
    const double error = guide ? guide.pdf({0, 0, 1}) / truth - 1 : -1;
    sum += error * error;
  }
  return std::sqrt(sum / kPlaces);
}

}  // namespace

TEST_CASE("Neighbours' shapes are joined by weight, whatever their levels") {
  for (const double samples : {1000.0, 5000.0, 500.0}) {
    const Octants field(samples);
    const double weight = 0.5 * std::min(1.0, samples / 1000);
    const DirectionalQuadtree joined = joinNeighbours(field.state, field.centres, 0);
    // Three octants share a face with the first one.
    std::array<double, 4> expected{100, 0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
      Imath::V3f beside(0.25f);
      beside[axis] = 0.75f;
      const std::uint32_t neighbour = field.state.tree.leafAt(beside);
      if (neighbour < 4) expected[neighbour] += weight * 100;  // the others saw no light
    }
    CHECK(expected != std::array<double, 4>{100, 0, 0, 0});
    CHECK(joined.nodes()[0].sum == expected);
  }
}

TEST_CASE("Levels far apart make no infinite sums") {
  Octants field(1000);
  for (const auto& [own, neighbours] : {std::pair(1e300, 1e-300), std::pair(1e-300, 1e300), std::pair(1e308, 1e308)}) {
    for (std::uint32_t i = 0; i < 8; ++i) {
      field.state.leaves[i].building.nodes()[0].sum = {i == 0 ? own : neighbours, 0, 0, 0};
      field.state.leaves[i].building.build();
    }
    const DirectionalQuadtree joined = joinNeighbours(field.state, field.centres, 0);
    CHECK(joined.flux() >= own);
    CHECK(std::isfinite(joined.flux()));
  }
}

TEST_CASE("Where light is the same all over, neighbours make the density of few samples better") {
  const Cone light{{0, 0, 1}, 0.9f};
  const Radiance even = [&](const Imath::V3f&, const Imath::V3f& wi) { return light.contains(wi) ? 1.0f : 0.0f; };
  const double truth = 1 / (2 * kPi * (1 - light.cosHalfAngle));
  const double alone = errorOfDensity(0, even, truth), joined = errorOfDensity(0.5f, even, truth);
  CAPTURE(alone, joined);
  CHECK(joined < 0.8 * alone);
}
