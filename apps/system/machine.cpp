#include "system/machine.h"

#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

#include "system/system_file.h"

namespace pliant_system {
namespace {

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

}  // namespace pliant_system
