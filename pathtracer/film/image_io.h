#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "film/film.h"

namespace pt {

/// A named value kept with a picture.
struct ImageAttribute {
  std::string name;
  std::variant<std::string, int, float> value;
};

/// More channels beside R, G and B: one for each letter of `channels` (at most 3), named "name.letter", from red, green
/// and blue of the picture in turn. Denoisers know "albedo" (RGB), "normal" (XYZ) and "depth" (Z).
struct ImageLayer {
  std::string name;
  std::string channels;
  const Image* image = nullptr;
};

struct ExrOptions {
  bool half = false;  ///< 16-bit floats for every channel
  std::vector<ImageAttribute> attributes;
  std::vector<ImageLayer> layers;
};

/// Reads the colours of an EXR, HDR, PNG, ... file as linear RGB: channels R, G and B, else the first one as grey.
/// Integer formats are taken for sRGB. Throws InputError.
Image readImage(const std::filesystem::path& file);

/// Both write by replaceFile(): a failure, told by WorkError, leaves an old file as it was.
void writeExr(const std::filesystem::path& file, const Image& image, const ExrOptions& options = {});

/// 8-bit sRGB preview of image * 2^exposure, clamped to [0, 1]; black where it is not a number.
void writePng(const std::filesystem::path& file, const Image& image, float exposure = 0);

}  // namespace pt
