#pragma once

#include <istream>
#include <optional>
#include <string>

namespace pt {

/// What is wrong with the lengths of the chunks of a PNG file, or nothing; other files have none. libpng takes memory
/// for a chunk before it looks whether the file is that long, and OpenImageIO for the pixels of an interlaced picture.
std::optional<std::string> faultOfPngChunks(std::istream& file);

}  // namespace pt
