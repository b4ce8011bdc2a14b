#include "bench/system.h"

#include <ctime>
#include <fstream>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace pliant_bench {
namespace {

/// What stands behind "name" and a colon in a file of lines like "name : value"; empty where there is none.
std::string value_of(const char* path, std::string_view name) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos || !line.starts_with(name)) continue;
    const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? std::string() : line.substr(begin);
  }
  return {};
}

/// "1234 kB" in bytes; 0 where there is no number.
std::int64_t kilobytes(const std::string& text) {
  return text.empty() ? 0 : 1024 * std::strtoll(text.c_str(), nullptr, 10);
}

std::int64_t cache_bytes_by_file(int level) {
  for (int index = 0; index < 8; ++index) {
    const std::string folder = fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}/", index);
    int its_level = 0;
    std::string type;
    std::string size;
    std::ifstream(folder + "level") >> its_level;
    std::ifstream(folder + "type") >> type;
    std::ifstream(folder + "size") >> size;  // "2048K"
    if (its_level == level && type != "Instruction") return kilobytes(size);
  }
  return 0;
}

void return_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace

std::string processor_name() {
  std::string name = value_of("/proc/cpuinfo", "model name");
  return name.empty() ? "unknown processor" : name;
}

std::int64_t cache_bytes(int level) {
#ifdef _SC_LEVEL2_CACHE_SIZE
  const long bytes = sysconf(level == 2 ? _SC_LEVEL2_CACHE_SIZE : _SC_LEVEL3_CACHE_SIZE);
  if (bytes > 0) return bytes;
#endif
  return cache_bytes_by_file(level);
}

std::int64_t free_memory_bytes() {
  return kilobytes(value_of("/proc/meminfo", "MemAvailable"));
}

std::string utc_date() {
  return fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(std::time(nullptr)));
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

}  // namespace pliant_bench
