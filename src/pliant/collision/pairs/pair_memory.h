#pragma once
// What a pair of the step before was a pair of.
#include "pliant/collision/contact/contact_state.h"
#include "pliant/collision/pairs/surface.h"

namespace pliant {

/// A vertex of each of its features, or −1 for one that there is not any more.
std::array<Index, 2> vertices_of(const PairMemory& pair, const Surface& surface);

}  // namespace pliant
