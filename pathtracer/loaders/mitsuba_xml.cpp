#include "loaders/mitsuba_xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <set>

#include "core/near_name.h"
#include "loaders/loader_error.h"

namespace pt::mitsuba {
namespace {

constexpr int kMaxNesting = 64;
constexpr std::size_t kMaxOpenIncludes = 16;
constexpr int kMaxIncludes = 256;
constexpr std::size_t kMaxSubstituted = 1 << 24;

/// An open file: turns pugixml's offsets into lines.
class SourceFile {
 public:
  explicit SourceFile(const std::filesystem::path& path) : m_path(path), m_text(readTextFile(path)) {
    for (std::size_t i = 0; i < m_text.size(); ++i)
      if (m_text[i] == '\n') m_lineEnds.push_back(i);
    const pugi::xml_parse_result parsed = m_xml.load_buffer(m_text.data(), m_text.size());
    if (!parsed) failAt(at(parsed.offset), fmt::format("malformed XML: {}", parsed.description()));
  }

  pugi::xml_node root() const { return m_xml.document_element(); }
  std::filesystem::path folder() const { return m_path.parent_path(); }
  const std::filesystem::path& path() const { return m_path; }

  SourceLocation at(std::ptrdiff_t offset) const {
    const auto end = std::lower_bound(m_lineEnds.begin(), m_lineEnds.end(),
                                      static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    return fmt::format("{}:{}", m_path.string(), end - m_lineEnds.begin() + 1);
  }

 private:
  std::filesystem::path m_path;
  std::string m_text;
  std::vector<std::size_t> m_lineEnds;
  pugi::xml_document m_xml;
};

bool isNameCharacter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

class XmlReader {
 public:
  explicit XmlReader(const std::map<std::string, std::string>& variables)
      : m_given(variables), m_variables(variables) {}

  XmlScene read(const std::filesystem::path& path) {
    const SourceFile file(path);
    checkRoot(file);
    m_scene.search.addFolder(file.folder());
    m_scene.root = readElement(file, file.root(), 0);
    checkGivenVariables(path);
    return std::move(m_scene);
  }

 private:
  static void checkRoot(const SourceFile& file) {
    if (std::string_view(file.root().name()) != "scene")
      failAt(file.at(file.root().offset_debug()),
             fmt::format("the root element is <{}>; a Mitsuba scene starts with <scene>", file.root().name()));
  }

  void checkGivenVariables(const std::filesystem::path& path) const {
    for (const auto& [name, value] : m_given)
      if (!m_used.contains(name))
        throw InputError(fmt::format("{}: the scene uses no variable '{}'{}", path.string(), name,
                                     suggestName(name, {m_used.begin(), m_used.end()})));
  }

  Element readElement(const SourceFile& file, pugi::xml_node node, int depth) {
    Element element{node.name(), {}, {}, file.at(node.offset_debug())};
    if (depth > kMaxNesting) failAt(element.source, fmt::format("elements are nested deeper than {}", kMaxNesting));
    for (const pugi::xml_attribute attribute : node.attributes())
      if (!element.attributes.emplace(attribute.name(), substitute(attribute.value(), element.source)).second)
        failAt(element.source, fmt::format("attribute '{}' is given twice", attribute.name()));
    readChildren(file, node, depth, element);
    return element;
  }

  void readChildren(const SourceFile& file, pugi::xml_node node, int depth, Element& parent) {
    for (const pugi::xml_node child : node.children()) {
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
        failAt(parent.source, fmt::format("stray text in <{}>; values belong into value=\"...\"", parent.tag));
      if (child.type() != pugi::node_element) continue;
      Element element = readElement(file, child, depth + 1);
      if (element.tag == "default") {
        setDefault(element);
      } else if (element.tag == "path") {
        addPath(file, element);
      } else if (element.tag == "include") {
        include(file, element, depth, parent);
      } else {
        parent.children.push_back(std::move(element));
      }
    }
  }

  static const std::string& attribute(const Element& element, const std::string& name) {
    const auto found = element.attributes.find(name);
    if (found == element.attributes.end())
      failAt(element.source, fmt::format("<{}> lacks the attribute '{}'", element.tag, name));
    return found->second;
  }

  void setDefault(const Element& element) {
    m_variables.emplace(attribute(element, "name"), attribute(element, "value"));
  }

  void addPath(const SourceFile& file, const Element& element) {
    const std::filesystem::path folder = file.folder() / attribute(element, "value");
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored))
      failAt(element.source, fmt::format("<path>: there is no folder '{}'", folder.string()));
    m_scene.search.addFolderInFront(folder.lexically_normal());
  }

  void include(const SourceFile& file, const Element& element, int depth, Element& parent) {
    const std::string& name = attribute(element, "filename");
    FileSearch search = m_scene.search;
    search.addFolderInFront(file.folder());
    const auto path = search.find(name);
    if (!path) failAt(element.source, fmt::format("cannot find the included file '{}'", name));
    if (++m_includes > kMaxIncludes || m_openIncludes.size() >= kMaxOpenIncludes)
      failAt(element.source,
             fmt::format("more than {} includes, or {} of them nested", kMaxIncludes, kMaxOpenIncludes));
    if (!m_openIncludes.insert(*path).second) failAt(element.source, fmt::format("'{}' includes itself", name));
    const SourceFile included(*path);
    m_scene.search.addFolder(included.folder());
    if (std::string_view(included.root().name()) == "scene") {
      readChildren(included, included.root(), depth, parent);
    } else {
      parent.children.push_back(readElement(included, included.root(), depth + 1));
    }
    m_openIncludes.erase(*path);
  }

  /// Replaces each $name; the longest known name counts, as in "$resx" where both "res" and "resx" are known.
  std::string substitute(std::string_view text, const SourceLocation& source) {
    std::string result;
    while (!text.empty()) {
      const std::size_t dollar = text.find('$');
      result += text.substr(0, dollar);
      if (dollar == std::string_view::npos) break;
      text.remove_prefix(dollar + 1);
      std::size_t length = 0;
      while (length < text.size() && isNameCharacter(text[length])) ++length;
      const std::string_view whole = text.substr(0, length);
      while (length > 0 && !m_variables.contains(std::string(text.substr(0, length)))) --length;
      if (length == 0) failUnknownVariable(whole, source);
      const std::string name(text.substr(0, length));
      m_used.insert(name);
      const std::string& value = m_variables.at(name);
      m_substituted += value.size();
      if (m_substituted > kMaxSubstituted)
        failAt(source, fmt::format("the values of variables come to more than {} characters", kMaxSubstituted));
      result += value;
      text.remove_prefix(length);
    }
    return result;
  }

  [[noreturn]] void failUnknownVariable(std::string_view name, const SourceLocation& source) const {
    std::vector<std::string> known;
    for (const auto& [variable, value] : m_variables) known.push_back(variable);
    failAt(source,
           fmt::format("the variable ${} has no value: give it one, or a <default>{}", name, suggestName(name, known)));
  }

  std::map<std::string, std::string> m_given, m_variables;
  std::set<std::string> m_used;
  std::set<std::filesystem::path> m_openIncludes;
  int m_includes = 0;
  std::size_t m_substituted = 0;  ///< characters that stand in the place of variables so far
  XmlScene m_scene;
};

}  // namespace

XmlScene readXml(const std::filesystem::path& file, const std::map<std::string, std::string>& variables) {
  return XmlReader(variables).read(file);
}

}  // namespace pt::mitsuba
