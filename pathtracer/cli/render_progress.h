#pragma once

#include <chrono>
#include <cstdio>

#include "integrators/render.h"

namespace pt {

/// Shows how far a render is: a bar on a terminal, else one line an iteration.
class RenderProgressDisplay {
 public:
  explicit RenderProgressDisplay(std::FILE* stream);
  ~RenderProgressDisplay();

  void update(const RenderProgress& progress);

 private:
  void drawBar(const RenderProgress& progress);

  std::FILE* m_stream;
  bool m_isTerminal;
  bool m_isBarOpen = false;
  int m_iteration = -1;
  std::chrono::steady_clock::time_point m_lastDrawn;
};

}  // namespace pt
