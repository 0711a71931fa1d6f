#include "film/exr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>

namespace pt {

namespace {

/// Reads little-endian numbers and names that end with a zero.
class HeaderReader {
 public:
  explicit HeaderReader(const std::filesystem::path& file) : m_stream(file, std::ios::binary) {}

  std::uint32_t number() {
    unsigned char bytes[4] = {};
    m_stream.read(reinterpret_cast<char*>(bytes), 4);
    return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | std::uint32_t(bytes[3]) << 24;
  }
  std::string name() {
    constexpr std::size_t kLongest = 256;
    std::string text;
    for (int c = m_stream.get(); c > 0 && text.size() < kLongest; c = m_stream.get()) text += char(c);
    return text;
  }
  void skip(std::uint32_t bytes) { m_stream.seekg(bytes, std::ios::cur); }
  std::uintmax_t position() { return std::uintmax_t(m_stream.tellg()); }
  explicit operator bool() const { return bool(m_stream); }

 private:
  std::ifstream m_stream;
};

}  // namespace

std::optional<std::string> faultOfExrHeader(const std::filesystem::path& file) {
  constexpr std::uint32_t kMagic = 0x01312f76, kSeveralParts = 0x1000;
  HeaderReader reader(file);
  if (reader.number() != kMagic) return std::nullopt;
  const bool hasParts = (reader.number() & kSeveralParts) != 0;
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(file, ignored);
  // A header ends with an empty name, and so do the headers of a file of several parts.
  for (bool atStart = true; reader;) {
    const std::string name = reader.name();
    if (!reader) break;
    if (name.empty()) {
      if (!hasParts || atStart) return std::nullopt;
      atStart = true;
      continue;
    }
    atStart = false;
    reader.name();  // of its type
    const std::uint32_t bytes = reader.number();
    if (!reader || bytes > size - std::min(size, reader.position()))
      return fmt::format("its attribute '{}' is cut short: {} bytes are announced", name, bytes);
    reader.skip(bytes);
  }
  return "its header is cut short";
}

}  // namespace pt
