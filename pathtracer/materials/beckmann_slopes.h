#pragma once

#include "core/types.h"

namespace pt {

/// Inverse of the error function, x in (-1, 1) [Giles 2012, single precision].
float erfInverse(float x) noexcept;

/// Slopes of a facet that is visible from w (unit, w.z > 0) on a Beckmann surface of roughness 1 [Heitz & d'Eon 2014].
/// The slope along w is found by inverting its distribution by Newton's method, which keeps neighbouring u together
/// [Jakob 2014].
Vec2 sampleVisibleBeckmannSlopes(const Vec3& w, const Vec2& u) noexcept;

}  // namespace pt
