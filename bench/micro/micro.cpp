#include "micro/micro.h"

#include "synthetic/training.h"

namespace bench {

namespace {

guiding::FieldSettings settings(guiding::CompensationForm form, bool product) {
  guiding::FieldSettings s = guiding::FieldSettings::mueller2017();
  s.sTreeThreshold = 1000;
  s.compensation.form = form;
  s.product = product;
  return s;
}

}  // namespace

int runMicro(int argc, char** argv, const std::function<void()>& registerMore) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  using enum guiding::CompensationForm;
  const guiding::Field plain = trainField(nearLights(), settings(None, false), {}, 1);
  const guiding::Field compensated = trainField(nearLights(), settings(WaterFilling, false), {}, 1);
  const guiding::Field product = trainField(nearLights(), settings(None, true), {}, 1);
  const guiding::Field both = trainField(nearLights(), settings(WaterFilling, true), {}, 1);
  registerLookups("plain", plain);
  registerLookups("compensated", compensated);
  registerLookups("product", product);
  registerLookups("product+compensated", both);
  registerTraining();
  registerStorage("plain", plain);
  if (registerMore) registerMore();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace bench
