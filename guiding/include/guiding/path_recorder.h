#pragma once

#include <ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "guiding/sample.h"

namespace guiding {

/// Turns the events of one path, which may branch, into RadianceSamples with one backward pass over its vertices.
///
/// Radiance is accumulated from the end of the path to its start, so nothing is ever divided by the throughput. A
/// recorder is used by one thread at a time and keeps its memory from path to path.
///
/// Order of calls along a path: begin(); then at each scattering vertex addDirect() (if light was sampled there) and
/// scatter(); after the next intersection setDistance() (unless the ray left the scene), addEmission() (if light was
/// met) and, if roulette was played there and the path went on, survived(); at the end finish().
///
/// A path that is split at a vertex takes the events of one branch after the other: keep place() before the first, and
/// returnTo() it before each further one.
class PathRecorder {
 public:
  void begin() noexcept {
    m_vertices.clear();
    m_end = kRoot;
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
    if (m_vertices.size() < m_vertices.capacity() || grow()) {
      const auto index = Place(m_vertices.size());
      m_vertices.emplace_back(event, m_end);
      m_end = index;
    } else {
      ++m_lost;
    }
  }

  /// Light sampled at the vertex that the last scatter() reached (or, before any scatter, at the first vertex, which no
  /// sample learns from). `contribution` is BSDF * cos * Le * misWeight / pdf at that vertex, without the throughput.
  void addDirect(const Imath::V3f& contribution) noexcept {
    if (m_end != kRoot) m_vertices[m_end].scattered += contribution;
  }

  /// Emission met by the ray of the last scatter(), already times its MIS weight.
  void addEmission(const Imath::V3f& emission) noexcept {
    if (m_end != kRoot) m_vertices[m_end].incident += emission;
  }

  /// Distance of the vertex that the last scatter() reached. Not called when its ray left the scene.
  void setDistance(float distance) noexcept {
    if (m_end != kRoot) m_vertices[m_end].distance = distance;
  }

  /// The path outlived Russian roulette or was split at the vertex that the last scatter() reached. `factor` > 0: the
  /// number of branches that was expected, below 1 the chance of survival; each branch there counts 1 / factor.
  void survived(float factor) noexcept {
    if (m_end != kRoot) m_vertices[m_end].inverseFactor /= factor;
  }

  /// Where the path stands: at the vertex that the last scatter() reached.
  using Place = std::uint32_t;
  Place place() const noexcept { return m_end; }
  /// Goes on where place() once was on this path.
  void returnTo(Place place) noexcept { m_end = place; }

  /// Appends one sample for each event that is not a delta event, in their order, and forgets the path. A path that
  /// outgrew the memory yields no sample; `out` counts them as lost.
  void finish(SampleBuffer& out) noexcept;

 private:
  static constexpr float kNoDistance = -1;
  static constexpr Place kRoot = ~Place(0);  ///< the path has not scattered yet

  /// Each V3f fills a 16-byte slot with one float: what was stored as one is read back without a stall.
  struct alignas(16) Vertex {
    Vertex(const Scatter& e, Place parentVertex) noexcept : event(e), parent(parentVertex) {}

    Scatter event;
    Imath::V3f scattered{0, 0, 0};  ///< towards this vertex at the end of its ray: by light sampling and all branches
    float distance = kNoDistance;   ///< to the end of its ray
    Imath::V3f incident{0, 0, 0};   ///< arrives at this vertex along its ray: emission, after finish() all
    float inverseFactor = 1;        ///< 1 / number of branches there that was expected
    Place parent;                   ///< the vertex whose ray ends where this one scatters
  };
  bool grow() noexcept;

  std::vector<Vertex> m_vertices;  ///< parents before their branches
  Place m_end = kRoot;
  std::size_t m_lost = 0;  ///< vertices for which there was no memory
};

}  // namespace guiding
