#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pt {

/// Index of refraction of a transparent substance by name ("bk7", "water", ...), at about 589 nm. Letter case is free.
std::optional<float> findRefractionIndex(std::string_view name);

/// The names that findRefractionIndex knows.
std::vector<std::string> refractionIndexNames();

}  // namespace pt
