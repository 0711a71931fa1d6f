#pragma once

#include <ImathVec.h>

#include <cstddef>
#include <vector>

#include "guiding/sample.h"

namespace guiding {

/// Turns the events of one path into RadianceSamples with one backward pass over its vertices.
///
/// Radiance is accumulated from the end of the path to its start, so nothing is ever divided by the throughput. A
/// recorder is used by one thread at a time and keeps its memory from path to path.
///
/// Order of calls along a path: begin(); then at each scattering vertex addDirect() (if light was sampled there) and
/// scatter(); after the next intersection setDistance() (unless the ray left the scene), addEmission() (if light was
/// met) and, if roulette was played there and the path went on, survived(); at the end finish().
class PathRecorder {
 public:
  void begin() noexcept {
    m_vertices.clear();
    m_lost = 0;
  }

  /// One scattering event.
  struct Scatter {
    Imath::V3f position;   ///< world space
    Imath::V3f wi;         ///< sampled direction, unit
    Imath::V3f weight;     ///< BSDF * |cos| / pdf, per channel (for a delta event its throughput weight)
    Imath::V3f bsdfCos;    ///< BSDF * |cos| alone, per channel; unused for delta events
    float pdf = 0;         ///< density of wi that was really used (the mixture), per solid angle
    float bsdfPdf = 0;     ///< the BSDF sampler's own density of wi, per solid angle
    float guidePdf = 0;    ///< the guide's density of wi, per solid angle; 0 without a guide
    bool isDelta = false;  ///< delta events carry radiance on but are not learned from
  };
  void scatter(const Scatter& event) noexcept {
    if (m_vertices.size() < m_vertices.capacity() || grow())
      m_vertices.emplace_back(event);
    else
      ++m_lost;
  }

  /// Light sampled at the vertex that the last scatter() reached (or, before any scatter, at the first vertex, which no
  /// sample learns from). `contribution` is BSDF * cos * Le * misWeight / pdf at that vertex, without the throughput.
  void addDirect(const Imath::V3f& contribution) noexcept {
    if (!m_vertices.empty()) m_vertices.back().direct += contribution;
  }

  /// Emission met by the ray of the last scatter(), already times its MIS weight.
  void addEmission(const Imath::V3f& emission) noexcept {
    if (!m_vertices.empty()) m_vertices.back().emission += emission;
  }

  /// Distance of the vertex that the last scatter() reached. Not called when its ray left the scene.
  void setDistance(float distance) noexcept {
    if (!m_vertices.empty()) m_vertices.back().distance = distance;
  }

  /// The path outlived Russian roulette at the vertex that the last scatter() reached with this probability, in (0, 1].
  void survived(float probability) noexcept {
    if (!m_vertices.empty()) m_vertices.back().inverseSurvival /= probability;
  }

  /// Appends one sample for each event that is not a delta event, first vertex first, and forgets the path. A path that
  /// outgrew the memory yields no sample; `out` counts them as lost.
  void finish(SampleBuffer& out) noexcept;

 private:
  static constexpr float kNoDistance = -1;

  /// Each V3f fills a 16-byte slot with one float: what was stored as one is read back without a stall.
  struct alignas(16) Vertex {
    explicit Vertex(const Scatter& e) noexcept : event(e) {}

    Scatter event;
    Imath::V3f direct{0, 0, 0};       ///< scattered towards this vertex at the end of its ray by light sampling there
    float distance = kNoDistance;     ///< to the end of its ray
    Imath::V3f emission{0, 0, 0};     ///< arrives at this vertex from the end of its ray
    float inverseSurvival = 1;        ///< 1 / chance that the path went on there
    float radiance = 0, product = 0;  ///< of the sample; filled by finish()
  };
  bool grow() noexcept;

  std::vector<Vertex> m_vertices;
  std::size_t m_lost = 0;  ///< vertices for which there was no memory
};

}  // namespace guiding
