#pragma once

#include <ImathVec.h>

#include <cstdint>
#include <random>

namespace test {

/// Uniform numbers in [0,1) from a fixed seed: the same on every platform, and not the generator under test.
class Random {
 public:
  explicit Random(std::uint64_t seed) : m_engine(seed) {}

  float next1D() { return float(m_engine() >> 40) * 0x1p-24f; }
  Imath::V2f next2D() {
    const float x = next1D();
    return {x, next1D()};
  }

 private:
  std::mt19937_64 m_engine;
};

}  // namespace test
