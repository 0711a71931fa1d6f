#pragma once

#include <string>

#include "core/error.h"
#include "scene/scene_description.h"

namespace pt {

/// Something that a scene may rightly ask for and we do not have. Loaders told to skip such things catch it and list
/// the reason.
struct UnsupportedError : InputError {
  UnsupportedError(const SourceLocation& source, const std::string& what)
      : InputError(source + ": " + what + "; --skip-unsupported leaves it out"), reason(source + ": " + what) {}

  std::string reason;  ///< place and thing, without the remedy
};

/// Throws InputError "source: message".
[[noreturn]] inline void failAt(const SourceLocation& source, const std::string& message) {
  throw InputError(source + ": " + message);
}

}  // namespace pt
