#include "system/child_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant_system {
namespace {

[[noreturn]] void throw_system(int error_number) {
  throw std::system_error(error_number, std::generic_category());
}

/// A file of its own: what has the name may be a link, or another name of a file elsewhere.
Descriptor make_log(const std::filesystem::path& path) {
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  Descriptor file(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (file.number() >= 0) return file;
  throw pliant::Error(pliant::ErrorKind::output,
                      fmt::format("{}: cannot be written: {}; choose another place or make room",
                                  pliant::printable_place(path.string()), std::generic_category().message(errno)));
}

/// What a process begins with.
class SpawnSettings {
 public:
  SpawnSettings() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  void set_stream(int stream, int file) { posix_spawn_file_actions_adddup2(&actions_, file, stream); }
  void drop_stream(int stream) { posix_spawn_file_actions_addopen(&actions_, stream, "/dev/null", O_WRONLY, 0); }
  void make_group() {
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes_, 0);
  }

  /// @returns the number of the process. @throws std::system_error
  pid_t start(const ChildOptions& options) const {
    std::vector<std::string> words = {options.program};
    words.insert(words.end(), options.arguments.begin(), options.arguments.end());
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    pid_t process = -1;
    const int error = posix_spawnp(&process, words[0].c_str(), &actions_, &attributes_, pointers.data(), environ);
    if (error != 0) throw_system(error);
    return process;
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

ProcessEnd end_of(int status) {
  if (WIFSIGNALED(status)) return {0, WTERMSIG(status)};
  return {WEXITSTATUS(status), 0};
}

}  // namespace

std::string end_text(const ProcessEnd& end) {
  if (end.signal == 0) return fmt::format("exit code {}", end.exit_code);
  const char* name = strsignal(end.signal);
  return fmt::format("ended by signal {} ({})", end.signal, name != nullptr ? name : "unknown");
}

bool ended_by_interrupt(const ProcessEnd& end) {
  return end.signal == SIGHUP || end.signal == SIGINT || end.signal == SIGTERM;
}

ChildProcess::ChildProcess(const ChildOptions& options) {
  // A socket rather than a pipe, since only send() can be told to raise no SIGPIPE.
  std::array<int, 2> ends = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) throw_system(errno);
  input_.reset(ends[0]);
  const Descriptor other_end(ends[1]);
  SpawnSettings settings;
  settings.set_stream(STDIN_FILENO, other_end.number());
  Descriptor log;
  if (options.log.empty()) {
    messages_.reset(memfd_create("messages", MFD_CLOEXEC));
    if (messages_.number() < 0) throw_system(errno);
    settings.drop_stream(STDOUT_FILENO);
    settings.set_stream(STDERR_FILENO, messages_.number());
  } else {
    log = make_log(options.log);
    settings.set_stream(STDOUT_FILENO, log.number());
    settings.set_stream(STDERR_FILENO, log.number());
  }
  // The last: one of the files above may have that number here.
  if (options.file >= 0) settings.set_stream(child_file_number, options.file);
  if (options.interrupts == Interrupts::parent) settings.make_group();
  process_ = settings.start(options);
}

ChildProcess::~ChildProcess() {
  if (end_) return;
  kill();
  wait();
}

bool ChildProcess::feed(std::span<const std::uint8_t> bytes) const {
  while (!bytes.empty()) {
    const ssize_t part = send(input_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (part < 0 && errno != EINTR) return false;
    if (part > 0) bytes = bytes.subspan(static_cast<std::size_t>(part));
  }
  return true;
}

void ChildProcess::end_input() const {
  shutdown(input_.number(), SHUT_WR);
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
  end_ = process < 0 ? ProcessEnd{0, SIGKILL} : end_of(status);
  return end_;
}

ProcessEnd ChildProcess::wait() {
  if (end_) return *end_;
  int status = 0;
  pid_t process = -1;
  while ((process = waitpid(process_, &status, 0)) < 0 && errno == EINTR) {
  }
  end_ = process < 0 ? ProcessEnd{0, SIGKILL} : end_of(status);
  return *end_;
}

std::string ChildProcess::messages() const {
  constexpr off_t max_size = 4096;
  const off_t size = std::max<off_t>(lseek(messages_.number(), 0, SEEK_END), 0);
  std::string text(static_cast<std::size_t>(std::min(size, max_size)), '\0');
  const ssize_t got = pread(messages_.number(), text.data(), text.size(), size - static_cast<off_t>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return text;
}

void wait_for_any(const std::vector<const ChildProcess*>& children, std::chrono::milliseconds most) {
  std::vector<pollfd> lives;
  lives.reserve(children.size());
  for (const ChildProcess* child : children) lives.push_back({child->input_.number(), POLLIN, 0});
  if (poll(lives.data(), lives.size(), static_cast<int>(most.count())) <= 0) return;
  // The streams are closed a moment before the process can be waited for.
  for (std::size_t i = 0; i < lives.size(); ++i) {
    if ((lives[i].revents & POLLHUP) == 0) continue;
    siginfo_t info = {};
    while (waitid(P_PID, static_cast<id_t>(children[i]->process_), &info, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
  }
}

std::string own_program() {
  return "/proc/self/exe";
}

std::string own_program_file() {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::read_symlink(own_program(), error);
  if (!error && std::filesystem::exists(file, error)) return file.string();
  throw pliant::Error(pliant::ErrorKind::input,
                      fmt::format("{}: the file of this program was removed or replaced; start it again",
                                  pliant::printable_place(file.string())));
}

}  // namespace pliant_system
