#include "system/memory.h"

#include <fstream>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "system/system_file.h"

namespace pliant_system {
namespace {

/// Bytes of writable memory that this process has mapped.
rlim_t mapped_memory() {
  std::ifstream file("/proc/self/statm");
  rlim_t pages = 0;
  for (int field = 0; field < 6; ++field) file >> pages;  // the sixth: data and stack
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

void return_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace

std::int64_t free_memory_bytes() {
  return kilobytes(value_of("/proc/meminfo", "MemAvailable"));
}

void limit_memory() {
  const auto available = static_cast<rlim_t>(free_memory_bytes());
  const rlim_t mapped = mapped_memory();
  rlimit limit = {};
  // A sanitizer maps more than there is, and checks what is used itself.
  if (available == 0 || mapped > available || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  const rlim_t most = mapped + available - available / 16;
  if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur <= most) return;
  limit.rlim_cur = most;
  setrlimit(RLIMIT_DATA, &limit);
}

std::int64_t peak_memory_bytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{1024} * usage.ru_maxrss;
}

std::int64_t peak_memory_bytes_of(const std::function<void()>& act) {
  const pid_t child = fork();
  if (child == 0) {
    act();
    _exit(0);
  }
  int status = 0;
  rusage usage = {};
  wait4(child, &status, 0, &usage);
  return std::int64_t{1024} * usage.ru_maxrss;
}

PeakMemory::PeakMemory() {
  return_freed_memory();
  std::ofstream reset("/proc/self/clear_refs");
  reset << "5" << std::flush;
  if (reset) before_ = kilobytes(value_of("/proc/self/status", "VmRSS"));
}

std::optional<std::int64_t> PeakMemory::bytes() const {
  if (!before_) return std::nullopt;
  return kilobytes(value_of("/proc/self/status", "VmHWM")) - *before_;
}

}  // namespace pliant_system
