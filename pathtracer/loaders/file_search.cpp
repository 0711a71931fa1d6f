#include "loaders/file_search.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/error.h"

namespace pt {

void FileSearch::addFolder(const std::filesystem::path& folder) {
  if (std::find(m_folders.begin(), m_folders.end(), folder) == m_folders.end()) m_folders.push_back(folder);
}

void FileSearch::addFolderInFront(const std::filesystem::path& folder) {
  std::erase(m_folders, folder);
  m_folders.insert(m_folders.begin(), folder);
}

std::optional<std::filesystem::path> FileSearch::find(const std::string& name) const {
  std::string portable = name;
  std::replace(portable.begin(), portable.end(), '\\', '/');
  for (const auto& folder : m_folders) {
    std::filesystem::path candidate = folder / portable;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(candidate, ignored)) return candidate;
  }
  return std::nullopt;
}

std::string lowerCaseEnding(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

std::string readTextFile(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError(file.string() + ": no such file");
  if (std::filesystem::is_directory(status)) throw InputError(file.string() + ": is a directory, not a file");
  // A scene may name any path; a device has no end, and a pipe waits for somebody.
  if (!std::filesystem::is_regular_file(status))
    throw InputError(file.string() + ": is a device or a pipe; copy what it gives to a file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string() + ": cannot be opened: " + std::strerror(errno));
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) throw InputError(file.string() + ": cannot be read");
  return text;
}

}  // namespace pt
