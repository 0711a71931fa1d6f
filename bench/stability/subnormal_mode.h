#pragma once

namespace bench {

/// While one is alive, the thread and the workers that its task arenas start take subnormal numbers for zero, as
/// operands (DAZ) and as results (FTZ), if `flush` is set. Throws InputError on processors without MXCSR.
class SubnormalMode {
 public:
  explicit SubnormalMode(bool flush);
  ~SubnormalMode();
  SubnormalMode(const SubnormalMode&) = delete;
  SubnormalMode& operator=(const SubnormalMode&) = delete;

 private:
  unsigned m_before = 0;
};

}  // namespace bench
