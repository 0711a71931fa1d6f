#include "film/picture_checks.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "film/exr_header.h"
#include "film/png_header.h"
#include "scene/scene_description.h"

namespace pt {
namespace {

std::optional<std::string> faultOfHeader(std::istream& file) {
  if (auto fault = faultOfExrHeader(file)) return fault;
  return faultOfPngChunks(file);
}

}  // namespace

std::optional<std::string> faultOfPictureFile(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return "there is no such file";
  if (!std::filesystem::is_regular_file(file, ignored)) return "it is no file but a folder, a device or a pipe";
  std::ifstream stream(file, std::ios::binary);
  return faultOfHeader(stream);
}

std::optional<std::string> faultOfPictureBytes(const std::string& bytes) {
  std::istringstream stream(bytes);
  return faultOfHeader(stream);
}

std::optional<std::string> faultOfPictureSize(const OIIO::ImageSpec& spec, std::int64_t mostPixels) {
  const bool sane = spec.width >= 1 && spec.width <= kMaxFilmSize && spec.height >= 1 && spec.height <= kMaxFilmSize &&
                    std::int64_t(spec.width) * spec.height <= mostPixels && spec.depth <= 1 && spec.nchannels >= 1;
  if (sane) return std::nullopt;
  return fmt::format("{}x{}x{} pixels of {} channels are no picture of at most {} pixels", spec.width, spec.height,
                     spec.depth, spec.nchannels, mostPixels);
}

bool announcesMuch(const OIIO::ImageSpec& spec, std::uintmax_t fileBytes) {
  constexpr std::uintmax_t kSmall = 1 << 24;  // bytes of pixels
  constexpr std::uintmax_t kPacking = 200;    // few pictures are packed so well; they take the longer way
  const std::uintmax_t pixelBytes = spec.image_bytes(true);
  return pixelBytes > kSmall && pixelBytes / kPacking > fileBytes;
}

bool hasLastPixel(OIIO::ImageInput& input) {
  const OIIO::ImageSpec& spec = input.spec();
  if (spec.tile_width == 0) {
    std::vector<float> row(std::size_t(spec.width) * std::size_t(spec.nchannels));
    return input.read_scanline(spec.y + spec.height - 1, spec.z, OIIO::TypeDesc::FLOAT, row.data());
  }
  std::vector<float> tile(std::size_t(spec.tile_pixels()) * std::size_t(spec.nchannels));
  const auto firstOfLast = [](int begin, int size, int step) { return begin + (size - 1) / step * step; };
  return input.read_tile(firstOfLast(spec.x, spec.width, spec.tile_width),
                         firstOfLast(spec.y, spec.height, spec.tile_height), spec.z, OIIO::TypeDesc::FLOAT,
                         tile.data());
}

}  // namespace pt
