#include "loaders/refraction_index.h"

#include <algorithm>
#include <cctype>

namespace pt {
namespace {

struct Substance {
  const char* name;
  float index;
};

/// Values as Mitsuba has them, which takes most from Hecht, Optics.
constexpr Substance kSubstances[] = {
    {"vacuum", 1.0f},
    {"helium", 1.000036f},
    {"hydrogen", 1.000132f},
    {"air", 1.000277f},
    {"carbon dioxide", 1.00045f},
    {"water ice", 1.31f},
    {"water", 1.3330f},
    {"acetone", 1.36f},
    {"ethanol", 1.361f},
    {"fused quartz", 1.458f},
    {"carbon tetrachloride", 1.461f},
    {"pyrex", 1.470f},
    {"glycerol", 1.4729f},
    {"acrylic glass", 1.49f},
    {"polypropylene", 1.49f},
    {"benzene", 1.501f},
    {"bk7", 1.5046f},
    {"silicone oil", 1.52045f},
    {"sodium chloride", 1.544f},
    {"amber", 1.55f},
    {"pet", 1.5750f},
    {"bromine", 1.661f},
    {"diamond", 2.419f},
};

}  // namespace

std::optional<float> findRefractionIndex(std::string_view name) {
  const auto sameLetter = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  for (const Substance& substance : kSubstances) {
    const std::string_view known = substance.name;
    if (std::equal(name.begin(), name.end(), known.begin(), known.end(), sameLetter)) return substance.index;
  }
  return std::nullopt;
}

std::vector<std::string> refractionIndexNames() {
  std::vector<std::string> names;
  for (const Substance& substance : kSubstances) names.emplace_back(substance.name);
  return names;
}

}  // namespace pt
