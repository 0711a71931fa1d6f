#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "loaders/transforms.h"
#include "scene/scene_description.h"

namespace pt::json {

/// Parses a scene file: // comments are allowed, doubled keys and nesting deeper than 64 are not.
/// Throws InputError "file:line:column: ...".
nlohmann::json parseFile(const std::filesystem::path& file);
/// The same for text that was read from `file`.
nlohmann::json parseText(std::string_view text, const std::filesystem::path& file);

/// A value and where it stands. All conversions throw InputError "file#/pointer: ..." for a value of another kind.
class Node {
 public:
  Node(const nlohmann::json& value, SourceLocation source) : m_value(&value), m_source(std::move(source)) {}

  const SourceLocation& source() const { return m_source; }
  [[noreturn]] void fail(const std::string& message) const;

  bool isObject() const { return m_value->is_object(); }
  bool isArray() const { return m_value->is_array(); }
  bool isString() const { return m_value->is_string(); }
  bool isNumber() const { return m_value->is_number(); }

  bool boolean() const;
  int integer(int least) const;
  double number() const;
  float positive() const;
  const std::string& string() const;
  Vec3d vector() const;
  Spectrum color() const;
  std::vector<double> numbers() const;

  /// Elements of an array.
  std::vector<Node> elements() const;
  /// Members of an object, in order of their keys.
  std::vector<std::pair<std::string, Node>> members() const;

 private:
  Node child(const std::string& key, const nlohmann::json& value) const;

  const nlohmann::json* m_value;
  SourceLocation m_source;
};

/// Reads the members of an object and remembers which: finish() refuses keys that nobody asked for.
class ObjectReader {
 public:
  explicit ObjectReader(const Node& node);

  const Node& node() const { return m_node; }
  std::optional<Node> find(const std::string& key);
  /// Throws InputError if the key is missing.
  Node require(const std::string& key);

  bool boolean(const std::string& key, bool fallback);
  int integer(const std::string& key, int fallback, int least);
  float number(const std::string& key, float fallback);
  float positive(const std::string& key, float fallback);
  std::string string(const std::string& key, const std::string& fallback);
  Vec3 vector(const std::string& key, const Vec3& fallback);
  Spectrum color(const std::string& key, const Spectrum& fallback);
  /// One of the words, as its index.
  int choice(const std::string& key, const std::vector<std::string>& words, int fallback);

  void finish() const;

 private:
  Node m_node;
  std::vector<std::pair<std::string, Node>> m_members;
  std::set<std::string> m_asked;
};

/// Identity, one step, or a list of steps that are applied in order: {"translate": [x,y,z]}, {"scale": s or [x,y,z]},
/// {"rotate": {"axis", "degrees"}}, {"lookAt": {"origin", "target", "up"}}, {"matrix": 16 numbers, column vectors, row
/// by row}.
Matrix4 readTransform(const std::optional<Node>& node);

}  // namespace pt::json
