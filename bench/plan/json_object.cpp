#include "plan/json_object.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/near_name.h"

namespace bench {

void JsonPlace::fail(const std::string& message) const {
  throw pt::InputError(fmt::format("{}#{}: {}", file, pointer, message));
}

JsonObject::JsonObject(const Json& json, JsonPlace place) : m_json(json), m_place(std::move(place)) {
  if (!json.is_object()) m_place.fail(fmt::format("expected an object, found {}", json.type_name()));
}

const JsonObject::Json* JsonObject::find(const std::string& key) {
  m_known.push_back(key);
  const auto found = m_json.find(key);
  return found == m_json.end() ? nullptr : &*found;
}

const JsonObject::Json& JsonObject::require(const std::string& key) {
  const Json* found = find(key);
  if (!found) m_place.fail(fmt::format("the key '{}' is missing", key));
  return *found;
}

std::string JsonObject::string(const std::string& key, const std::string& otherwise) {
  const Json* found = find(key);
  return found ? stringOf(*found, placeOf(key)) : otherwise;
}

bool JsonObject::boolean(const std::string& key, bool otherwise) {
  const Json* found = find(key);
  if (!found) return otherwise;
  if (!found->is_boolean()) placeOf(key).fail(fmt::format("expected true or false, found {}", found->dump()));
  return found->get<bool>();
}

double JsonObject::number(const std::string& key, double least, double most, double otherwise) {
  const Json* found = find(key);
  if (!found) return otherwise;
  if (!found->is_number()) placeOf(key).fail(fmt::format("expected a number, found {}", found->dump()));
  const double value = found->get<double>();
  if (!(value >= least && value <= most))
    placeOf(key).fail(fmt::format("{} lies outside [{}, {}]", value, least, most));
  return value;
}

std::int64_t JsonObject::integer(const std::string& key, std::int64_t least, std::int64_t most,
                                 std::int64_t otherwise) {
  const Json* found = find(key);
  return found ? integerOf(*found, placeOf(key), least, most) : otherwise;
}

std::vector<JsonObject::Element> JsonObject::array(const std::string& key, std::size_t least) {
  const Json& json = require(key);
  const JsonPlace place = placeOf(key);
  if (!json.is_array()) place.fail(fmt::format("expected an array, found {}", json.type_name()));
  if (json.size() < least) place.fail(fmt::format("expected at least {} element(s), found {}", least, json.size()));
  std::vector<Element> elements;
  for (std::size_t i = 0; i < json.size(); ++i) elements.push_back({json[i], place / i});
  return elements;
}

void JsonObject::finish() const {
  for (const auto& [key, value] : m_json.items())
    if (std::find(m_known.begin(), m_known.end(), key) == m_known.end())
      placeOf(key).fail(fmt::format("unknown key '{}'{}", key, pt::suggestName(key, m_known)));
}

std::string JsonObject::stringOf(const Json& json, const JsonPlace& place) {
  if (!json.is_string()) place.fail(fmt::format("expected a string, found {}", json.dump()));
  return json.get<std::string>();
}

std::int64_t JsonObject::integerOf(const Json& json, const JsonPlace& place, std::int64_t least, std::int64_t most) {
  if (!json.is_number_integer()) place.fail(fmt::format("expected a whole number, found {}", json.dump()));
  const bool tooLarge = json.is_number_unsigned() && json.get<std::uint64_t>() > std::uint64_t(most);
  if (tooLarge || json.get<std::int64_t>() < least || json.get<std::int64_t>() > most)
    place.fail(fmt::format("{} lies outside [{}, {}]", json.dump(), least, most));
  return json.get<std::int64_t>();
}

}  // namespace bench
