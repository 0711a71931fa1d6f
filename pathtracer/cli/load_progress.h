#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>

namespace pt {

/// Shows how many mesh files have been read: a line that renews itself on a terminal, else a line every other second.
/// A scene that loads at once shows nothing.
class LoadProgressDisplay {
 public:
  explicit LoadProgressDisplay(std::FILE* stream);
  ~LoadProgressDisplay();

  void update(std::size_t read, std::size_t all);

 private:
  std::FILE* m_stream;
  bool m_isTerminal;
  bool m_isLineOpen = false;
  std::chrono::steady_clock::time_point m_lastShown;
};

}  // namespace pt
