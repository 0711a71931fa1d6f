#include "film/png_header.h"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <string_view>

namespace pt {

std::optional<std::string> faultOfPngChunks(const std::filesystem::path& file) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  constexpr std::uintmax_t kChecksumSize = 4;
  std::ifstream stream(file, std::ios::binary);
  char head[8] = {};
  if (!stream.read(head, 8) || std::string_view(head, 8) != kSignature) return std::nullopt;

  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(file, ignored);
  while (stream.read(head, 8)) {  // big-endian length, type
    std::uint32_t length = 0;
    for (int i = 0; i < 4; ++i) length = length << 8 | std::uint8_t(head[i]);
    const std::string_view type(head + 4, 4);
    const std::uintmax_t left = size - std::uintmax_t(stream.tellg());
    if (length > left) {
      const bool isName = type.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz") == type.npos;
      return fmt::format("its chunk{} is cut short: {} bytes are announced and {} are there",
                         isName ? fmt::format(" '{}'", type) : "", length, left);
    }
    if (type == "IEND") break;
    stream.seekg(std::streamoff(length + kChecksumSize), std::ios::cur);
  }
  return std::nullopt;
}

}  // namespace pt
