#include "film/exr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string_view>

namespace pt {

namespace {

/// Reads little-endian numbers and names that end with a zero.
class HeaderReader {
 public:
  explicit HeaderReader(std::istream& stream) : m_stream(stream) {}

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
  std::string bytes(std::uint32_t count) {
    std::string text(count, '\0');
    m_stream.read(text.data(), std::streamsize(count));
    return text;
  }
  void skip(std::uint32_t bytes) { m_stream.seekg(bytes, std::ios::cur); }
  std::uintmax_t position() { return std::uintmax_t(m_stream.tellg()); }
  explicit operator bool() const { return bool(m_stream); }

 private:
  std::istream& m_stream;
};

/// Values of these types take so many bytes, whatever the header says [OpenEXR file layout, predefined attribute
/// types].
constexpr struct {
  std::string_view type;
  std::uint32_t bytes;
} kFixedSizes[] = {{"box2f", 16},
                   {"box2i", 16},
                   {"chromaticities", 32},
                   {"compression", 1},
                   {"deepImageState", 1},
                   {"double", 8},
                   {"envmap", 1},
                   {"float", 4},
                   {"int", 4},
                   {"keycode", 28},
                   {"lineOrder", 1},
                   {"m33d", 72},
                   {"m33f", 36},
                   {"m44d", 128},
                   {"m44f", 64},
                   {"rational", 8},
                   {"tiledesc", 9},
                   {"timecode", 8},
                   {"v2d", 16},
                   {"v2f", 8},
                   {"v2i", 8},
                   {"v3d", 24},
                   {"v3f", 12},
                   {"v3i", 12}};

/// Channels, each a name and 16 bytes, and then an empty name.
bool isChannelList(std::string_view value) {
  constexpr std::size_t kAfterName = 16;
  while (!value.empty() && value[0] != 0) {
    const std::size_t end = value.find('\0');
    if (end == value.npos || value.size() - end - 1 < kAfterName) return false;
    value.remove_prefix(end + 1 + kAfterName);
  }
  return value.size() == 1;
}

/// Width, height and four bytes a pixel. Takes the first eight bytes.
bool isPreview(HeaderReader& reader, std::uint32_t bytes) {
  const std::uint64_t width = reader.number(), height = reader.number();
  return bytes >= 8 && width * height == (bytes - 8) / 4 && bytes % 4 == 0 && std::max(width, height) <= bytes;
}

/// Goes on behind a value that is as long as its type says; false for any other.
bool passValue(HeaderReader& reader, std::string_view type, std::uint32_t bytes) {
  if (type == "chlist") return isChannelList(reader.bytes(bytes));
  if (type == "preview") {
    if (!isPreview(reader, bytes)) return false;
    reader.skip(bytes - 8);
    return true;
  }
  const auto fixed = std::find_if(std::begin(kFixedSizes), std::end(kFixedSizes),
                                  [type](const auto& known) { return known.type == type; });
  if (fixed != std::end(kFixedSizes) && bytes != fixed->bytes) return false;
  reader.skip(bytes);
  return true;
}

}  // namespace

std::optional<std::string> faultOfExrHeader(std::istream& file) {
  constexpr std::uint32_t kMagic = 0x01312f76, kSeveralParts = 0x1000;
  file.clear();
  file.seekg(0, std::ios::end);
  const auto size = std::uintmax_t(file.tellg());
  file.seekg(0);
  HeaderReader reader(file);
  if (reader.number() != kMagic) return std::nullopt;
  const bool hasParts = (reader.number() & kSeveralParts) != 0;
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
    const std::string type = reader.name();
    const std::uint32_t bytes = reader.number();
    if (!reader || bytes > size - std::min(size, reader.position()))
      return fmt::format("its attribute '{}' is cut short: {} bytes are announced", name, bytes);
    if (!passValue(reader, type, bytes))
      return fmt::format("its attribute '{}' of type '{}' cannot take {} bytes", name, type, bytes);
  }
  return "its header is cut short";
}

}  // namespace pt
