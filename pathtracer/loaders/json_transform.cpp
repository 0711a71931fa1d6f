#include <fmt/format.h>

#include <algorithm>

#include "core/near_name.h"
#include "loaders/json_node.h"

namespace pt::json {
namespace {

Transform readScale(const Node& node) {
  const Vec3d factors = node.isNumber() ? Vec3d(node.number()) : node.vector();
  if (factors.x == 0 || factors.y == 0 || factors.z == 0) node.fail("must not flatten space: a factor is 0");
  return scaling(factors);
}

Transform readRotate(const Node& node) {
  ObjectReader reader(node);
  const Node axis = reader.require("axis");
  const auto turned = rotation(axis.vector(), reader.require("degrees").number());
  reader.finish();
  if (!turned) axis.fail("must not be [0, 0, 0]");
  return *turned;
}

Transform readLookAt(const Node& node) {
  ObjectReader reader(node);
  const auto up = reader.find("up");
  const auto view =
      lookAt(reader.require("origin").vector(), reader.require("target").vector(), up ? up->vector() : Vec3d(0, 1, 0));
  reader.finish();
  if (!view) node.fail("origin and target coincide, or 'up' points along the view");
  return *view;
}

Transform readMatrix(const Node& node) {
  const auto numbers = node.numbers();
  if (numbers.size() != 16) node.fail(fmt::format("must be 16 numbers, not {}", numbers.size()));
  double rows[16];
  std::copy(numbers.begin(), numbers.end(), rows);
  return fromColumnVectorMatrix(rows);
}

Transform readStep(const Node& node) {
  const std::vector<std::string> known = {"lookAt", "matrix", "rotate", "scale", "translate"};
  const auto members = node.members();
  if (members.size() != 1)
    node.fail(fmt::format("a step has one key of {}; a list of steps is an array", fmt::join(known, ", ")));
  const auto& [key, value] = members.front();
  if (key == "translate") return translation(value.vector());
  if (key == "scale") return readScale(value);
  if (key == "rotate") return readRotate(value);
  if (key == "lookAt") return readLookAt(value);
  if (key == "matrix") return readMatrix(value);
  value.fail(fmt::format("unknown step '{}'{}", key, suggestName(key, known)));
}

}  // namespace

Matrix4 readTransform(const std::optional<Node>& node) {
  if (!node) return {};
  if (!node->isArray()) return toFloat(readStep(*node));
  Transform total;
  for (const Node& step : node->elements()) total = total * readStep(step);
  return toFloat(total);
}

}  // namespace pt::json
