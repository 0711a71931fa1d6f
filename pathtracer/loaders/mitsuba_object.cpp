#include "loaders/mitsuba_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/near_name.h"
#include "loaders/loader_error.h"
#include "loaders/mitsuba_values.h"

namespace pt::mitsuba {
namespace {

const std::vector<std::string> kObjectTags = {"bsdf",  "emitter", "film",    "integrator", "medium",
                                              "phase", "rfilter", "sampler", "sensor",     "subsurface",
                                              "shape", "texture", "volume"};

bool isObjectTag(const std::string& tag) {
  return std::find(kObjectTags.begin(), kObjectTags.end(), tag) != kObjectTags.end();
}

std::string attributeOr(const Element& element, const std::string& name, const std::string& fallback) {
  const auto found = element.attributes.find(name);
  return found == element.attributes.end() ? fallback : found->second;
}

class ObjectReader {
 public:
  Objects read(const Element& scene) {
    m_objects.push_back({"scene", "scene", {}, scene.source, {}, {}});
    readContents(scene, m_objects.front());
    for (const Alias& alias : m_aliases) addId(alias.name, find(alias.target, alias.source), alias.source);
    for (const Reference& reference : m_references) *reference.object = find(reference.id, reference.source);
    return std::move(m_objects);
  }

 private:
  struct Reference {
    const Object** object;
    std::string id;
    SourceLocation source;
  };
  struct Alias {
    std::string name, target;
    SourceLocation source;
  };

  void readContents(const Element& element, Object& object) {
    object.children.reserve(element.children.size());  // references point into it
    for (const Element& child : element.children) {
      if (child.tag == "ref") {
        addReference(child, object);
      } else if (child.tag == "alias") {
        m_aliases.push_back({attributeOr(child, "as", ""), attributeOr(child, "id", ""), child.source});
      } else if (isObjectTag(child.tag) || (child.tag == "spectrum" && child.attributes.contains("type"))) {
        object.children.push_back({attributeOr(child, "name", ""), readObject(child)});
      } else if (isValueTag(child.tag)) {
        addProperty(child, object);
      } else {
        failUnknownTag(child);
      }
    }
  }

  const Object* readObject(const Element& element) {
    checkAttributes(element, {"type", "id", "name"});
    Object& object = m_objects.emplace_back();
    object.tag = element.tag;
    object.type = attributeOr(element, "type", "");
    object.id = attributeOr(element, "id", "");
    object.source = element.source;
    if (object.type.empty()) failAt(element.source, fmt::format("<{}> lacks the attribute 'type'", element.tag));
    readContents(element, object);
    if (!object.id.empty()) addId(object.id, &object, object.source);
    return &object;
  }

  static void addProperty(const Element& element, Object& object) {
    const std::string written = attributeOr(element, "name", "");
    if (written.empty()) failAt(element.source, fmt::format("<{}> lacks the attribute 'name'", element.tag));
    const auto [entry, isNew] =
        object.properties.emplace(canonicalName(written), Property{readValue(element), element.source});
    if (!isNew)
      failAt(element.source, fmt::format("property '{}' is given twice, first at {}", written, entry->second.source));
  }

  void addReference(const Element& element, Object& object) {
    checkAttributes(element, {"id", "name"});
    const std::string id = attributeOr(element, "id", "");
    if (id.empty()) failAt(element.source, "<ref> lacks the attribute 'id'");
    object.children.push_back({attributeOr(element, "name", ""), nullptr});
    m_references.push_back({&object.children.back().object, id, element.source});
  }

  void addId(const std::string& id, const Object* object, const SourceLocation& source) {
    const auto [entry, isNew] = m_ids.emplace(id, object);
    if (!isNew) failAt(source, fmt::format("the id '{}' is taken already, at {}", id, entry->second->source));
  }

  const Object* find(const std::string& id, const SourceLocation& source) const {
    const auto found = m_ids.find(id);
    if (found != m_ids.end()) return found->second;
    std::vector<std::string> known;
    for (const auto& [name, object] : m_ids) known.push_back(name);
    failAt(source, fmt::format("there is nothing with the id '{}'{}", id, suggestName(id, known)));
  }

  [[noreturn]] static void failUnknownTag(const Element& element) {
    std::vector<std::string> known = valueTags();
    known.insert(known.end(), kObjectTags.begin(), kObjectTags.end());
    known.insert(known.end(), {"ref", "alias", "default", "include", "path"});
    failAt(element.source, fmt::format("unknown element <{}>{}", element.tag, suggestName(element.tag, known)));
  }

  std::map<std::string, const Object*> m_ids;
  Objects m_objects;
  std::vector<Reference> m_references;
  std::vector<Alias> m_aliases;
};

}  // namespace

Objects readObjects(const Element& scene) {
  checkAttributes(scene, {"version", "id", "name", "type"});
  return ObjectReader().read(scene);
}

std::string canonicalName(const std::string& name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    if (std::isupper(c) && i > 0 && std::islower(static_cast<unsigned char>(name[i - 1]))) result += '_';
    result += static_cast<char>(std::tolower(c));
  }
  return result;
}

std::string camelCaseName(const std::string& name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '_' && name.compare(i, std::string::npos, "_ior") == 0) return result + "IOR";
    const bool isAfterBar = i > 0 && name[i - 1] == '_';
    if (name[i] != '_')
      result += isAfterBar ? static_cast<char>(std::toupper(static_cast<unsigned char>(name[i]))) : name[i];
  }
  return result;
}

}  // namespace pt::mitsuba
