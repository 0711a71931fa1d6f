#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace guiding {

enum class ErrorCode {
  InvalidArgument,  ///< a setting or argument lies outside its documented range
  Io,               ///< a file could not be opened, read or written
  Format,           ///< a file is not what it claims to be: foreign, truncated, corrupted or of another version
  OutOfMemory,
};

/// What went wrong and how to mend it, in one line of plain text.
struct Error {
  ErrorCode code = ErrorCode::InvalidArgument;
  std::string text;
};

/// Either a value or an Error. The library reports every failure of set-up, files and settings this way and never
/// throws.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : m_state(std::move(value)) {}
  Result(Error error) : m_state(std::move(error)) {}

  bool ok() const noexcept { return std::holds_alternative<T>(m_state); }
  explicit operator bool() const noexcept { return ok(); }

  T& value() & {
    assert(ok());
    return *std::get_if<T>(&m_state);
  }
  const T& value() const& {
    assert(ok());
    return *std::get_if<T>(&m_state);
  }
  T&& value() && {
    assert(ok());
    return std::move(*std::get_if<T>(&m_state));
  }
  const Error& error() const {
    assert(!ok());
    return *std::get_if<Error>(&m_state);
  }

 private:
  std::variant<T, Error> m_state;
};

/// Success without a value, or an Error.
struct Success {};
using Status = Result<Success>;

}  // namespace guiding
