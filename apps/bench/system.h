#pragma once
// What depends on the operating system and the processor: names, sizes of caches, peak memory.
#include <cstdint>
#include <optional>
#include <string>

namespace pliant_bench {

std::string processor_name();
/// Size of the data cache of level 2 or 3 [bytes]; 0 where the system does not say.
std::int64_t cache_bytes(int level);
/// Memory that may be taken now [bytes]; 0 where the system does not say.
std::int64_t free_memory_bytes();
/// "2026-01-31 12:00", UTC
std::string utc_date();

/// How much more memory the process had at its peak since this was made than when it was made.
class PeakMemory {
 public:
  PeakMemory();
  /// [bytes]; nothing where the system does not say.
  std::optional<std::int64_t> bytes() const;

 private:
  std::optional<std::int64_t> before_;
};

}  // namespace pliant_bench
