#include <guiding/serialize.h>

#include "byte_stream.h"
#include "input_folder.h"

namespace {

constexpr std::size_t kHeaderBytes = 28;

/// Bytes whose size and checksum are right, so that what lies behind them is looked at.
std::vector<std::uint8_t> forged(std::span<const std::uint8_t> data) {
  std::vector<std::uint8_t> bytes(data.begin(), data.end());
  if (bytes.size() < kHeaderBytes) return bytes;
  const auto payload = std::span<const std::uint8_t>(bytes).subspan(kHeaderBytes);
  guiding::ByteWriter header;
  header.put(std::uint64_t(payload.size()));
  header.put(guiding::checksum(payload));
  std::copy(header.bytes().begin(), header.bytes().end(), bytes.begin() + 12);
  return bytes;
}

void require(bool holds) {
  if (!holds) std::abort();
}

void use(guiding::Field& field) {
  require(field.validate().ok());
  guiding::SampleBuffer buffer;
  for (int i = 0; i < 64; ++i) {
    const Imath::V3f u(float(i % 4) / 4 + 0.1f, float(i / 4 % 4) / 4 + 0.1f, float(i / 16) / 4 + 0.1f);
    const Imath::V3f place = field.bounds().min + u * (field.bounds().max - field.bounds().min);
    const guiding::GuidingDistribution guide = field.bind(place);
    Imath::V3f wi(0, 0, 1);
    if (guide) {
      const guiding::DirectionSample s = guide.sample({u.x, u.y});
      require(s.pdf >= 0 && s.pdf == guide.pdf(s.wi));
      wi = s.wi;
    }
    buffer.add({place, wi, 1, 1, 1, 1, 0, 1});
  }
  require(field.accumulate(buffer).ok());
  if (field.stats().samples > 100'000) return;  // refining by what it claims to have seen takes its time
  require(field.endIteration(4).ok());
  require(field.validate().ok());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  guiding::Result<guiding::Field> field = guiding::load(folder.write("some.field", forged(std::span(data, size))));
  if (field.ok()) use(field.value());
  return 0;
}
