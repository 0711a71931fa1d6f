#include "guiding/path_recorder.h"

#include <algorithm>
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
  // that the path was allowed to find that out. From the end of the path to its start [Müller et al. 2017, Sec. 3,
  // without their division].
  Imath::V3f scattered(0, 0, 0);
  for (std::size_t i = m_vertices.size(); i-- > 0;) {
    Vertex& v = m_vertices[i];
    const Imath::V3f incident = v.emission + (v.direct + scattered) * v.inverseSurvival;
    v.radiance = mean(incident);
    v.product = mean(v.event.bsdfCos * incident);
    scattered = v.event.weight * incident;
  }
  for (const Vertex& v : m_vertices) {
    if (v.event.isDelta) continue;
    RadianceSample sample;
    sample.position = v.event.position;
    sample.direction = v.event.wi;
    sample.radiance = v.radiance;
    sample.product = v.product;
    sample.pdf = v.event.pdf;
    sample.bsdfPdf = v.event.bsdfPdf;
    sample.guidePdf = v.event.guidePdf;
    sample.distance = v.distance < 0 ? std::numeric_limits<float>::infinity() : v.distance;
    out.add(sample);
  }
  m_vertices.clear();
}

}  // namespace guiding
