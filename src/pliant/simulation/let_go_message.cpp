#include "pliant/simulation/let_go_message.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace pliant {

LetGoMessage::LetGoMessage(const LetGoBodies& let_go, const std::vector<Body>& bodies) {
  const auto body_of = [&](Index vertex) -> const Body& {
    return *std::prev(std::ranges::upper_bound(bodies, vertex, {}, &Body::first_vertex));
  };
  const Body& one = body_of(let_go.edge[0]);
  const Body& other = body_of(let_go.triangle[0]);
  const Vec3 place = let_go.place.array() + 0.0;  // no −0
  const std::string at_place = fmt::format("at ({:.4g}, {:.4g}, {:.4g}) m", place.x(), place.y(), place.z());
  const auto edge = [&](std::size_t i) { return let_go.edge[i] - one.first_vertex; };
  const auto corner = [&](std::size_t i) { return let_go.triangle[i] - other.first_vertex; };
  if (let_go.is_held_up) {
    begin = fmt::format("'{}', which is pinned, was held up for long by '{}': ", one.name, other.name);
    end = fmt::format("vertex {} {}; what is held up passes through until it is where it should be", edge(0), at_place);
    return;
  }
  const auto& [first, second] = let_go.bodies;
  begin = first == second ? fmt::format("'{}' crosses itself: ", one.name)
                          : fmt::format("'{}' crosses '{}': ", bodies[at(first)].name, bodies[at(second)].name);
  end = fmt::format("edge {}-{} of '{}', face {}-{}-{} of '{}', {}; they are let go until they are apart", edge(0),
                    edge(1), one.name, corner(0), corner(1), corner(2), other.name, at_place);
}

}  // namespace pliant
