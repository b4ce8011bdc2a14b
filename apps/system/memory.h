#pragma once
// How much memory there is, may be taken and was taken.
#include <cstdint>
#include <functional>
#include <optional>

namespace pliant_system {

/// Memory that may be taken now [bytes]; 0 where the system does not say.
std::int64_t free_memory_bytes();

/// Lets no allocation go past the memory that is free now, so that a scene too large for this machine ends in
/// std::bad_alloc, and not with the system killing this program or another.
void limit_memory();

/// The most memory that this process has held so far [bytes].
std::int64_t peak_memory_bytes();

/// The most memory that a process of its own, which begins as a copy of this one, holds while it does `act` [bytes].
std::int64_t peak_memory_bytes_of(const std::function<void()>& act);

/// How much more memory the process had at its peak since this was made than when it was made.
class PeakMemory {
 public:
  PeakMemory();
  /// [bytes]; nothing where the system does not say.
  std::optional<std::int64_t> bytes() const;

 private:
  std::optional<std::int64_t> before_;
};

}  // namespace pliant_system
