#include "loaders/json_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/near_name.h"
#include "loaders/color.h"
#include "loaders/loader_error.h"

namespace pt::json {
namespace {

/// A key as part of a JSON pointer [RFC 6901].
std::string escapePointer(const std::string& key) {
  std::string escaped;
  for (const char c : key) {
    if (c == '~') {
      escaped += "~0";
    } else if (c == '/') {
      escaped += "~1";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

}  // namespace

void Node::fail(const std::string& message) const {
  failAt(m_source, message);
}

Node Node::child(const std::string& key, const nlohmann::json& value) const {
  return {value, m_source + "/" + escapePointer(key)};
}

bool Node::boolean() const {
  if (!m_value->is_boolean()) fail(fmt::format("must be true or false, not {}", m_value->type_name()));
  return m_value->get<bool>();
}

int Node::integer(int least) const {
  if (!m_value->is_number_integer())
    fail(fmt::format("must be an integer, not {}", m_value->is_number() ? "a fraction" : m_value->type_name()));
  const bool isHuge = m_value->is_number_unsigned() &&
                      m_value->get<std::uint64_t>() > static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  if (isHuge || m_value->get<std::int64_t>() < least)
    fail(fmt::format("must lie between {} and {}", least, std::numeric_limits<int>::max()));
  return m_value->get<int>();
}

double Node::number() const {
  if (!m_value->is_number()) fail(fmt::format("must be a number, not {}", m_value->type_name()));
  const double value = m_value->get<double>();
  if (!(std::abs(value) <= std::numeric_limits<float>::max())) fail("is too large");
  return value;
}

float Node::positive() const {
  const auto value = static_cast<float>(number());
  if (!(value > 0)) fail("must be greater than 0");
  return value;
}

const std::string& Node::string() const {
  if (!m_value->is_string()) fail(fmt::format("must be a string, not {}", m_value->type_name()));
  return m_value->get_ref<const std::string&>();
}

std::vector<double> Node::numbers() const {
  std::vector<double> numbers;
  for (const Node& element : elements()) numbers.push_back(element.number());
  return numbers;
}

Vec3d Node::vector() const {
  if (!m_value->is_array() || m_value->size() != 3) fail("must be three numbers [x, y, z]");
  const auto v = numbers();
  return {v[0], v[1], v[2]};
}

Spectrum Node::color() const {
  if (m_value->is_number()) return Spectrum(static_cast<float>(number()));
  if (m_value->is_string()) {
    if (const auto hex = parseHexColor(string())) return srgbToLinear(*hex);
  } else if (m_value->is_array() && m_value->size() == 3) {
    return Spectrum(Vec3(vector()));
  }
  fail("must be a colour: a number, [r, g, b] or \"#rrggbb\"");
}

std::vector<Node> Node::elements() const {
  if (!m_value->is_array()) fail(fmt::format("must be an array, not {}", m_value->type_name()));
  std::vector<Node> elements;
  for (std::size_t i = 0; i < m_value->size(); ++i) elements.push_back(child(std::to_string(i), (*m_value)[i]));
  return elements;
}

std::vector<std::pair<std::string, Node>> Node::members() const {
  if (!m_value->is_object()) fail(fmt::format("must be an object, not {}", m_value->type_name()));
  std::vector<std::pair<std::string, Node>> members;
  for (const auto& [key, value] : m_value->items()) members.emplace_back(key, child(key, value));
  return members;
}

ObjectReader::ObjectReader(const Node& node) : m_node(node), m_members(node.members()) {}

std::optional<Node> ObjectReader::find(const std::string& key) {
  m_asked.insert(key);
  for (const auto& [name, value] : m_members)
    if (name == key) return value;
  return std::nullopt;
}

Node ObjectReader::require(const std::string& key) {
  if (auto value = find(key)) return *value;
  m_node.fail(fmt::format("lacks the key '{}'", key));
}

bool ObjectReader::boolean(const std::string& key, bool fallback) {
  const auto value = find(key);
  return value ? value->boolean() : fallback;
}

int ObjectReader::integer(const std::string& key, int fallback, int least) {
  const auto value = find(key);
  return value ? value->integer(least) : fallback;
}

float ObjectReader::number(const std::string& key, float fallback) {
  const auto value = find(key);
  return value ? static_cast<float>(value->number()) : fallback;
}

float ObjectReader::positive(const std::string& key, float fallback) {
  const auto value = find(key);
  return value ? value->positive() : fallback;
}

std::string ObjectReader::string(const std::string& key, const std::string& fallback) {
  const auto value = find(key);
  return value ? value->string() : fallback;
}

Vec3 ObjectReader::vector(const std::string& key, const Vec3& fallback) {
  const auto value = find(key);
  return value ? Vec3(value->vector()) : fallback;
}

Spectrum ObjectReader::color(const std::string& key, const Spectrum& fallback) {
  const auto value = find(key);
  return value ? value->color() : fallback;
}

int ObjectReader::choice(const std::string& key, const std::vector<std::string>& words, int fallback) {
  const auto value = find(key);
  if (!value) return fallback;
  const auto found = std::find(words.begin(), words.end(), value->string());
  if (found == words.end())
    value->fail(fmt::format("'{}' is not known here{}", value->string(), suggestName(value->string(), words)));
  return static_cast<int>(found - words.begin());
}

void ObjectReader::finish() const {
  for (const auto& [key, value] : m_members)
    if (!m_asked.contains(key))
      value.fail(fmt::format("unknown key '{}'{}", key, suggestName(key, {m_asked.begin(), m_asked.end()})));
}

}  // namespace pt::json
