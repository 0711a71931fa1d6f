#include "micro/micro.h"

#include "synthetic/training.h"

namespace bench {

namespace {

guiding::FieldSettings settings(guiding::CompensationForm form) {
  guiding::FieldSettings s = guiding::FieldSettings::mueller2017();
  s.sTreeThreshold = 1000;
  s.compensation.form = form;
  return s;
}

}  // namespace

int runMicro(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const guiding::Field plain = trainField(nearLights(), settings(guiding::CompensationForm::None), {}, 1);
  const guiding::Field compensated = trainField(nearLights(), settings(guiding::CompensationForm::WaterFilling), {}, 1);
  registerLookups("plain", plain);
  registerLookups("compensated", compensated);
  registerTraining();
  registerStorage("plain", plain);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace bench
