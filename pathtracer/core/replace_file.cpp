#include "core/replace_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/error.h"

namespace pt {

namespace {

namespace fs = std::filesystem;

fs::path temporaryName(const fs::path& target) {
  return target.parent_path() /
         fmt::format(".{}.part{}{}", target.stem().string(), getpid(), target.extension().string());
}

/// Removes a file at the end of its life unless it was renamed by then.
struct TemporaryFile {
  fs::path path;
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

[[noreturn]] void failToWrite(const fs::path& target, const std::string& reason) {
  throw WorkError(fmt::format("{}: cannot be written: {}", target.string(), reason));
}

}  // namespace

void replaceFile(const fs::path& target, const std::function<void(const fs::path&)>& write) {
  requireReplaceable(target);
  const TemporaryFile temporary{temporaryName(target)};
  write(temporary.path);
  std::error_code error;
  fs::rename(temporary.path, target, error);
  if (error) failToWrite(target, error.message());
}

void replaceFile(const fs::path& target, std::string_view bytes) {
  replaceFile(target, [&](const fs::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream.write(bytes.data(), std::streamsize(bytes.size()));
    stream.close();
    if (!stream) failToWrite(target, std::strerror(errno));
  });
}

void requireReplaceable(const fs::path& target) {
  if (!target.has_filename()) throw InputError(fmt::format("{}: is a folder; give a file name", target.string()));
  std::error_code ignored;
  const auto status = fs::status(target, ignored);
  if (fs::is_directory(status)) throw InputError(fmt::format("{}: is a folder; give a file name", target.string()));
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError(fmt::format("{}: is a device or pipe and cannot be replaced; give a file name", target.string()));
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored))
    throw InputError(
        fmt::format("{}: the folder {} does not exist; create it first", target.string(), folder.string()));

  const TemporaryFile probe{temporaryName(target)};
  if (!std::ofstream(probe.path, std::ios::binary)) failToWrite(target, std::strerror(errno));
}

}  // namespace pt
