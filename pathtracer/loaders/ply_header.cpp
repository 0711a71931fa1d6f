#include "loaders/ply_header.h"

#include <fmt/format.h>

#include <fstream>
#include <string>

#include "core/error.h"
#include "loaders/parse_number.h"

namespace pt {
namespace {

constexpr std::size_t kMaxHeaderLines = 1000;

std::string readLine(std::istream& stream) {
  std::string line;
  std::getline(stream, line);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

}  // namespace

void checkPlyHeader(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (readLine(stream) != "ply") throw InputError(file.string() + ": is no PLY file: its first line is not 'ply'");
  const auto bytes = std::filesystem::file_size(file);
  for (std::size_t count = 0; stream && count < kMaxHeaderLines; ++count) {
    const std::string line = readLine(stream);
    if (line == "end_header") return;
    const auto words = splitList(line);
    if (words.size() != 3 || words[0] != "element") continue;
    const auto number = parseInteger(words[2]);
    if (!number || *number < 0 || static_cast<std::uintmax_t>(*number) > bytes)
      throw InputError(
          fmt::format("{}: the PLY header announces '{}' in a file of {} bytes", file.string(), line, bytes));
  }
  throw InputError(file.string() + ": the PLY header has no 'end_header'");
}

}  // namespace pt
