#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pt {

/// Folders in which the files named by a scene are looked for, first come first served.
class FileSearch {
 public:
  void addFolder(const std::filesystem::path& folder);
  /// Goes before all that are there.
  void addFolderInFront(const std::filesystem::path& folder);

  /// The first existing file of that name. Backslashes count as slashes.
  std::optional<std::filesystem::path> find(const std::string& name) const;

 private:
  std::vector<std::filesystem::path> m_folders;
};

/// ".obj" for "Table.OBJ".
std::string lowerCaseEnding(const std::filesystem::path& file);

/// The whole file. Throws InputError, naming it, for a file that is missing, a directory or unreadable.
std::string readTextFile(const std::filesystem::path& file);

}  // namespace pt
