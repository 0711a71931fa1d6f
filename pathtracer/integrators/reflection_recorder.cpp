#include "integrators/reflection_recorder.h"

namespace pt {

namespace {

bool makeRoom(std::vector<guiding::ReflectionSample>& samples) noexcept {
  try {
    if (samples.size() == samples.capacity()) samples.reserve(samples.empty() ? 1024 : 2 * samples.size());
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace

void ReflectionRecorder::closeTo(std::size_t count, std::vector<guiding::ReflectionSample>& out) noexcept {
  for (; m_open.size() > count; m_open.pop_back()) {
    const Open& branch = m_open.back();
    guiding::ReflectionSample sample{branch.position, Vec3(0.0f), float(m_cost - branch.costBefore)};
    for (int c = 0; c < 3; ++c)
      if (branch.throughput[c] > 0)
        sample.reflected[c] = float((m_found[c] - branch.foundBefore[c]) / double(branch.throughput[c]));
    if (makeRoom(out)) out.push_back(sample);
  }
}

}  // namespace pt
