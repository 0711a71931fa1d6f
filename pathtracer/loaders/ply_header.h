#pragma once

#include <filesystem>

namespace pt {

/// Throws InputError for a PLY file whose header has no end or announces more than the file can hold: the reader behind
/// it would loop or allocate without end.
void checkPlyHeader(const std::filesystem::path& file);

}  // namespace pt
