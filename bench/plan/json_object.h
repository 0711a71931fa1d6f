#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

namespace bench {

/// A place in a JSON file, for messages.
struct JsonPlace {
  std::string file;
  std::string pointer;

  /// Throws pt::InputError "file#pointer: message".
  [[noreturn]] void fail(const std::string& message) const;
  JsonPlace operator/(const std::string& key) const { return {file, pointer + "/" + key}; }
  JsonPlace operator/(std::size_t index) const { return *this / std::to_string(index); }
};

/// Reads an object strictly: wrong types, numbers out of range, missing and unknown keys are errors that say where.
class JsonObject {
 public:
  using Json = nlohmann::ordered_json;

  JsonObject(const Json& json, JsonPlace place);

  const JsonPlace& place() const { return m_place; }
  JsonPlace placeOf(const std::string& key) const { return m_place / key; }

  /// Null if the key is absent. Counts as read.
  const Json* find(const std::string& key);
  const Json& require(const std::string& key);

  std::string string(const std::string& key) { return stringOf(require(key), placeOf(key)); }
  std::string string(const std::string& key, const std::string& otherwise);
  bool boolean(const std::string& key, bool otherwise);
  double number(const std::string& key, double least, double most, double otherwise);
  std::int64_t integer(const std::string& key, std::int64_t least, std::int64_t most, std::int64_t otherwise);

  /// An array, each element with its place; fewer than `least` elements are an error.
  struct Element {
    const Json& json;
    JsonPlace place;
  };
  std::vector<Element> array(const std::string& key, std::size_t least);

  /// To be called last: a key that nobody asked for is an error that names the nearest known one.
  void finish() const;

  static std::string stringOf(const Json& json, const JsonPlace& place);
  static std::int64_t integerOf(const Json& json, const JsonPlace& place, std::int64_t least, std::int64_t most);

 private:
  const Json& m_json;
  JsonPlace m_place;
  std::vector<std::string> m_known;
};

}  // namespace bench
