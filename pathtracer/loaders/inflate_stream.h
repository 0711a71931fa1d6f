#pragma once

#include <zlib.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace pt {

/// Reads what zlib compressed from a file, piece by piece.
class InflateStream {
 public:
  /// The compressed bytes start at `offset`; `name` of the file is for messages. Throws InputError.
  InflateStream(std::ifstream& file, std::uint64_t offset, std::string name);
  ~InflateStream();
  InflateStream(const InflateStream&) = delete;
  InflateStream& operator=(const InflateStream&) = delete;

  /// Fills `count` bytes. Throws InputError where the data end before or are damaged.
  void read(void* target, std::size_t count);
  template <class T>
  T value() {
    T result;
    read(&result, sizeof(T));
    return result;
  }

  /// More than the rest of the file can hold at zlib's best rate.
  std::uint64_t mostBytes() const noexcept { return m_mostBytes; }

 private:
  [[noreturn]] void fail(const std::string& problem) const;
  void refill();

  std::ifstream& m_file;
  std::string m_name;
  z_stream m_zlib{};
  std::vector<unsigned char> m_input;
  std::uint64_t m_mostBytes;
};

}  // namespace pt
