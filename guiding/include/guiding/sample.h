#pragma once

#include <ImathVec.h>

#include <cstddef>
#include <span>
#include <vector>

namespace guiding {

/// What training learns from: one scattering event of one path.
struct RadianceSample {
  Imath::V3f position;   ///< where the path scattered, world space
  Imath::V3f direction;  ///< wi: unit vector of the sampled direction, pointing to where the radiance comes from
  float radiance =
      0;  ///< estimate of the incident radiance from `direction`, mean of the colour channels, >= 0; zero counts
  float product = 0;   ///< estimate of radiance * BSDF * cos, mean of the colour channels, >= 0
  float pdf = 0;       ///< density of `direction` (mixture of BSDF and guide), per solid angle, > 0
  float bsdfPdf = 0;   ///< the BSDF sampler's own density of `direction`, per solid angle, >= 0
  float guidePdf = 0;  ///< the guide's density of `direction`, per solid angle; 0 where no guide was mixed in
  float distance = 0;  ///< to the next vertex along `direction`, scene units; infinity when the ray left the scene. For
                       ///< learners that ask for it; Field does not
};

/// Samples of one tile in the order in which its paths were traced. Keeps its memory between uses.
class SampleBuffer {
 public:
  void clear() noexcept {
    m_samples.clear();
    m_lost = 0;
  }
  /// Makes room ahead of time. Where there is none, add() will tell.
  void reserve(std::size_t count) noexcept;
  void add(const RadianceSample& sample) noexcept {
    if (m_samples.size() < m_samples.capacity() || grow())
      m_samples.push_back(sample);
    else
      ++m_lost;
  }
  std::size_t size() const noexcept { return m_samples.size(); }
  std::span<const RadianceSample> samples() const noexcept { return m_samples; }

  /// Samples for which there was no memory; a field counts them as dropped.
  std::size_t lost() const noexcept { return m_lost; }
  void addLost(std::size_t count) noexcept { m_lost += count; }

 private:
  bool grow() noexcept;

  std::vector<RadianceSample> m_samples;
  std::size_t m_lost = 0;
};

}  // namespace guiding
