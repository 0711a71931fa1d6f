#pragma once

#include <istream>
#include <optional>
#include <string>

namespace pt {

/// What is wrong with the attributes in the header of an OpenEXR file, or nothing; other files have none. OpenEXR takes
/// memory for an attribute before it looks whether the file is that long, and reads on wherever a value ends, whatever
/// its size in the header.
std::optional<std::string> faultOfExrHeader(std::istream& file);

}  // namespace pt
