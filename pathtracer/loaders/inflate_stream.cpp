#include "loaders/inflate_stream.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace pt {
namespace {

constexpr std::size_t kInputBytes = 1 << 16;
constexpr std::size_t kLargestPiece = 1 << 30;  // zlib counts in 32 bits

/// Of any deflate stream: two bits stand for 258 bytes at the most.
constexpr std::uint64_t kBestRate = 1032;

}  // namespace

InflateStream::InflateStream(std::ifstream& file, std::uint64_t offset, std::string name)
    : m_file(file), m_name(std::move(name)), m_input(kInputBytes) {
  m_file.clear();
  m_file.seekg(0, std::ios::end);
  const auto size = std::uint64_t(std::max<std::streamoff>(0, m_file.tellg()));
  if (offset >= size) fail("ends before the mesh");
  m_mostBytes = (size - offset) * kBestRate;
  m_file.seekg(std::streamoff(offset));
  if (inflateInit(&m_zlib) != Z_OK) throw WorkError("zlib cannot start");
}

InflateStream::~InflateStream() {
  inflateEnd(&m_zlib);
}

void InflateStream::fail(const std::string& problem) const {
  throw InputError(fmt::format("{}: {}; the file is damaged, export it again", m_name, problem));
}

void InflateStream::refill() {
  m_file.read(reinterpret_cast<char*>(m_input.data()), std::streamsize(m_input.size()));
  m_zlib.next_in = m_input.data();
  m_zlib.avail_in = unsigned(m_file.gcount());
  if (m_zlib.avail_in == 0) fail("ends within the mesh");
}

void InflateStream::read(void* target, std::size_t count) {
  auto* next = static_cast<unsigned char*>(target);
  while (count > 0) {
    if (m_zlib.avail_in == 0) refill();
    const std::size_t piece = std::min(count, kLargestPiece);
    m_zlib.next_out = next;
    m_zlib.avail_out = unsigned(piece);
    const int status = inflate(&m_zlib, Z_NO_FLUSH);
    const std::size_t made = piece - m_zlib.avail_out;
    next += made;
    count -= made;
    if (status == Z_STREAM_END && count > 0) fail("the mesh ends early");
    if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR) fail("the mesh cannot be decompressed");
  }
}

}  // namespace pt
