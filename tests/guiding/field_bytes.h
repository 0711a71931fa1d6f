#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "catch.h"
#include "guiding/serialize.h"

namespace test {

/// A name among temporary files that is this process's own, for tests run side by side; removed at the end.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name)
      : m_path(std::filesystem::temp_directory_path() / ("guiding-" + std::to_string(getpid()) + "-" + name)) {
    std::filesystem::remove(m_path);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(m_path, ignored);
  }
  const std::filesystem::path& path() const { return m_path; }

 private:
  std::filesystem::path m_path;
};

using Bytes = std::vector<char>;

inline Bytes readBytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

inline void writeBytes(const std::filesystem::path& path, const Bytes& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

/// All that a field knows.
inline Bytes bytesOf(const guiding::Field& field) {
  const TemporaryFile file("bytes_of_a.field");
  const guiding::Status saved = guiding::save(field, file.path());
  if (!saved) FAIL(saved.error().text);
  return readBytes(file.path());
}

}  // namespace test
