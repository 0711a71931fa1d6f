#pragma once

#include <filesystem>

#include "guiding/field.h"
#include "guiding/result.h"

namespace guiding {

/// Writes the field (versioned, little-endian, checksummed) to a temporary name and renames it, so that an old file is
/// never lost.
Status save(const Field& field, const std::filesystem::path& path) noexcept;

/// Reads a field that save() wrote. Foreign, truncated, corrupted or newer files give ErrorCode::Format; sizes are
/// checked against the file's length before anything is allocated. What was forged with care may still ask for any
/// amount of memory once learning goes on: give maxMemoryBytes for files of strangers. It refuses larger files and
/// takes the place of a larger FieldSettings::maxMemoryBytes, or of none. 0: no limit but the file's.
Result<Field> load(const std::filesystem::path& path, std::size_t maxMemoryBytes = 0) noexcept;

}  // namespace guiding
