#pragma once

#include <guiding/reflection_statistics.h>

#include <cstddef>
#include <vector>

#include "core/types.h"

namespace pt {

/// Turns the events of one path, which may branch, into ReflectionSamples: for each vertex and branch what the path
/// found after it, over the throughput with which it counts. Allocates nothing but room for the samples.
class ReflectionRecorder {
 public:
  ReflectionRecorder() { m_open.reserve(kMostOpen); }

  void begin() noexcept {
    m_open.clear();
    m_found = Imath::V3d(0.0);
    m_cost = 0;
  }

  /// A branch begins at the point; what is found from now on until it is closed came from there. A path too long to be
  /// followed is followed no further.
  void open(const Vec3& position, const Spectrum& throughput) noexcept {
    if (m_open.size() < m_open.capacity()) m_open.push_back({position, throughput, m_found, m_cost});
  }

  /// Radiance found, as it counts for the pixel.
  void add(const Spectrum& radiance) noexcept { m_found += Imath::V3d(radiance); }
  void addCost(float cost) noexcept { m_cost += cost; }

  std::size_t openCount() const noexcept { return m_open.size(); }

  /// Ends all branches but the first `count` that are open; one sample each goes to `out`, and none where there is no
  /// memory for it.
  void closeTo(std::size_t count, std::vector<guiding::ReflectionSample>& out) noexcept;

 private:
  static constexpr std::size_t kMostOpen = 256;

  /// Sums are kept in double: what a late vertex found is a small difference of them.
  struct Open {
    Vec3 position;
    Spectrum throughput;
    Imath::V3d foundBefore;
    double costBefore;
  };
  std::vector<Open> m_open;  ///< the vertices from the camera to where the path is
  Imath::V3d m_found{0.0};
  double m_cost = 0;
};

}  // namespace pt
