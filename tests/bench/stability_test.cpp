#include <set>

#include "catch.h"
#include "stability/cases/case_lists.h"
#include "stability/scene_maker.h"
#include "stability/stability_report.h"
#include "stability/subnormal_mode.h"
#include "stability/tile_bias.h"
#include "synthetic/random.h"

using namespace bench;

namespace {

/// A furnace that shows 1, in pictures of 4 x 4 pixels.
StabilityCase smallFurnace(double truth) {
  return {.name = "test/furnace",
          .expectation = "1",
          .scene =
              [] {
                SceneMaker maker = furnace(0.5f, 0.5f).depths(-1, 5);
                maker.scene().film.width = maker.scene().film.height = 4;
                return maker;
              },
          .truth = KnownRadiance{truth},
          .renders = {.runs = 6, .spp = 31},
          .knownLoss = "too few paths to learn from"};
}

std::vector<StabilityOutcome> outcomesOf(const StabilityCase& description) {
  return {runStabilityCase(description, stabilityVariants(), 2)};
}

int faultyRows(const std::vector<StabilityOutcome>& outcomes) {
  return StabilityRun{outcomes, 0, 0}.faultyRows();
}

/// Pictures of uniform noise about a level.
std::vector<pt::Image> noise(int count, float level, Random& random) {
  std::vector<pt::Image> pictures(std::size_t(count), pt::Image(8, 8));
  for (pt::Image& picture : pictures)
    for (pt::Spectrum& pixel : picture.pixels) pixel = pt::Spectrum(level + random.next1D() - 0.5f);
  return pictures;
}

}  // namespace

TEST_CASE("Every case of the suite has a name of its own, an expectation and something to do") {
  std::set<std::string> names;
  for (const StabilityCase& c : stabilityCases()) {
    CAPTURE(c.name);
    CHECK(names.insert(c.name).second);
    CHECK(c.name.find('/') != std::string::npos);
    CHECK(!c.expectation.empty());
    CHECK(bool(c.scene) != bool(c.probe));
    CHECK(c.renders.runs >= 4);
  }
  CHECK(names.size() > 80);
}

TEST_CASE("A right picture passes, one that is off by a tenth is biased") {
  std::vector<StabilityOutcome> right = outcomesOf(smallFurnace(1)), wrong = outcomesOf(smallFurnace(1.1));
  CHECK(judgeBias(right) > 2.5);
  judgeBias(wrong);
  CHECK(faultyRows(right) == 0);
  CHECK(faultyRows(wrong) >= 1);
  StabilityCase excused = smallFurnace(1.1);
  excused.heavyTail = "a reason";
  std::vector<StabilityOutcome> unjudged = outcomesOf(excused);
  judgeBias(unjudged);
  CHECK(faultyRows(unjudged) == 0);
}

TEST_CASE("A scene that should be refused, and is not, or in other words, is a fault") {
  StabilityCase c = smallFurnace(1);
  c.truth = Refused{"no such scene"};
  CHECK(faultyRows(outcomesOf(c)) == 4);
  c.scene = []() -> pt::SceneDescription { throw std::runtime_error("broken"); };
  CHECK(faultyRows(outcomesOf(c)) == 4);
}

TEST_CASE("A guide that loses is a fault unless a reason is given, and so is a rejected sample") {
  StabilityCase c = smallFurnace(1);
  c.renders.adjust = [](pt::RenderSettings& s) {
    if (s.guiding) s.spp = 2;  // many times the error
  };
  CHECK(faultyRows(outcomesOf(c)) == 0);
  c.knownLoss.clear();
  CHECK(faultyRows(outcomesOf(c)) == 3);
  StabilityCase rejects = smallFurnace(1);
  rejects.rejects = true;
  CHECK(faultyRows(outcomesOf(rejects)) == 4);
}

TEST_CASE("The score of the worst tile is that of chance for equal pictures, and finds a tile that is off") {
  Random random(1);
  int beyond = 0;
  for (int i = 0; i < 400; ++i)
    beyond += std::abs(biasScore(noise(8, 1, random), noise(8, 1, random), 0)) > scoreOfChance(0.05);
  CHECK(beyond > 4);
  CHECK(beyond < 40);
  std::vector<pt::Image> off = noise(8, 1, random);
  for (pt::Image& picture : off)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 2; ++x) picture.at(x, y) += pt::Spectrum(1.0f);
  CHECK(biasScore(off, noise(8, 1, random), 0) > 4);
  CHECK(scoreOfChance(0.0455) == Approx(2).epsilon(1e-3));
}

TEST_CASE("Subnormal numbers are flushed where it is asked for, and nowhere else") {
  const auto halfOfSmallest = [] {
    volatile float smallest = std::numeric_limits<float>::min();
    return smallest / 2;
  };
  CHECK(halfOfSmallest() > 0);
  {
    const SubnormalMode flushing(true);
    CHECK(halfOfSmallest() == 0);
  }
  CHECK(halfOfSmallest() > 0);
}

TEST_CASE("The report holds every row, and the page too") {
  const StabilityCase c = smallFurnace(1);
  StabilityRun run{outcomesOf(c), 0, 0};
  run.zBound = judgeBias(run.outcomes);
  const auto json = stabilityToJson(run);
  CHECK(json.at("cases").size() == 1);
  CHECK(json.at("cases")[0].at("rows").size() == 4);
  CHECK(stabilityPage(json).find("test/furnace") != std::string::npos);
}
