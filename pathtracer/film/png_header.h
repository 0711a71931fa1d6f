#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace pt {

/// What is wrong with the lengths of the chunks of a PNG file, or nothing; other files have none. libpng takes memory
/// for a chunk before it looks whether the file is that long.
std::optional<std::string> faultOfPngChunks(const std::filesystem::path& file);

}  // namespace pt
