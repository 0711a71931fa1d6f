#pragma once

#include <ImathBox.h>
#include <ImathVec.h>

#include <vector>

namespace bench {

/// A shading point and random numbers for one look-up.
struct Query {
  Imath::V3f position, direction, normal;
  Imath::V2f u;
  float uChoice = 0;
};
using Queries = std::vector<Query>;

/// Enough to touch every leaf, in random order, at places spread evenly over the box.
Queries queriesInBox(const Imath::Box3f& box);

/// The same at places drawn from these.
Queries queriesAt(const std::vector<Imath::V3f>& places);

}  // namespace bench
