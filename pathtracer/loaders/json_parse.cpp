#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "loaders/file_search.h"
#include "loaders/json_node.h"

namespace pt::json {
namespace {

using Json = nlohmann::json;

constexpr int kMaxNesting = 64;

[[noreturn]] void failInText(const std::filesystem::path& file, std::string_view text, std::size_t byte,
                             const std::string& message) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  const auto lineStart = std::find(std::make_reverse_iterator(end), text.rend(), '\n').base();
  throw InputError(fmt::format("{}:{}:{}: {}", file.string(), 1 + std::count(text.begin(), end, '\n'),
                               1 + (end - lineStart), message));
}

/// Watches the parser for what JSON allows and a scene does not.
class Guard {
 public:
  explicit Guard(const std::filesystem::path& file) : m_file(file) {}

  bool operator()(int depth, Json::parse_event_t event, const Json& parsed) {
    if (depth > kMaxNesting)
      throw InputError(fmt::format("{}: values are nested deeper than {}", m_file.string(), kMaxNesting));
    const auto level = static_cast<std::size_t>(depth);
    if (event == Json::parse_event_t::object_start) {
      m_keys.resize(std::max(m_keys.size(), level + 2));
      m_keys[level + 1].clear();
    } else if (event == Json::parse_event_t::key) {
      const std::string& key = parsed.get_ref<const std::string&>();
      if (!m_keys[level].insert(key).second)
        throw InputError(fmt::format("{}: the key '{}' is given twice in one object", m_file.string(), key));
    }
    return true;
  }

 private:
  const std::filesystem::path& m_file;
  std::vector<std::set<std::string>> m_keys;  ///< of the open object at each depth
};

/// Without the library's own prefix.
std::string reason(const std::string& what) {
  const std::size_t prefix = what.find("column");
  const std::size_t colon = what.find(": ", prefix == std::string::npos ? 0 : prefix);
  return colon == std::string::npos ? what : what.substr(colon + 2);
}

}  // namespace

Json parseFile(const std::filesystem::path& file) {
  return parseText(readTextFile(file), file);
}

Json parseText(std::string_view text, const std::filesystem::path& file) {
  try {
    return Json::parse(text, Guard(file), true, true);
  } catch (const Json::parse_error& error) {
    failInText(file, text, error.byte > 0 ? error.byte - 1 : 0, "malformed JSON: " + reason(error.what()));
  } catch (const Json::out_of_range& error) {
    const std::string what = error.what();  // ends with the number between quotes
    const std::size_t quote = what.find('\'');
    const std::string number = what.substr(quote + 1, what.rfind('\'') - quote - 1);
    failInText(file, text, text.find(number), fmt::format("the number {} is too large", number));
  }
}

}  // namespace pt::json
