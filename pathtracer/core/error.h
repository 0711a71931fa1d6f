#pragma once

#include <stdexcept>

namespace pt {

/// The user's input cannot be used: the message names file, place and remedy in one line. Exit status 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Something failed at work (disk full, unwritable output). Exit status 1.
struct WorkError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace pt
