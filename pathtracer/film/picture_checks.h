#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <optional>
#include <string>

/// What the libraries that read pictures do not look at before they take memory. Faults are told by their reason.
namespace pt {

/// With a file, by what it is and by its header.
std::optional<std::string> faultOfPictureFile(const std::filesystem::path& file);
/// With the header of a file whose bytes these are.
std::optional<std::string> faultOfPictureBytes(const std::string& bytes);

/// With the size that a picture announces.
std::optional<std::string> faultOfPictureSize(const OIIO::ImageSpec& spec, std::int64_t mostPixels);

/// Whether a picture announces so much more than a file of this size is likely to have that it should be asked for its
/// last pixel first.
bool announcesMuch(const OIIO::ImageSpec& spec, std::uintmax_t fileBytes);
/// Whether the end of the pixels can be read; if not, input.geterror() tells why.
bool hasLastPixel(OIIO::ImageInput& input);

}  // namespace pt
