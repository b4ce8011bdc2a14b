#pragma once
// The processor, for people and for what is measured on it.
#include <cstdint>
#include <string>

namespace pliant_system {

std::string processor_name();

/// Size of the data cache of level 2 or 3 [bytes]; 0 where the system does not say.
std::int64_t cache_bytes(int level);

}  // namespace pliant_system
