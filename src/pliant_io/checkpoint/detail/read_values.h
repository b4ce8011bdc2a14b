#pragma once
// Numbers and bytes of a checkpoint.
#include <span>
#include <string>

#include "pliant/collision/colliders/collider.h"
#include "pliant_io/scene/detail/json_values.h"

namespace pliant {

std::string read_bytes(const Node& node);

/// Numbers written as bytes, into all of `numbers`. Refuses other lengths, and what is not finite.
void read_numbers(const Node& node, std::span<Real> numbers);

Real read_real(const Node& node);

void read_rotation(const Node& node, Quaternion& rotation);

template <class Visitor>
void for_each(const Node& list, Visitor&& visitor) {
  list.require_list();
  for (std::size_t i = 0; i < list.size(); ++i) visitor(list[i]);
}

}  // namespace pliant
