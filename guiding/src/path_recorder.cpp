#include "guiding/path_recorder.h"

#include <limits>

#include "grow.h"

namespace guiding {

namespace {
float mean(const Imath::V3f& c) noexcept {
  return (c.x + c.y + c.z) * (1.0f / 3.0f);
}
}  // namespace

bool PathRecorder::grow() noexcept {
  return growVector(m_vertices);
}

void PathRecorder::finish(SampleBuffer& out) noexcept {
  if (m_lost > 0) {  // what was recorded after the loss belongs to vertices that are not there
    out.addLost(m_vertices.size() + m_lost);
    begin();
    return;
  }
  // Radiance that arrives along a vertex' ray: what its end emits, plus what its end scatters on, divided by the chance
  // (or the number of branches) with which the path was allowed to find that out. From the ends of the path to its
  // start [Müller et al. 2017, Sec. 3, without their division].
  for (std::size_t i = m_vertices.size(); i-- > 0;) {
    Vertex& v = m_vertices[i];
    v.incident += v.scattered * v.inverseFactor;
    if (v.parent != kRoot) m_vertices[v.parent].scattered += v.event.weight * v.incident;
  }
  for (const Vertex& v : m_vertices) {
    if (v.event.isDelta) continue;
    RadianceSample sample;
    sample.position = v.event.position;
    sample.direction = v.event.wi;
    sample.radiance = mean(v.incident);
    sample.product = mean(v.event.bsdfCos * v.incident);
    sample.pdf = v.event.pdf;
    sample.bsdfPdf = v.event.bsdfPdf;
    sample.guidePdf = v.event.guidePdf;
    sample.distance = v.distance < 0 ? std::numeric_limits<float>::infinity() : v.distance;
    out.add(sample);
  }
  begin();
}

}  // namespace guiding
