#pragma once
// What depends on the operating system: other programs.
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pliant_sweep {

/// How a process ended.
struct ProcessEnd {
  int exit_code = 0;
  int signal = 0;  ///< that ended it; 0: none, and the exit code counts
};

/// "exit code 2", "ended by signal 9 (Killed)".
std::string end_text(const ProcessEnd& end);

/// A program that runs beside this one; interrupts of the terminal reach both. It is ended when this object goes.
class ChildProcess {
 public:
  /// Starts a program, which reads nothing and writes both its streams to a file that is made anew.
  /// @throws pliant::Error (output): that file, or a process, cannot be made; (input): there is no such program
  ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
               const std::filesystem::path& output);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Asks it to end, or ends it.
  void interrupt() const;
  void kill() const;
  /// None while it runs. Does not wait.
  std::optional<ProcessEnd> end();

 private:
  friend void wait_for_any(const std::vector<const ChildProcess*>& children, std::chrono::milliseconds most);

  int process_ = -1;
  int life_ = -1;  // becomes readable when the process is gone
  std::optional<ProcessEnd> end_;
};

/// Returns when one of them has ended, a signal has come or the time is over.
void wait_for_any(const std::vector<const ChildProcess*>& children, std::chrono::milliseconds most);

/// The path that starts this same program, also after its file was replaced.
std::string own_program();

}  // namespace pliant_sweep
