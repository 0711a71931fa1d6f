#include "cli/load_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <string>

namespace pt {

namespace {

constexpr std::chrono::milliseconds kTerminalInterval{100}, kLogInterval{2000};

}  // namespace

LoadProgressDisplay::LoadProgressDisplay(std::FILE* stream)
    : m_stream(stream), m_isTerminal(isatty(fileno(stream))), m_lastShown(std::chrono::steady_clock::now()) {}

LoadProgressDisplay::~LoadProgressDisplay() {
  if (m_isLineOpen) fmt::print(m_stream, "\r\x1b[K");
}

void LoadProgressDisplay::update(std::size_t read, std::size_t all) {
  const auto now = std::chrono::steady_clock::now();
  if (now - m_lastShown < (m_isTerminal ? kTerminalInterval : kLogInterval)) return;
  m_lastShown = now;
  const std::string text = fmt::format("loading: {} of {} meshes", read, all);
  fmt::print(m_stream, "{}{}{}", m_isTerminal ? "\r" : "", text, m_isTerminal ? "\x1b[K" : "\n");
  std::fflush(m_stream);
  m_isLineOpen = m_isTerminal;
}

}  // namespace pt
