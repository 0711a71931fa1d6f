#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "catch.h"
#include "scenes.h"
#include "tile_means.h"

using namespace test;
using namespace guiding;

namespace {

/// How many values each setting is tried with.
enum Factor {
  kLearned,
  kCompensation,
  kMap,
  kSpatialFilter,
  kDirectionalFilter,
  kNeighbours,
  kFraction,
  kLoss,
  kClip,
  kGain,
  kCombination,
  kRoulette,
  kHeuristic,
  kSampler,
  kLightSampling,
  kFactors
};
constexpr std::array<int, kFactors> kValues{3, 4, 2, 2, 2, 2, 3, 2, 2, 2, 2, 3, 4, 2, 2};
using Choice = std::array<int, kFactors>;
/// Two settings and their values.
using Pair = std::tuple<int, int, int, int>;

std::vector<Pair> pairsOf(const Choice& choice) {
  std::vector<Pair> pairs;
  for (int a = 0; a < kFactors; ++a)
    for (int b = a + 1; b < kFactors; ++b) pairs.emplace_back(a, b, choice[std::size_t(a)], choice[std::size_t(b)]);
  return pairs;
}

/// Choices among which every two values of two settings meet: of some random ones always that with most new pairs.
std::vector<Choice> pairwiseChoices() {
  std::set<Pair> missing;
  for (int a = 0; a < kFactors; ++a)
    for (int b = a + 1; b < kFactors; ++b)
      for (int x = 0; x < kValues[std::size_t(a)]; ++x)
        for (int y = 0; y < kValues[std::size_t(b)]; ++y) missing.emplace(a, b, x, y);

  std::mt19937 engine(5);
  std::vector<Choice> choices;
  while (!missing.empty()) {
    Choice best{};
    std::size_t mostNew = 0;
    for (int attempt = 0; attempt < 1000; ++attempt) {
      Choice choice;
      for (std::size_t f = 0; f < kFactors; ++f) choice[f] = int(engine() % unsigned(kValues[f]));
      // One pair that is missing for certain, so that there is an end.
      const auto& [a, b, x, y] = *missing.begin();
      choice[std::size_t(a)] = x, choice[std::size_t(b)] = y;
      std::size_t found = 0;
      for (const Pair& pair : pairsOf(choice)) found += missing.count(pair);
      if (found > mostNew) mostNew = found, best = choice;
    }
    for (const Pair& pair : pairsOf(best)) missing.erase(pair);
    choices.push_back(best);
  }
  return choices;
}

FieldSettings fieldOf(const Choice& choice) {
  FieldSettings s;
  s.sTreeThreshold = 200;
  s.target = choice[kLearned] == 1 ? LearningTarget::Product : LearningTarget::Radiance;
  s.product = choice[kLearned] == 2;
  constexpr CompensationSettings kCompensations[] = {{CompensationForm::None, 1},
                                                     {CompensationForm::WaterFilling, 0.5f},
                                                     {CompensationForm::WaterFilling, 1},
                                                     {CompensationForm::ClipRenormalise, 1}};
  s.compensation = kCompensations[choice[kCompensation]];
  s.directionMap = DirectionMap(choice[kMap]);
  s.spatialFilter = SpatialFilter(choice[kSpatialFilter]);
  s.directionalFilter = DirectionalFilter(choice[kDirectionalFilter]);
  s.fractionMode = FractionMode(choice[kFraction]);
  s.fractionLoss = FractionLoss(choice[kLoss]);
  s.neighbourWeight = choice[kNeighbours] == 1 ? 0.5f : 0.0f;
  s.recordClip = choice[kClip] == 1 ? 0.01f : 0.0f;
  s.minimalGain = choice[kGain] == 1 ? 0.02f : 0.0f;
  return s;
}

void apply(const Choice& choice, pt::RenderSettings& settings) {
  settings.guiding.emplace();
  settings.guiding->field = fieldOf(choice);
  settings.guiding->schedule = ScheduleSettings::production2019();
  if (choice[kCombination] == 1) settings.guiding->schedule.combination = SampleCombination::Discard;
  settings.roulette = {.method = pt::RouletteMethod(choice[kRoulette]), .trial = false};
  settings.heuristic = MisHeuristic(choice[kHeuristic]);
  settings.sampler = pt::SamplerKind(choice[kSampler]);
  settings.nee = choice[kLightSampling] == 0;
}

}  // namespace

TEST_CASE("every two settings together leave the picture as it is without a guide", "[slow]") {
  const pt::SceneDescription description = bundledScene("cornell-lamp");
  const pt::Scene scene(description);
  pt::RenderSettings settings = tileSettings(description);
  const std::vector<RunningMean> reference = tileMeans(scene, settings, 1);
  const std::vector<Choice> choices = pairwiseChoices();
  // All tests together fail by chance once in a thousand times.
  const double level = 0.001 / double(choices.size());
  for (std::size_t i = 0; i < choices.size(); ++i) {
    CAPTURE(i, choices[i]);
    apply(choices[i], settings);
    const ZResult agrees = zTestTiles(tileMeans(scene, settings, 3000 + 100 * i), reference, level);
    INFO(agrees.message);
    CHECK(agrees);
  }
  // What the test can see: a tenth more light.
  apply(*std::find_if(choices.begin(), choices.end(), [](const Choice& c) { return c[kLightSampling] == 0; }),
        settings);
  CHECK_FALSE(zTestTiles(tileMeans(pt::Scene(brighter(description)), settings, 1000), reference, level));
}
