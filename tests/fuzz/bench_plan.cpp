#include "core/error.h"
#include "input_folder.h"
#include "plan/plan.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  try {
    bench::loadPlan(folder.write("plan.json", std::span(data, size)));
  } catch (const pt::InputError&) {
  }
  return 0;
}
