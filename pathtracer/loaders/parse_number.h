#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pt {

/// The whole text as a finite number; none for anything else ("nan", "1e999", "1.5m", ""). Blanks around it are
/// allowed.
std::optional<double> parseNumber(std::string_view text);

/// The whole text as a decimal integer.
std::optional<std::int64_t> parseInteger(std::string_view text);

/// Pieces between commas and blanks.
std::vector<std::string_view> splitList(std::string_view text);

}  // namespace pt
