#include "loaders/mitsuba_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>

#include "core/near_name.h"
#include "loaders/mitsuba_parts.h"

namespace pt::mitsuba {
namespace {

const char* kindName(const Value& value) {
  constexpr const char* kNames[] = {"a boolean",         "an integer", "a number",   "a string",
                                    "a point or vector", "a colour",   "a transform"};
  static_assert(std::size(kNames) == std::variant_size_v<Value>);
  return kNames[value.index()];
}

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

}  // namespace

void Context::leaveOut(const SourceLocation& source, const std::string& what) {
  const UnsupportedError error(source, what);
  if (!options.skipUnsupported) throw error;
  scene.skipped.push_back(error.reason);
}

void Context::leaveOut(const UnsupportedError& error, const std::string& instead) {
  if (!options.skipUnsupported) throw error;
  scene.skipped.push_back(fmt::format("{}: {}", error.reason, instead));
}

std::string Reader::spelled(const std::string& name) const {
  return m_context.isOld() ? camelCaseName(name) : name;
}

void Reader::fail(const std::string& name, const std::string& message) const {
  const auto property = m_object.properties.find(name);
  const SourceLocation& source = property == m_object.properties.end() ? m_object.source : property->second.source;
  failAt(source, fmt::format("{} of {} {}", spelled(name), title(), message));
}

const Property* Reader::find(const std::string& name) {
  m_asked.insert(name);
  const auto found = m_object.properties.find(name);
  return found == m_object.properties.end() ? nullptr : &found->second;
}

bool Reader::has(const std::string& name) {
  return find(name) != nullptr;
}

template <class T>
const T* Reader::findAs(const std::string& name, const char* wanted) {
  const Property* property = find(name);
  if (!property) return nullptr;
  if (const T* value = std::get_if<T>(&property->value)) return value;
  fail(name, fmt::format("must be {}, not {}", wanted, kindName(property->value)));
}

bool Reader::boolean(const std::string& name, bool fallback) {
  const bool* value = findAs<bool>(name, "a boolean");
  return value ? *value : fallback;
}

int Reader::integer(const std::string& name, int fallback) {
  const std::int64_t* value = findAs<std::int64_t>(name, "an integer");
  if (!value) return fallback;
  if (*value < std::numeric_limits<int>::min() || *value > std::numeric_limits<int>::max())
    fail(name, "is out of range");
  return static_cast<int>(*value);
}

float Reader::number(const std::string& name, float fallback) {
  const Property* property = find(name);
  if (property && std::holds_alternative<std::int64_t>(property->value))
    return static_cast<float>(std::get<std::int64_t>(property->value));
  const double* value = findAs<double>(name, "a number");
  return value ? static_cast<float>(*value) : fallback;
}

std::string Reader::string(const std::string& name, const std::string& fallback) {
  const std::string* value = findAs<std::string>(name, "a string");
  return value ? *value : fallback;
}

Vec3 Reader::point(const std::string& name, const Vec3& fallback) {
  const Vec3d* value = findAs<Vec3d>(name, "a point or vector");
  return value ? Vec3(*value) : fallback;
}

Spectrum Reader::color(const std::string& name, const Spectrum& fallback) {
  const Property* property = find(name);
  if (property &&
      (std::holds_alternative<double>(property->value) || std::holds_alternative<std::int64_t>(property->value)))
    return Spectrum(number(name, 0));
  if (const Object* child = childNamed(name))
    m_context.leaveOut(child->source, fmt::format("{} '{}' is not supported as {} of {}", child->tag, child->type,
                                                  spelled(name), title()));
  const Spectrum* value = findAs<Spectrum>(name, "a colour");
  return value ? *value : fallback;
}

const Object* Reader::childNamed(const std::string& name) {
  m_asked.insert(name);
  for (const Child& child : m_object.children)
    if (!child.name.empty() && canonicalName(child.name) == name) return child.object;
  return nullptr;
}

SpectrumParameter Reader::spectrum(const std::string& name, const Spectrum& fallback) {
  const Object* texture = childNamed(name);
  if (!texture) return color(name, fallback);
  if (has(name)) fail(name, "is given twice: as a value and as a texture");
  try {
    return readTexture(m_context, *texture);
  } catch (const UnsupportedError& error) {
    m_context.textures.erase(texture);
    m_context.leaveOut(error, fmt::format("{} of {} stays at its default", spelled(name), title()));
    return fallback;
  }
}

FloatParameter Reader::numberOrTexture(const std::string& name, float fallback) {
  if (!childNamed(name)) {
    const Property* property = find(name);
    const bool isColor = property && std::holds_alternative<Spectrum>(property->value);
    return isColor ? luminance(std::get<Spectrum>(property->value)) : number(name, fallback);
  }
  const SpectrumParameter parameter = spectrum(name, Spectrum(fallback));
  return {luminance(parameter.value), parameter.texture};
}

Matrix4 Reader::transform(const std::string& name) {
  const Transform* value = findAs<Transform>(name, "a transform");
  return value ? toFloat(*value) : Matrix4();
}

int Reader::choice(const std::string& name, const std::vector<std::string>& words, int fallback) {
  const std::string* value = findAs<std::string>(name, "a string");
  if (!value) return fallback;
  const auto found = std::find(words.begin(), words.end(), lowerCase(*value));
  if (found == words.end()) {
    throw UnsupportedError(
        m_object.properties.at(name).source,
        fmt::format("{} '{}' of {} is not supported{}", spelled(name), *value, title(), suggestName(*value, words)));
  }
  return static_cast<int>(found - words.begin());
}

std::filesystem::path Reader::file(const std::string& name) {
  const std::string* value = findAs<std::string>(name, "a string");
  if (!value) failAt(m_object.source, fmt::format("{} lacks the property '{}'", title(), spelled(name)));
  const auto found = m_context.search.find(*value);
  if (!found) fail(name, fmt::format("names a file that does not exist: '{}'", *value));
  return *found;
}

void Reader::ignore(std::initializer_list<const char*> names) {
  m_asked.insert(names.begin(), names.end());
}

std::vector<const Object*> Reader::children(const std::string& tag) {
  m_askedTags.insert(tag);
  std::vector<const Object*> found;
  for (const Child& child : m_object.children)
    if (child.object->tag == tag) found.push_back(child.object);
  return found;
}

void Reader::finish() {
  std::vector<std::string> known;
  for (const std::string& name : m_asked) known.push_back(spelled(name));
  for (const auto& [name, property] : m_object.properties) {
    if (m_asked.contains(name)) continue;
    const std::string written = spelled(name);
    const std::string message = fmt::format("{} has no property '{}'{}", title(), written, suggestName(written, known));
    if (!m_context.options.skipUnsupported) failAt(property.source, message);
    m_context.scene.skipped.push_back(property.source + ": " + message);
  }
  for (const Child& child : m_object.children) {
    const bool isParameter = !child.name.empty() && m_asked.contains(canonicalName(child.name));
    if (isParameter || m_askedTags.contains(child.object->tag)) continue;
    m_context.leaveOut(child.object->source, fmt::format("{} '{}' inside of {} is not supported", child.object->tag,
                                                         child.object->type, title()));
  }
}

}  // namespace pt::mitsuba
