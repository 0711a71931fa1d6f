#include "micro/queries.h"

#include "synthetic/random.h"

namespace bench {

namespace {

constexpr std::size_t kQueries = 1 << 14;

template <class Place>
Queries makeQueries(Place&& nextPlace) {
  Random random(3);
  Queries queries(kQueries);
  for (Query& q : queries)
    q = {nextPlace(random), random.nextDirection(), random.nextDirection(), random.next2D(), random.next1D()};
  return queries;
}

}  // namespace

Queries queriesInBox(const Imath::Box3f& box) {
  return makeQueries([&](Random& random) { return box.min + random.next3D() * box.size(); });
}

Queries queriesAt(const std::vector<Imath::V3f>& places) {
  return makeQueries([&](Random& random) {
    return places[std::min(std::size_t(random.next1D() * double(places.size())), places.size() - 1)];
  });
}

}  // namespace bench
