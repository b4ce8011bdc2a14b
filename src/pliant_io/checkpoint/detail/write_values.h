#pragma once
// Numbers and bytes of a checkpoint.
#include <span>
#include <string_view>

#include <nlohmann/json.hpp>

#include "pliant/core/types.h"

namespace pliant {

/// Texts may hold what is no UTF-8, a path for one; bytes may hold anything.
nlohmann::json bytes_of(std::string_view text);
nlohmann::json bytes_of(std::span<const Real> numbers);
nlohmann::json bytes_of(const Positions& rows);
nlohmann::json bytes_of(const Vec3& vector);

}  // namespace pliant
