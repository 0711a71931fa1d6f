#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "loaders/mitsuba_xml.h"
#include "loaders/transforms.h"

namespace pt::mitsuba {

using Value = std::variant<bool, std::int64_t, double, std::string, Vec3d, Spectrum, Transform>;

struct Property {
  Value value;
  SourceLocation source;
};

struct Object;

/// An object inside another, perhaps under a name (a texture for a reflectance).
struct Child {
  std::string name;
  const Object* object = nullptr;
};

/// A plugin with its properties. Property names are in snake_case, whichever way the file wrote them.
struct Object {
  std::string tag;   ///< bsdf, shape, ...
  std::string type;  ///< diffuse, obj, ...
  std::string id;
  SourceLocation source;
  std::map<std::string, Property> properties;
  std::vector<Child> children;
};

/// All objects of a scene, nested ones too; the first is the scene itself. References are pointers among them.
using Objects = std::deque<Object>;

/// Turns elements into objects and resolves references, wherever in the file the thing they name stands.
/// Throws InputError for unknown tags and attributes, values that cannot be parsed, ids that are missing or not unique.
Objects readObjects(const Element& scene);

/// "intIOR" and "int_ior" are the same property: int_ior.
std::string canonicalName(const std::string& name);

/// The other way: int_ior is intIOR in files before version 2.
std::string camelCaseName(const std::string& name);

}  // namespace pt::mitsuba
