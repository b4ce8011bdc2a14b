#include "system/streams.h"

#include <csignal>

#include <fcntl.h>
#include <unistd.h>

namespace pliant_system {

void guard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    if (open("/dev/null", O_RDWR) == -1) return;  // takes the lowest free number: this one
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool is_terminal(Stream stream) {
  const int number = stream == Stream::input ? STDIN_FILENO : stream == Stream::output ? STDOUT_FILENO : STDERR_FILENO;
  return isatty(number) == 1;
}

}  // namespace pliant_system
