#include "system/folder_lock.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant_system {
namespace {

constexpr const char* note_name = ".pliant-lock";
constexpr std::size_t command_limit = 300;

/// The words that started this program.
std::string own_command() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string words{std::istreambuf_iterator<char>(file), {}};
  while (words.ends_with('\0')) words.pop_back();
  for (char& c : words) {
    if (c == '\0' || c == '\n') c = ' ';
  }
  return words;
}

/// The note is for people: without it, on a full disk, the lock is as good. What stands in its place, maybe a link to
/// something else, goes first and is not followed.
void write_note(int folder) {
  unlinkat(folder, note_name, 0);
  const int file = openat(folder, note_name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) return;
  const std::string text = fmt::format("{}\n{}\n", getpid(), own_command());
  if (write(file, text.data(), text.size()) < 0) unlinkat(folder, note_name, 0);
  close(file);
}

struct Owner {
  pid_t process = 0;  ///< 0: unknown
  std::string command;
};

Owner read_note(int folder) {
  const int file = openat(folder, note_name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return {};
  std::string text(4096, '\0');
  const ssize_t size = read(file, text.data(), text.size());
  close(file);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  Owner owner;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), owner.process);
  if (error != std::errc() || owner.process <= 0 || end == text.data() + text.size() || *end != '\n') return {};
  const auto begin = static_cast<std::size_t>(end - text.data()) + 1;
  owner.command = pliant::printable(text.substr(begin, text.find('\n', begin) - begin), command_limit);
  return owner;
}

bool is_alive(pid_t process) {
  return kill(process, 0) == 0 || errno == EPERM;
}

[[noreturn]] void fail_folder(const std::filesystem::path& folder, std::string_view what) {
  throw pliant::Error(pliant::ErrorKind::output, fmt::format("{}: {}", pliant::printable_place(folder.string()), what));
}

/// Who has the lock may be about to write its note, over one that a killed process left.
[[noreturn]] void fail_locked(const std::filesystem::path& folder, int descriptor) {
  Owner owner;
  for (int attempt = 0; attempt < 20; ++attempt) {
    owner = read_note(descriptor);
    if (owner.process > 0 && is_alive(owner.process)) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  close(descriptor);
  const std::string remedy = "wait until it ends, or give another folder";
  if (owner.process == 0) fail_folder(folder, "another process writes here; " + remedy);
  const bool alive = is_alive(owner.process);
  fail_folder(folder, fmt::format("{}process {} ({}){} writes here; {}", alive ? "" : "what ", owner.process,
                                  owner.command, alive ? "" : " started still", remedy));
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) {
  // Without O_CLOEXEC: a run whose sweep was killed goes on, and nobody else may write in its folder meanwhile.
  folder_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY);  // NOLINT(android-cloexec-open)
  if (folder_ < 0) {
    fail_folder(folder,
                fmt::format("cannot be opened: {}; choose another folder", std::generic_category().message(errno)));
  }
  if (flock(folder_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) fail_locked(folder, folder_);
  write_note(folder_);
}

FolderLock::~FolderLock() {
  unlinkat(folder_, note_name, 0);
  close(folder_);
}

}  // namespace pliant_system
