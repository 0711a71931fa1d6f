#include <fmt/format.h>

#include "loaders/json_node.h"
#include "loaders/painted_environment.h"

namespace pt {
namespace {

using namespace json;

constexpr int kMaxSide = 4096;

double radians(const Node& node) {
  const double degrees = node.number();
  if (!(degrees > 0 && degrees < 180)) node.fail("must lie between 0 and 180 degrees");
  return degrees * (double(kPi) / 180);
}

PaintedLamp readPaintedLamp(const Node& node) {
  ObjectReader reader(node);
  PaintedLamp lamp;
  const Node direction = reader.require("direction");
  lamp.direction = Vec3(direction.vector().normalized());
  if (lamp.direction == Vec3(0, 0, 0)) direction.fail("must not be [0, 0, 0]");
  const Node degrees = reader.require("degrees");
  if (degrees.isArray()) {
    const auto sides = degrees.elements();
    if (sides.size() != 2) degrees.fail("must be a disk's angle, or the width and the height of a rectangle");
    lamp.width = radians(sides[0]);
    lamp.height = radians(sides[1]);
  } else {
    lamp.width = radians(degrees);
  }
  lamp.radiance = reader.require("radiance").color();
  reader.finish();
  return lamp;
}

}  // namespace

PaintedEnvironment loadPaintedEnvironment(const std::filesystem::path& file) {
  const nlohmann::json document = parseFile(file);
  ObjectReader reader(Node(document, file.string() + "#"));
  PaintedEnvironment painted;
  painted.width = reader.integer("width", painted.width, 4);
  painted.height = reader.integer("height", painted.width / 2, 2);
  if (painted.width > kMaxSide || painted.height > kMaxSide)
    reader.node().fail(fmt::format("width and height must be at most {}", kMaxSide));
  painted.zenith = reader.color("zenith", painted.zenith);
  painted.horizon = reader.color("horizon", painted.zenith);
  painted.ground = reader.color("ground", painted.ground);
  if (const auto lamps = reader.find("lamps"))
    for (const Node& lamp : lamps->elements()) painted.lamps.push_back(readPaintedLamp(lamp));
  reader.finish();
  return painted;
}

}  // namespace pt
