#include "guiding/schedule.h"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "catch.h"
#include "statistics/z_test.h"

using namespace guiding;

namespace {

struct Planned {
  IterationPlan plan;
  IterationOutcome outcome;
};

/// Runs a schedule to its end. `outcomeOf(plan)` says how an iteration came out.
template <class OutcomeOf>
std::vector<Planned> run(TrainingSchedule& schedule, OutcomeOf&& outcomeOf) {
  std::vector<Planned> iterations;
  for (IterationPlan plan = schedule.next(); plan.spp > 0; plan = schedule.next()) {
    REQUIRE(iterations.size() < 100);
    const IterationOutcome outcome = outcomeOf(plan);
    schedule.report(plan, outcome);
    iterations.push_back({plan, outcome});
  }
  return iterations;
}

std::vector<std::int64_t> sppOf(const std::vector<Planned>& iterations) {
  std::vector<std::int64_t> spp;
  for (const Planned& i : iterations) spp.push_back(i.outcome.spp);
  return spp;
}

/// The variance of an iteration whose samples have variance `ofSample`.
auto withVariance(std::vector<double> ofSample) {
  return [=](const IterationPlan& plan) {
    const double v = ofSample[std::min<std::size_t>(std::size_t(plan.index), ofSample.size() - 1)];
    return IterationOutcome{plan.spp, v / double(plan.spp), 0.01 * double(plan.spp)};
  };
}

ScheduleSettings settings(SampleCombination combination, int sppPerPass = 4) {
  ScheduleSettings s;
  s.combination = combination;
  s.sppPerPass = sppPerPass;
  return s;
}

double sum(const std::vector<double>& x) {
  return std::accumulate(x.begin(), x.end(), 0.0);
}

/// A renderer of `sppPerSecond` that stops a pass of 4 spp after the budget is spent.
auto clocked(double budget, double sppPerSecond, double& elapsed) {
  return [&elapsed, budget, sppPerSecond](const IterationPlan& plan) {
    IterationOutcome outcome{0, 1, 0};
    while (outcome.spp < plan.spp && (outcome.spp == 0 || elapsed < budget)) {
      outcome.spp += 4;
      outcome.seconds += 4 / sppPerSecond;
      elapsed += 4 / sppPerSecond;
    }
    return outcome;
  };
}

constexpr double kInf = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("Iterations double, and the last takes the rest") {
  TrainingSchedule schedule(settings(SampleCombination::Discard), 127, 0);
  const auto iterations = run(schedule, withVariance({1}));
  CHECK(sppOf(iterations) == std::vector<std::int64_t>{4, 8, 16, 32, 67});  // 64 would leave 3
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    CHECK(iterations[i].plan.index == int(i));
    CHECK(iterations[i].plan.isFinal == (i + 1 == iterations.size()));
    CHECK(!iterations[i].plan.keepsDensity);
  }
}

TEST_CASE("Every sample budget is met exactly, by doubling iterations and one final one") {
  std::mt19937 engine(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const int perPass = 1 + int(engine() % 20);
    const std::int64_t budget = 1 + engine() % 100'000;
    const auto combination = SampleCombination(engine() % 3);
    TrainingSchedule schedule(settings(combination, perPass), budget, 0);
    const auto iterations = run(schedule, withVariance({1, 0.5, 0.25, 0.125, 0.1, 0.09, 0.09, 0.09}));
    const std::vector<std::int64_t> spp = sppOf(iterations);
    CAPTURE(perPass, budget, int(combination));
    REQUIRE(std::accumulate(spp.begin(), spp.end(), std::int64_t(0)) == budget);
    REQUIRE(iterations.back().plan.isFinal);
    for (std::size_t i = 0; i + 1 < spp.size(); ++i) REQUIRE(spp[i] == std::int64_t(perPass) << i);
    if (spp.size() > 1 && !iterations.back().plan.keepsDensity)
      REQUIRE(spp.back() >= std::int64_t(perPass) << (spp.size() - 1));
    REQUIRE(sum(schedule.imageWeights()) == Approx(1));
    REQUIRE(schedule.imageWeights().size() == iterations.size());
  }
}

TEST_CASE("Budgets below one pass are one final iteration") {
  for (const std::int64_t budget : {1, 3, 4, 11}) {
    TrainingSchedule schedule(settings(SampleCombination::Automatic), budget, 0);
    CHECK(sppOf(run(schedule, withVariance({1}))) == std::vector<std::int64_t>{budget});
  }
}

TEST_CASE("No budget: nothing to do, and no picture") {
  for (const double seconds : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const TrainingSchedule schedule(ScheduleSettings(), 0, seconds);
    CHECK(schedule.next().spp == 0);
    CHECK(schedule.imageWeights().empty());
  }
}

TEST_CASE("The largest budgets do not overflow") {
  TrainingSchedule schedule(settings(SampleCombination::Discard, 1 << 20), std::int64_t(1) << 55, 0);
  for (const Planned& i : run(schedule, withVariance({1}))) CHECK(i.plan.spp > 0);
}

TEST_CASE("Training ends when another doubling would not pay, and the density is kept") {
  TrainingSchedule schedule(settings(SampleCombination::Automatic), 10'000, 0);
  // Each sample is as good as those before: the third iteration that may decide (after 4 + ... + 256 spp) stops.
  const auto iterations = run(schedule, withVariance({1}));
  REQUIRE(iterations.size() == 8);
  CHECK(iterations[6].plan.spp == 256);
  CHECK(iterations[7].plan.keepsDensity);
  CHECK(iterations[7].plan.isFinal);
  const std::vector<double> weights = schedule.imageWeights();
  const double kept = 256, last = double(iterations[7].outcome.spp);
  CHECK(weights[6] == Approx(kept / (kept + last)));
  CHECK(weights[7] == Approx(last / (kept + last)));
  CHECK(sum(weights) == Approx(1));
}

TEST_CASE("Training goes on while it halves the variance of a sample") {
  TrainingSchedule schedule(settings(SampleCombination::Automatic), 10'000, 0);
  std::vector<double> halving;
  for (int i = 0; i < 20; ++i) halving.push_back(std::ldexp(1.0, -i));
  const auto iterations = run(schedule, withVariance(halving));
  CHECK(!iterations.back().plan.keepsDensity);
  CHECK(schedule.imageWeights().back() == 1);
}

TEST_CASE("An unknown variance does not end training") {
  TrainingSchedule schedule(settings(SampleCombination::Automatic), 10'000, 0);
  for (const Planned& i : run(schedule, withVariance({0}))) CHECK(!i.plan.keepsDensity);
}

TEST_CASE("Discard shows the last iteration, or the one before where the last was cut short") {
  TrainingSchedule schedule(settings(SampleCombination::Discard), 1000, 0);
  const std::int64_t spp[] = {4, 8, 16};
  for (int i = 0; i < 3; ++i) schedule.report(schedule.next(), {spp[i], 1, 1});
  CHECK(schedule.imageWeights() == std::vector<double>{0, 0, 1});
  schedule.report(schedule.next(), {12, 1, 1});
  CHECK(schedule.imageWeights() == std::vector<double>{0, 0, 1, 0});
}

TEST_CASE("Inverse variance weights of the last iterations") {
  ScheduleSettings s = settings(SampleCombination::InverseVariance);
  s.combinedIterations = 3;
  TrainingSchedule schedule(s, 10'000, 0);
  for (const double variance : {1.0, 0.5, 0.25, 0.125}) schedule.report(schedule.next(), {4, variance, 1});
  const std::vector<double> weights = schedule.imageWeights();
  CHECK(weights[0] == 0);
  CHECK(weights[1] == Approx(2.0 / 14));
  CHECK(weights[2] == Approx(4.0 / 14));
  CHECK(weights[3] == Approx(8.0 / 14));
}

TEST_CASE("A short iteration that looks too good counts no more a sample than a later one") {
  TrainingSchedule schedule({1, SampleCombination::InverseVariance, 4, 0.25f}, 147, 0);
  const IterationOutcome outcomes[] = {{1, 0, 1}, {2, 0.575, 1}, {4, 56.2, 1}, {8, 55.1, 1}, {132, 2.44, 1}};
  for (const IterationOutcome& outcome : outcomes) schedule.report(schedule.next(), outcome);
  const std::vector<double> weights = schedule.imageWeights();
  CHECK(weights[0] == 0);
  for (int i = 1; i < 4; ++i)
    CHECK(weights[i] / double(outcomes[i].spp) <= weights[4] / double(outcomes[4].spp) * (1 + 1e-12));
  CHECK(weights[4] > 0.9);
}

namespace {

/// The mean and the variance of the mean of one half's pixels, 16 with `spp` samples each: 20 in one of 20, otherwise
/// 0.
struct HalfPicture {
  double mean = 0, variance = 0;

  HalfPicture(std::mt19937& engine, int spp) {
    constexpr int kPixels = 16;
    std::binomial_distribution<int> hits(spp, 0.05);
    for (int i = 0; i < kPixels; ++i) {
      const double value = 20.0 * hits(engine) / spp;
      mean += value / kPixels;
      variance += value * (20 - value) / (spp - 1) / kPixels;
    }
  }
};

}  // namespace

TEST_CASE("Weights by the other half of the picture leave the mean alone; weights by all of it would not") {
  std::mt19937 engine(3);
  constexpr int kPictures = 20'000;
  test::RunningMean crossed, own;
  for (int picture = 0; picture < kPictures; ++picture) {
    TrainingSchedule schedule({2, SampleCombination::InverseVariance, 4, 1}, 30, 0);
    std::vector<std::array<HalfPicture, 2>> halves;
    for (IterationPlan plan = schedule.next(); plan.spp > 0; plan = schedule.next()) {
      halves.push_back({HalfPicture(engine, int(plan.spp)), HalfPicture(engine, int(plan.spp))});
      const auto& [a, b] = halves.back();
      IterationOutcome outcome{plan.spp, (a.variance + b.variance) / 2, 1};
      outcome.halfVariance = {a.variance, b.variance};
      schedule.report(plan, outcome);
    }
    double byOther = 0, byAll = 0;
    for (std::size_t i = 0; i < halves.size(); ++i)
      for (int half = 0; half < 2; ++half) {
        byOther += schedule.imageWeights(half)[i] * halves[i][half].mean / 2;
        byAll += schedule.imageWeights()[i] * halves[i][half].mean / 2;
      }
    crossed.add(byOther);
    own.add(byAll);
  }
  const test::ZResult unbiased = test::zTest(crossed, 1, 1e-4), biased = test::zTest(own, 1, 1e-4);
  INFO(unbiased.message);
  CHECK(unbiased);
  CHECK(biased.z < -10);
}

TEST_CASE("An iteration that looks exact counts as much a sample as those beside it") {
  TrainingSchedule schedule({1, SampleCombination::InverseVariance, 4, 1}, 15, 0);
  for (const double variance : {0.0, 1.0, 0.5, 0.0}) {
    const IterationPlan plan = schedule.next();
    schedule.report(plan, {plan.spp, variance, 1});
  }
  const std::vector<double> weights = schedule.imageWeights();
  REQUIRE(weights.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(weights[i] == Approx(double(1 << i) / 15));
}

TEST_CASE("Weights sum to one whatever was reported") {
  std::mt19937 engine(2);
  const double odd[] = {0, 1, 1e-320, 1e300, kInf, -1, std::numeric_limits<double>::quiet_NaN()};
  for (int trial = 0; trial < 3000; ++trial) {
    ScheduleSettings s = settings(SampleCombination(trial % 3));
    s.combinedIterations = 1 + int(engine() % 5);
    TrainingSchedule schedule(s, 1 << 20, 0);
    const int count = 1 + int(engine() % 6);
    for (int i = 0; i < count; ++i) {
      IterationPlan plan = schedule.next();
      plan.keepsDensity = engine() % 4 == 0;
      IterationOutcome outcome{std::int64_t(engine() % 3) * 4, odd[engine() % 7], 0};
      outcome.halfVariance = {odd[engine() % 7], odd[engine() % 7]};
      schedule.report(plan, outcome);
    }
    for (const std::vector<double>& weights :
         {schedule.imageWeights(), schedule.imageWeights(0), schedule.imageWeights(1)}) {
      REQUIRE(weights.size() == std::size_t(count));
      for (const double w : weights) REQUIRE((w >= 0 && w <= 1));
      REQUIRE(sum(weights) == Approx(1));
    }
  }
}

TEST_CASE("Training keeps to its share of the budget, and the whole budget is spent") {
  for (const float share : {0.01f, 0.1f, 0.25f, 0.4f, 1.0f})
    for (const std::int64_t budget : {1, 4, 5, 64, 127, 1000, 4096}) {
      ScheduleSettings s{1, SampleCombination::InverseVariance, 4, share};
      TrainingSchedule schedule(s, budget, 0);
      std::int64_t training = 0, last = 0, total = 0;
      for (IterationPlan plan = schedule.next(); plan.spp > 0; plan = schedule.next()) {
        if (!plan.isFinal) training += last = plan.spp;
        total += plan.spp;
        schedule.report(plan, {plan.spp, 1, 1});
      }
      CAPTURE(share, budget, training);
      CHECK(total == budget);
      CHECK(double(training) <= share * double(budget));
      // One iteration more would have been too much, by the share or by the doubling.
      const double more = training + std::max<double>(1, 2.0 * double(last));
      CHECK((more > share * double(budget) || more > 0.5 * double(budget)));
    }
}

TEST_CASE("Guiding that does not pay is left after its trial, and guiding that pays goes on") {
  struct Case {
    double guided, unguided, predicted;  ///< relative variance of a sample
    double guidedSeconds;                ///< of a sample; unguided 0.01
    bool pays, paysBySamples;
    double stratification = 1;
  };
  for (const Case& c :
       {Case{1, 2, 2, 0.01, true, true}, Case{2, 1, 1, 0.01, false, false}, Case{1, 1.5, 1.5, 0.02, false, true},
        Case{2, 1.5, 1.5, 0.005, true, false}, Case{1, 1.2, 1.2, 0.01, true, true},  // by a tenth and more
        Case{1, 1.05, 1.05, 0.01, false, false},                                     // by less
        Case{1, 0.5, 10, 0.01, true, true},          // rare light that only guided samples have seen
        Case{1, 0.5, 10, 0.01, false, false, 0.05},  // the same, were it not for stratification
        Case{0, 1, 1, 0.01, true, true}})            // unknown
    for (const bool bySamples : {false, true}) {
      ScheduleSettings s{1, SampleCombination::InverseVariance, 4, 1};
      s.trialShare = 0.1f;
      const std::int64_t budget = 1000;
      TrainingSchedule schedule(s, bySamples ? budget : 0, bySamples ? 0 : 0.01 * double(budget));
      double elapsed = 0;
      const auto iterations = run(schedule, [&](const IterationPlan& plan) {
        const double seconds = plan.usesGuide && plan.index > 0 ? c.guidedSeconds : 0.01;
        IterationOutcome outcome;
        outcome.spp = std::min(plan.spp, std::int64_t((0.01 * double(budget) - elapsed) / seconds) + 1);
        if (bySamples) outcome.spp = plan.spp;
        const double n = double(outcome.spp);
        outcome.seconds = outcome.tracingSeconds = seconds * n;
        elapsed += outcome.seconds;
        outcome.variance = outcome.relativeVariance = (plan.usesGuide ? c.guided : c.unguided) / n;
        outcome.unguidedRelativeVariance = (plan.usesGuide ? c.predicted : c.unguided) / n;
        if (!plan.usesGuide) outcome.stratification = c.stratification;
        return outcome;
      });
      CAPTURE(c.guided, c.unguided, c.predicted, c.guidedSeconds, bySamples);

      std::vector<std::size_t> without;
      for (std::size_t i = 0; i < iterations.size(); ++i)
        if (!iterations[i].plan.usesGuide) without.push_back(i);
      REQUIRE(!without.empty());
      const std::size_t trial = without[0];
      CHECK(iterations[trial].plan.spp == iterations[trial - 1].plan.spp);
      CHECK(!iterations[trial].plan.isFinal);
      double before = 0;
      for (std::size_t i = 0; i < trial; ++i)
        before += bySamples ? double(iterations[i].outcome.spp) : iterations[i].outcome.seconds;
      CHECK(before <= 0.1 * (bySamples ? double(budget) : 0.01 * double(budget)));
      if (bySamples ? c.paysBySamples : c.pays) {
        CHECK(without.size() == 1);
        CHECK(iterations[trial + 1].plan.spp == 2 * iterations[trial - 1].plan.spp);
        CHECK(iterations[trial + 1].plan.keepsDensity);  // the trial taught nothing
        CHECK(!iterations[trial + 2].plan.keepsDensity);
        CHECK(iterations.size() > trial + 2);
      } else {
        CHECK(iterations.size() == trial + 2);
        CHECK(!iterations.back().plan.usesGuide);
        CHECK(iterations.back().plan.keepsDensity);
      }
      CHECK(iterations.back().plan.isFinal);
      CHECK(sum(schedule.imageWeights()) == Approx(1));
    }
}

TEST_CASE("A trial that guiding wins neither ends training nor weighs upon other iterations") {
  for (const SampleCombination combination : {SampleCombination::Automatic, SampleCombination::InverseVariance}) {
    ScheduleSettings s{4, combination, 20, 1};
    s.trialShare = 0.1f;
    TrainingSchedule schedule(s, 10'000, 0);
    // A sample's variance halves from iteration to iteration, as long as training goes on; the trial's is far worse.
    const bool improves = combination == SampleCombination::Automatic;
    const auto iterations = run(schedule, [&](const IterationPlan& plan) {
      const double ofSample = (plan.usesGuide ? 1.0 : 4.0) * (improves ? std::ldexp(1.0, -plan.index) : 1);
      IterationOutcome outcome{plan.spp, ofSample / double(plan.spp), 1};
      outcome.relativeVariance = outcome.variance;
      return outcome;
    });
    const auto trial =
        std::find_if(iterations.begin(), iterations.end(), [](const Planned& i) { return !i.plan.usesGuide; });
    REQUIRE(trial != iterations.end());
    REQUIRE(trial->plan.spp >= 256);
    CHECK(!(trial + 1)->plan.isFinal);
    if (improves) continue;

    const std::vector<double> weights = schedule.imageWeights();
    const double ofLast = weights.back() / double(iterations.back().outcome.spp);
    for (std::size_t i = 0; i < iterations.size(); ++i) {
      CAPTURE(i);
      const double share = iterations[i].plan.usesGuide ? 1 : 0.25;
      CHECK(weights[i] / double(iterations[i].outcome.spp) == Approx(share * ofLast));
    }
  }
}

TEST_CASE("Budgets too small for a trial have none") {
  ScheduleSettings s{1, SampleCombination::InverseVariance, 4, 1};
  s.trialShare = 0.1f;
  for (const std::int64_t budget : {1, 2, 5, 9}) {
    TrainingSchedule schedule(s, budget, 0);
    for (const Planned& i : run(schedule, withVariance({1}))) CHECK(i.plan.usesGuide);
  }
}

TEST_CASE("The last iteration is as long as its ratio to the one before asks") {
  for (const float ratio : {0.0f, 0.5f, 1.0f, 2.0f, 5.0f})
    for (const std::int64_t budget : {40, 100, 127, 200, 255}) {
      ScheduleSettings s{1, SampleCombination::InverseVariance, 4, 1};
      s.finalRatio = ratio;
      TrainingSchedule schedule(s, budget, 0);
      const auto iterations = run(schedule, withVariance({1}));
      CAPTURE(ratio, budget);
      std::int64_t spent = 0;
      for (std::size_t i = 0; i < iterations.size(); ++i) {
        const std::int64_t length = std::int64_t(1) << i;
        const bool isLast = double(budget - spent - length) < double(ratio) * double(length);
        CHECK(iterations[i].plan.isFinal == isLast);
        CHECK(iterations[i].plan.spp == (isLast ? budget - spent : length));
        spent += iterations[i].plan.spp;
      }
      CHECK(spent == budget);
    }
}

TEST_CASE("A time budget is spent, training counted in") {
  for (const auto combination :
       {SampleCombination::Discard, SampleCombination::Automatic, SampleCombination::InverseVariance})
    for (const double budget : {1e-9, 0.5, 1.0, 7.0, 100.0}) {
      TrainingSchedule schedule(settings(combination), 0, budget);
      double elapsed = 0;
      const auto iterations = run(schedule, clocked(budget, 40, elapsed));
      CAPTURE(int(combination), budget);
      CHECK(elapsed >= budget);
      CHECK(elapsed < budget + 0.11);
      CHECK(sum(schedule.imageWeights()) == Approx(1));
      for (std::size_t i = 0; i < iterations.size(); ++i)
        CHECK(iterations[i].plan.spp ==
              (iterations[i].plan.isFinal ? TrainingSchedule::kUntilTimeIsOver : std::int64_t(4) << i));
    }
}

TEST_CASE("Without end, the schedule doubles without end") {
  TrainingSchedule schedule(settings(SampleCombination::Discard), 0, kInf);
  for (int i = 0; i < 40; ++i) {
    const IterationPlan plan = schedule.next();
    REQUIRE(plan.spp > 0);
    REQUIRE(!plan.isFinal);
    schedule.report(plan, {plan.spp, 1, 1});
  }
}

TEST_CASE("Schedule settings out of range are refused by name") {
  ScheduleSettings s;
  CHECK(s.validate().ok());
  for (const int bad : {0, -1, (1 << 20) + 1}) {
    s = {};
    s.sppPerPass = bad;
    REQUIRE(!s.validate());
    CHECK_THAT(s.validate().error().text, Catch::Contains("sppPerPass"));
  }
  s = {};
  s.combinedIterations = 0;
  REQUIRE(!s.validate());
  CHECK_THAT(s.validate().error().text, Catch::Contains("combinedIterations"));
  for (const float bad : {0.0f, -0.5f, 1.01f, std::numeric_limits<float>::quiet_NaN()}) {
    s = {};
    s.trainingShare = bad;
    REQUIRE(!s.validate());
    CHECK_THAT(s.validate().error().text, Catch::Contains("trainingShare"));
  }
  for (const float bad : {-0.1f, 1.0f, std::numeric_limits<float>::quiet_NaN()}) {
    s = {};
    s.trialShare = bad;
    REQUIRE(!s.validate());
    CHECK_THAT(s.validate().error().text, Catch::Contains("trialShare"));
  }
  for (const float bad : {-0.1f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    s = {};
    s.finalRatio = bad;
    REQUIRE(!s.validate());
    CHECK_THAT(s.validate().error().text, Catch::Contains("finalRatio"));
  }
  s = {};
  s.combination = SampleCombination(7);
  CHECK(!s.validate());
}
