#include "film/png_header.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <string_view>

namespace pt {
namespace {

std::uint32_t bigEndian(const char* bytes) {
  std::uint32_t number = 0;
  for (int i = 0; i < 4; ++i) number = number << 8 | std::uint8_t(bytes[i]);
  return number;
}

/// Of the pixels that the content of an IHDR chunk announces, but for rounding.
double pixelBytes(const char* header) {
  constexpr double kChannels[] = {1, 0, 3, 1, 2, 0, 4};
  const std::uint8_t depth = std::uint8_t(header[8]), colorType = std::uint8_t(header[9]);
  const double bits = depth * (colorType < std::size(kChannels) ? kChannels[colorType] : 0);
  return double(bigEndian(header)) * bigEndian(header + 4) * bits / 8;
}

}  // namespace

std::optional<std::string> faultOfPngChunks(std::istream& file) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  constexpr std::uintmax_t kChecksumSize = 4;
  constexpr double kMostPacking = 1032;  // of zlib [RFC 1951: 258 bytes by two bits]
  file.clear();
  file.seekg(0, std::ios::end);
  const auto size = std::uintmax_t(file.tellg());
  file.seekg(0);
  char head[8] = {};
  if (!file.read(head, 8) || std::string_view(head, 8) != kSignature) return std::nullopt;

  double announced = 0, packed = 0;
  while (file.read(head, 8)) {  // length, type
    std::uint32_t length = bigEndian(head);
    const std::string_view type(head + 4, 4);
    const std::uintmax_t left = size - std::uintmax_t(file.tellg());
    if (length > left) {
      const bool isName = type.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz") == type.npos;
      return fmt::format("its chunk{} is cut short: {} bytes are announced and {} are there",
                         isName ? fmt::format(" '{}'", type) : "", length, left);
    }
    if (type == "IEND") break;
    if (type == "IDAT") packed += length;
    if (char header[13]; type == "IHDR" && length >= sizeof header && file.read(header, sizeof header)) {
      announced = pixelBytes(header);
      length -= sizeof header;
    }
    file.seekg(std::streamoff(length + kChecksumSize), std::ios::cur);
  }
  if (announced > kMostPacking * packed)
    return fmt::format("it announces {} bytes of pixels, more than fit into the {} that are there", announced, packed);
  return std::nullopt;
}

}  // namespace pt
