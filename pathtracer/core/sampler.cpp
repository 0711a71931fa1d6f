#include "core/sampler.h"

namespace pt {

void Sampler::startPath(int x, int y, std::uint32_t index) noexcept {
  const auto pixel = std::uint64_t(std::uint32_t(x)) | (std::uint64_t(std::uint32_t(y)) << 32);
  m_pixelHash = combineHash(m_seedHash, pixel);
  m_reversedIndex = reverseBits(index);
  m_dimension = 0;
  if (m_kind == SamplerKind::Independent) {
    const std::uint64_t hash = combineHash(m_pixelHash, index);
    m_generator = Pcg32(hash, mix64(hash));
  }
}

}  // namespace pt
