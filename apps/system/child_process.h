#pragma once
// Other programs, as processes beside this one.
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "system/descriptor.h"

namespace pliant_system {

/// How a process ended.
struct ProcessEnd {
  int exit_code = 0;
  int signal = 0;  ///< that ended it; 0: none, and the exit code counts
};

/// "exit code 2", "ended by signal 9 (Killed)".
std::string end_text(const ProcessEnd& end);

/// Whether that was by someone who wanted it to end: a terminal, a user, the system when it shuts down.
bool ended_by_interrupt(const ProcessEnd& end);

/// Whom an interrupt of the terminal reaches.
enum class Interrupts { both, parent };

/// The number under which a program finds ChildOptions::file; /proc/self/fd/3 is its path there.
inline constexpr int child_file_number = 3;

struct ChildOptions {
  std::string program;                 ///< a path, or a name that is looked for in PATH
  std::vector<std::string> arguments;  ///< without the program's own name
  std::filesystem::path log =
      {};         ///< has all it writes, made anew; empty: messages() has its standard error, the rest is lost
  int file = -1;  ///< an open file that the program gets; -1: none
  Interrupts interrupts = Interrupts::both;  ///< whether Ctrl+C reaches the program too
};

/// A program that runs beside this one. It is ended when this object goes.
class ChildProcess {
 public:
  /// Starts a program.
  /// @throws pliant::Error (output): the log cannot be made; std::system_error: the program cannot be started
  explicit ChildProcess(const ChildOptions& options);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Writes to its standard input; waits until it has taken all. @returns false: it takes no more
  bool feed(std::span<const std::uint8_t> bytes) const;
  /// It reads the end of its standard input.
  void end_input() const;

  /// Asks it to end, or ends it.
  void interrupt() const;
  void kill() const;
  /// None while it runs. Does not wait.
  std::optional<ProcessEnd> end();
  /// Waits for its end.
  ProcessEnd wait();

  /// The last 4096 bytes that it has written, if it has no log.
  std::string messages() const;

 private:
  friend void wait_for_any(const std::vector<const ChildProcess*>& children, std::chrono::milliseconds most);

  int process_ = -1;
  Descriptor input_;     // a socket, whose other end is the process' standard input; it hangs up when that is gone
  Descriptor messages_;  // a file in memory, so that the process never waits for a reader
  std::optional<ProcessEnd> end_;
};

/// Returns when one of them has ended, a signal has come or the time is over.
void wait_for_any(const std::vector<const ChildProcess*>& children, std::chrono::milliseconds most);

/// The path that starts this same program, also after its file was replaced.
std::string own_program();

/// The path of this program's file, for other processes to start.
/// @throws pliant::Error (input): it was removed or replaced meanwhile
std::string own_program_file();

}  // namespace pliant_system
