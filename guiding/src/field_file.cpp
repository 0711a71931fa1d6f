#include <cerrno>
#include <cstdio>
#include <cstring>

#include "byte_stream.h"
#include "guiding/serialize.h"
#include "library_edge.h"
#include "serialize.h"

// File: 8 bytes magic, u32 version, u64 payload size, u64 checksum of the payload, payload. All little-endian.
namespace guiding {

namespace {

namespace fs = std::filesystem;

constexpr char kMagic[8] = {'S', 'D', 'T', 'F', 'I', 'E', 'L', 'D'};
constexpr std::uint32_t kVersion = 4;
constexpr std::size_t kHeaderBytes = 8 + 4 + 8 + 8;

struct Close {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

Error ioError(const fs::path& path, const char* what, int reason) {
  return {ErrorCode::Io, path.string() + ": " + what + (reason != 0 ? std::string(": ") + std::strerror(reason) : "")};
}

Error formatError(const fs::path& path, const char* what) {
  return {ErrorCode::Format, path.string() + ": " + what};
}

/// A new file beside `path`, removed at the end of its life unless it took the place of `path`.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& path) : m_target(path) {
    // Names of runs that were killed may still be there.
    constexpr int kMostTries = 1000;
    for (int i = 0; i < kMostTries && !m_file; ++i) {
      m_path = path;
      m_path += ".tmp" + std::to_string(i);
      m_file.reset(std::fopen(m_path.string().c_str(), "wbx"));
      if (!m_file && errno != EEXIST) break;
    }
    m_exists = m_file != nullptr;
  }
  ~TemporaryFile() {
    m_file.reset();
    std::error_code ignored;
    if (m_exists) fs::remove(m_path, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  bool write(std::span<const std::uint8_t> bytes) noexcept {
    return m_file && std::fwrite(bytes.data(), 1, bytes.size(), m_file.get()) == bytes.size();
  }
  bool close() noexcept { return m_file && std::fclose(m_file.release()) == 0; }
  std::error_code replaceTarget() {
    std::error_code failed;
    fs::rename(m_path, m_target, failed);
    m_exists = bool(failed);
    return failed;
  }

 private:
  fs::path m_target, m_path;
  File m_file;
  bool m_exists = false;
};

std::vector<std::uint8_t> headerOf(std::span<const std::uint8_t> payload) {
  ByteWriter header;
  for (const char c : kMagic) header.put(std::uint8_t(c));
  header.put(kVersion);
  header.put(std::uint64_t(payload.size()));
  header.put(checksum(payload));
  return header.bytes();
}

Status savePayload(std::span<const std::uint8_t> payload, const fs::path& path) {
  errno = 0;
  TemporaryFile file(path);
  if (!file.write(headerOf(payload)) || !file.write(payload) || !file.close())
    return ioError(path, "cannot be written", errno);
  if (const std::error_code failed = file.replaceTarget(); failed)
    return ioError(path, "cannot be written", failed.value());
  return Success{};
}

/// The payload, once all that can be told from the header is right. mostBytes 0: no limit.
Result<std::vector<std::uint8_t>> loadPayload(const fs::path& path, std::size_t mostBytes) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed))
    return Error{ErrorCode::Io, path.string() + ": there is no such file, or it is not a regular one"};
  const std::uintmax_t size = fs::file_size(path, failed);
  if (failed) return ioError(path, "cannot be opened", failed.value());
  errno = 0;
  const File file(std::fopen(path.string().c_str(), "rb"));
  if (!file) return ioError(path, "cannot be opened", errno);

  std::uint8_t bytes[kHeaderBytes];
  if (std::fread(bytes, 1, kHeaderBytes, file.get()) != kHeaderBytes || std::memcmp(bytes, kMagic, sizeof kMagic) != 0)
    return formatError(path, "is not a guiding field; train one and save it with this library");
  ByteReader header(std::span<const std::uint8_t>{bytes}.subspan(sizeof kMagic));
  if (header.get<std::uint32_t>() != kVersion)
    return formatError(path, "was written by another version of the library; train the field again");
  const auto payloadSize = header.get<std::uint64_t>();
  const auto expected = header.get<std::uint64_t>();
  if (size != kHeaderBytes + payloadSize)
    return formatError(path, "is truncated or has bytes after its end; train the field again");
  if (mostBytes > 0 && payloadSize > mostBytes)
    return Error{ErrorCode::OutOfMemory, path.string() + ": holds " + std::to_string(payloadSize) +
                                             " bytes, more than the limit of " + std::to_string(mostBytes) +
                                             "; raise the limit if the file is to be trusted"};

  std::vector<std::uint8_t> payload(payloadSize);
  if (std::fread(payload.data(), 1, payload.size(), file.get()) != payload.size())
    return ioError(path, "cannot be read", errno);
  if (checksum(payload) != expected) return formatError(path, "is damaged (wrong checksum); train the field again");
  return payload;
}

}  // namespace

/// The one friend of Field that turns it into bytes and back.
class FieldFile {
 public:
  static const Field::State& stateOf(const Field& field) { return *field.m_state; }
  static Field fieldOf(std::unique_ptr<Field::State> state) { return Field(std::move(state)); }
};

Status save(const Field& field, const fs::path& path) noexcept {
  return withoutThrowing([&] { return savePayload(payloadOf(FieldFile::stateOf(field)), path); });
}

Result<Field> load(const fs::path& path, std::size_t maxMemoryBytes) noexcept {
  return withoutThrowing([&]() -> Result<Field> {
    const Result<std::vector<std::uint8_t>> payload = loadPayload(path, maxMemoryBytes);
    if (!payload) return payload.error();
    std::unique_ptr<Field::State> state = stateOf(payload.value());
    if (!state) return formatError(path, "holds an inconsistent field; train the field again");
    std::size_t& cap = state->settings.maxMemoryBytes;
    if (maxMemoryBytes > 0 && (cap == 0 || cap > maxMemoryBytes)) cap = maxMemoryBytes;
    return FieldFile::fieldOf(std::move(state));
  });
}

}  // namespace guiding
