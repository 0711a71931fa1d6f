#pragma once

namespace pt {

/// Most materials that one may consist of, itself included; one that is inside at several places counts as often.
inline constexpr int kMostMaterialParts = 256;

}  // namespace pt
