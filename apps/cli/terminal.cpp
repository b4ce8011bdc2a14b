#include "terminal.h"

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace pliant_cli {

void guard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    if (open("/dev/null", O_RDWR) == -1) return;  // takes the lowest free number: this one
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

namespace {

/// Bytes of memory that a process may still take [B]; 0 where the system does not say.
rlim_t free_memory() {
  std::ifstream file("/proc/meminfo");
  std::string name;
  for (rlim_t kilobytes = 0; file >> name >> kilobytes;
       file.ignore(std::numeric_limits<std::streamsize>::max(), '\n')) {
    if (name == "MemAvailable:") return kilobytes * 1024;
  }
  return 0;
}

/// Bytes of writable memory that this process has mapped.
rlim_t mapped_memory() {
  std::ifstream file("/proc/self/statm");
  rlim_t pages = 0;
  for (int field = 0; field < 6; ++field) file >> pages;  // the sixth: data and stack
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

void limit_memory() {
  const rlim_t available = free_memory();
  const rlim_t mapped = mapped_memory();
  rlimit limit = {};
  // A sanitizer maps more than there is, and checks what is used itself.
  if (available == 0 || mapped > available || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  const rlim_t most = mapped + available - available / 16;
  if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur <= most) return;
  limit.rlim_cur = most;
  setrlimit(RLIMIT_DATA, &limit);
}

namespace {

Ansi ansi = Ansi::automatic;

bool has_colors(int stream) {
  if (ansi != Ansi::automatic) return ansi == Ansi::always;
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  if (no_color != nullptr && *no_color != '\0') return false;
  return isatty(stream) == 1 && (terminal == nullptr || std::string_view(terminal) != "dumb");
}

std::string with_code(std::string_view code, std::string_view text) {
  return "\x1b[" + std::string(code) + "m" + std::string(text) + "\x1b[0m";
}

struct Label {
  std::string_view text;
  std::string_view code;
};
constexpr std::string_view red = "1;31", yellow = "1;33", green = "32", cyan = "36";
constexpr std::array labels = {Label{"pliant: error:", red}, Label{"warning:", yellow}, Label{"interrupted:", yellow},
                               Label{"note:", cyan}, Label{"hint:", cyan}};

std::string colored(std::string_view text) {
  if (text.starts_with(rewritten_line)) {
    const std::string_view line = text.substr(rewritten_line.size());
    return std::string(rewritten_line) + (line.empty() ? "" : with_code(cyan, line));
  }
  for (const Label& label : labels) {
    if (text.starts_with(label.text))
      return with_code(label.code, label.text) + std::string(text.substr(label.text.size()));
  }
  return std::string(text);
}

}  // namespace

void choose_ansi(Ansi choice) {
  ansi = choice;
}

std::string in_tone(Tone tone, std::string_view text) {
  if (!has_colors(STDOUT_FILENO)) return std::string(text);
  return with_code(tone == Tone::good ? green : tone == Tone::warning ? yellow : red, text);
}

void print_to_stderr(std::string_view text) {
  const std::string printed = has_colors(STDERR_FILENO) ? colored(text) : std::string(text);
  std::fwrite(printed.data(), 1, printed.size(), stderr);
  std::fflush(stderr);
}

bool has_error_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

std::optional<bool> ask(std::string_view question) {
  if (!has_error_terminal() || isatty(STDIN_FILENO) != 1) return {};
  print_to_stderr(std::string(question) + " [y/N] ");
  std::string answer;
  std::getline(std::cin, answer);
  return answer.starts_with('y') || answer.starts_with('Y');
}

}  // namespace pliant_cli
