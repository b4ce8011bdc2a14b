#pragma once
// One exception type for everything a user can fix. The message is one line: what, where, remedy.
#include <stdexcept>
#include <string>
#include <utility>

namespace pliant {

/// Why something failed; the command line maps it to the exit code of the same number.
enum class ErrorKind {
  input = 2,          ///< a file, a scene, a parameter
  diverged = 3,       ///< a step would have produced a non-finite value
  output = 4,         ///< a file that could not be written
  interrupted = 130,  ///< someone asked to stop
};

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

[[noreturn]] inline void fail_input(const std::string& message) {
  throw Error(ErrorKind::input, message);
}

/// Calls f; an error of its input that does not begin with the place gets it in front.
template <class F>
decltype(auto) at_place(const std::string& place, F&& f) {
  try {
    return std::forward<F>(f)();
  } catch (const Error& error) {
    const std::string message = error.what();
    if (error.kind() != ErrorKind::input || message.starts_with(place + ":")) throw;
    fail_input(place + ": " + message);
  }
}

}  // namespace pliant
