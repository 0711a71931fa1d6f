#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pt {

/// The known name with the least edit distance to `name`, if that is small enough for a slip of the pen.
std::optional<std::string> nearestName(std::string_view name, const std::vector<std::string>& known);

/// The end of an error message about an unknown name: "; did you mean 'fov'?", or the list of known names when none is
/// near.
std::string suggestName(std::string_view name, const std::vector<std::string>& known);

}  // namespace pt
