#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "sweep/process.h"

extern char** environ;

namespace pliant_sweep {
namespace {

std::string reason(int error_number) {
  return std::generic_category().message(error_number);
}

[[noreturn]] void fail_process(const std::filesystem::path& path, std::string_view why) {
  throw pliant::Error(pliant::ErrorKind::output, fmt::format("{}: {}", pliant::printable_place(path.string()), why));
}

/// A number of the system that is closed when it goes.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

/// The streams that a process begins with.
class Streams {
 public:
  Streams(int input, int output) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, output, STDERR_FILENO);
  }
  ~Streams() { posix_spawn_file_actions_destroy(&actions_); }
  Streams(const Streams&) = delete;
  Streams& operator=(const Streams&) = delete;

  /// @returns the system's number of the error, 0 for none
  int start(const std::string& program, const std::vector<std::string>& arguments, int& process) const {
    std::vector<std::string> words = {program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return posix_spawn(&process, program.c_str(), &actions_, nullptr, pointers.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

std::string end_text(const ProcessEnd& end) {
  if (end.signal == 0) return fmt::format("exit code {}", end.exit_code);
  const char* name = strsignal(end.signal);
  return fmt::format("ended by signal {} ({})", end.signal, name != nullptr ? name : "unknown");
}

ChildProcess::ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
                           const std::filesystem::path& output) {
  const Descriptor file(open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.number() < 0) fail_process(output, fmt::format("cannot be written: {}", reason(errno)));
  // The writing end of a pipe is the standard input: nothing can be read there, and it is closed when the process ends.
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) {
    fail_process(output.parent_path(), fmt::format("no run can be started: {}; give fewer --jobs", reason(errno)));
  }
  Descriptor life(ends[0]);
  const Descriptor other_end(ends[1]);
  const int error = Streams(other_end.number(), file.number()).start(program, arguments, process_);
  if (error == ENOENT || error == EACCES || error == ENOEXEC) {
    pliant::fail_input(fmt::format("{}: cannot be started: {}", pliant::printable_place(program), reason(error)));
  }
  if (error != 0) {
    fail_process(output.parent_path(), fmt::format("no run can be started: {}; give fewer --jobs", reason(error)));
  }
  life_ = life.release();
}

ChildProcess::~ChildProcess() {
  if (!end_) {
    kill();
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  close(life_);
}

// SIGTERM rather than SIGINT, which a shell lets programs in the background ignore.
void ChildProcess::interrupt() const {
  if (!end_) ::kill(process_, SIGTERM);
}

void ChildProcess::kill() const {
  if (!end_) ::kill(process_, SIGKILL);
}

std::optional<ProcessEnd> ChildProcess::end() {
  if (end_) return end_;
  int status = 0;
  const pid_t process = waitpid(process_, &status, WNOHANG);
  if (process == 0 || (process < 0 && errno == EINTR)) return std::nullopt;
  end_ = ProcessEnd{};
  if (process < 0 || WIFSIGNALED(status)) {
    end_->signal = process < 0 ? SIGKILL : WTERMSIG(status);
  } else {
    end_->exit_code = WEXITSTATUS(status);
  }
  return end_;
}

void wait_for_any(const std::vector<const ChildProcess*>& children, std::chrono::milliseconds most) {
  std::vector<pollfd> lives;
  lives.reserve(children.size());
  for (const ChildProcess* child : children) lives.push_back({child->life_, POLLIN, 0});
  if (poll(lives.data(), lives.size(), static_cast<int>(most.count())) <= 0) return;
  // The streams are closed a moment before the process can be waited for.
  for (std::size_t i = 0; i < lives.size(); ++i) {
    if (lives[i].revents == 0) continue;
    siginfo_t info = {};
    while (waitid(P_PID, static_cast<id_t>(children[i]->process_), &info, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
  }
}

std::string own_program() {
  return "/proc/self/exe";
}

}  // namespace pliant_sweep
