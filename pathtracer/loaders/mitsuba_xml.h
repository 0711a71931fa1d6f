#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "loaders/file_search.h"
#include "scene/scene_description.h"

namespace pt::mitsuba {

/// An XML element, its $variables replaced.
struct Element {
  std::string tag;
  std::map<std::string, std::string> attributes;
  std::vector<Element> children;
  SourceLocation source;
};

/// A scene file with what it includes spliced in.
struct XmlScene {
  Element root;
  FileSearch search;
};

/// Reads a scene file, replaces $variables (the given values beat the <default>s), follows <include> and <path>.
/// Throws InputError with file and line.
XmlScene readXml(const std::filesystem::path& file, const std::map<std::string, std::string>& variables);

}  // namespace pt::mitsuba
