#pragma once
// One exception type for everything a user can mend. The message is one line: what, where, remedy.
#include <stdexcept>
#include <string>

namespace pliant {

/// Why something failed; the command line maps it to the exit code of the same number.
enum class ErrorKind {
  input = 2,     ///< a file, a scene, a parameter
  diverged = 3,  ///< a step would have produced a non-finite value
  output = 4,    ///< a file that could not be written
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

}  // namespace pliant
