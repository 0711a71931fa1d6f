#include "film/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "core/error.h"
#include "core/replace_file.h"
#include "core/srgb.h"
#include "film/picture_checks.h"
#include "scene/scene_description.h"

namespace pt {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failToRead(const fs::path& file, std::string reason) {
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  throw InputError(fmt::format("{}: cannot be read as a picture: {}", file.string(), reason));
}

[[noreturn]] void failToWrite(const fs::path& file, std::string reason) {
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  throw WorkError(fmt::format("{}: cannot be written: {}", file.string(), reason));
}

/// Where R, G and B are among the file's channels.
std::array<int, 3> colourChannels(const OIIO::ImageSpec& spec) {
  const auto find = [&](const char* name) { return spec.channelindex(name); };
  const std::array<int, 3> rgb{find("R"), find("G"), find("B")};
  if (rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0) return rgb;
  return {0, 0, 0};
}

Image readColours(const fs::path& file, OIIO::ImageInput& input) {
  const OIIO::ImageSpec& spec = input.spec();
  if (const auto fault = faultOfPictureSize(spec, kMaxFilmPixels)) failToRead(file, *fault);
  std::error_code ignored;
  if (announcesMuch(spec, fs::file_size(file, ignored)) && !hasLastPixel(input)) failToRead(file, input.geterror());
  const auto rgb = colourChannels(spec);
  const auto [first, last] = std::minmax({rgb[0], rgb[1], rgb[2]});
  const auto stride = std::size_t(last - first + 1);
  Image image(spec.width, spec.height);
  std::vector<float> values(image.pixels.size() * stride);
  if (!input.read_image(0, 0, first, last + 1, OIIO::TypeDesc::FLOAT, values.data()))
    failToRead(file, input.geterror());

  const bool isSrgb = !spec.format.is_floating_point();
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const float value = values[i * stride + std::size_t(rgb[std::size_t(c)] - first)];
      image.pixels[i][c] = isSrgb ? srgbToLinear(value) : value;
    }
  return image;
}

/// Encodes in memory first: the libraries' own files do not tell when a disk is full.
void writeWith(const fs::path& file, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* data) {
  OIIO::Filesystem::IOVecOutput memory;
  const auto output = OIIO::ImageOutput::create(file.string(), &memory);
  if (!output) failToWrite(file, OIIO::geterror());
  if (!output->open(file.string(), spec) || !output->write_image(type, data) || !output->close())
    failToWrite(file, output->geterror());
  const std::vector<unsigned char>& bytes = memory.buffer();
  replaceFile(file, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

/// A picture's channels side by side, as the file has them.
struct Channels {
  std::vector<std::string> names;
  std::vector<const float*> first;  ///< of the first pixel; those of the next are 3 floats further

  void add(const std::string& prefix, const std::string& letters, const Image& image) {
    for (std::size_t c = 0; c < letters.size(); ++c) {
      names.push_back(prefix + letters[c]);
      first.push_back(&image.pixels[0].x + c);
    }
  }
  std::vector<float> interleaved(std::size_t pixels) const {
    std::vector<float> values(pixels * first.size());
    for (std::size_t i = 0; i < pixels; ++i)
      for (std::size_t c = 0; c < first.size(); ++c) values[i * first.size() + c] = first[c][3 * i];
    return values;
  }
};

}  // namespace

Image readImage(const fs::path& file) {
  if (const auto fault = faultOfPictureFile(file)) failToRead(file, *fault);
  const auto input = OIIO::ImageInput::open(file.string());
  if (!input) failToRead(file, OIIO::geterror());
  return readColours(file, *input);
}

void writeExr(const fs::path& file, const Image& image, const ExrOptions& options) {
  Channels channels;
  channels.add("", "RGB", image);
  for (const ImageLayer& layer : options.layers) channels.add(layer.name + ".", layer.channels, *layer.image);

  OIIO::ImageSpec spec(image.width, image.height, int(channels.names.size()),
                       options.half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  spec.channelnames = channels.names;
  spec.attribute("compression", "zip");
  for (const ImageAttribute& attribute : options.attributes)
    std::visit([&](const auto& value) { spec.attribute(attribute.name, value); }, attribute.value);
  writeWith(file, spec, OIIO::TypeDesc::FLOAT, channels.interleaved(image.pixels.size()).data());
}

void writePng(const fs::path& file, const Image& image, float exposure) {
  const float scale = std::exp2(exposure);
  const auto encode = [&](float x) {
    const float value = x * scale;
    return std::uint8_t(value > 0 ? linearToSrgb(std::min(value, 1.0f)) * 255 + 0.5f : 0);  // false for NaN
  };
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() * 3);
  for (const Spectrum& c : image.pixels)
    for (float x : {c.x, c.y, c.z}) bytes.push_back(encode(x));
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  writeWith(file, spec, OIIO::TypeDesc::UINT8, bytes.data());
}

}  // namespace pt
