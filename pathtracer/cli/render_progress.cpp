#include "cli/render_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pt {

namespace {

constexpr int kBarWidth = 24;
constexpr std::chrono::milliseconds kRedrawInterval{100};

double fractionDone(const RenderProgress& p) {
  const double done = p.sppTotal > 0 ? double(p.sppDone) / double(p.sppTotal) : p.secondsDone / p.secondsBudget;
  return std::clamp(done, 0.0, 1.0);
}

std::string duration(double seconds) {
  const long s = std::lround(std::max(0.0, seconds));
  if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

double secondsLeft(const RenderProgress& p) {
  if (p.sppTotal == 0) return p.secondsBudget - p.secondsDone;
  return p.secondsDone * double(p.sppTotal - p.sppDone) / double(p.sppDone);
}

std::string sppText(const RenderProgress& p) {
  return p.sppTotal > 0 ? fmt::format("{}/{} spp", p.sppDone, p.sppTotal) : fmt::format("{} spp", p.sppDone);
}

}  // namespace

RenderProgressDisplay::RenderProgressDisplay(std::FILE* stream)
    : m_stream(stream), m_isTerminal(isatty(fileno(stream))) {}

RenderProgressDisplay::~RenderProgressDisplay() {
  if (m_isBarOpen) std::fputc('\n', m_stream);
}

void RenderProgressDisplay::update(const RenderProgress& progress) {
  if (m_isTerminal) {
    drawBar(progress);
  } else if (progress.iteration != m_iteration) {
    fmt::print(m_stream, "iteration {}{}: {}, {:.1f} s\n", progress.iteration + 1, progress.isFinal ? " (final)" : "",
               sppText(progress), progress.secondsDone);
  }
  m_iteration = progress.iteration;
}

void RenderProgressDisplay::drawBar(const RenderProgress& progress) {
  const auto now = std::chrono::steady_clock::now();
  const double done = fractionDone(progress);
  if (now - m_lastDrawn < kRedrawInterval && done < 1) return;
  m_lastDrawn = now;
  m_isBarOpen = true;
  const int filled = int(std::lround(done * kBarWidth));
  fmt::print(m_stream, "\r[{}{}] {:3.0f}%  iteration {}, pass {}  {}  {} left\x1b[K",
             std::string(std::size_t(filled), '#'), std::string(std::size_t(kBarWidth - filled), '.'), 100 * done,
             progress.iteration + 1, progress.pass, sppText(progress), duration(secondsLeft(progress)));
  std::fflush(m_stream);
}

}  // namespace pt
