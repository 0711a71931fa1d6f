#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bench {

/// A place in the program that raised a floating-point exception.
struct TrappedException {
  std::string kind;    ///< "invalid", "division by zero", "overflow"
  std::string module;  ///< file name of the program or library
  std::string place;   ///< "function (file:line)", innermost first, where the module has debug information
  std::uint64_t count = 0;
};

/// While one is alive, the thread and the workers that its task arenas start are interrupted by floating-point
/// exceptions (invalid, division by zero, overflow); each is counted by place, and the instruction is repeated with its
/// usual result. x86-64 Linux in a build with GUIDING_TRAPPING_MATH, or compilers may raise some of their own: throws
/// InputError elsewhere if `enable` is set.
class FloatTraps {
 public:
  explicit FloatTraps(bool enable);
  ~FloatTraps();
  FloatTraps(const FloatTraps&) = delete;
  FloatTraps& operator=(const FloatTraps&) = delete;

  /// What was counted since the last call, by all threads; call it while none is alive.
  static std::vector<TrappedException> take();

 private:
  unsigned m_before = 0;
  bool m_enabled = false;
};

/// Why an exception is no fault, where it is understood.
std::optional<std::string> reasonFor(const TrappedException& exception);

}  // namespace bench
