#pragma once

#include <atomic>

namespace pt {

/// From now on the first SIGINT (Ctrl-C) or SIGTERM sets the flag that is returned instead of ending the program; the
/// second one ends it.
const std::atomic<bool>& catchInterrupts();

}  // namespace pt
