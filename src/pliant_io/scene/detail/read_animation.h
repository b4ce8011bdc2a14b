#pragma once
#include <memory>
#include <optional>

#include "pliant/timeline/path.h"
#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

struct BodyAnimation {
  std::shared_ptr<Path> path;        ///< null: the body stays where it is
  std::optional<Positions> begin{};  ///< the first frame, where the vertices start [m]; none: where the body has them
};

/// The animation of a body with so many vertices. Frames have the coordinates of its mesh file: they are scaled and
/// turned as that is, and go through the body's transform. `body`: the object of the body.
BodyAnimation read_animation(const Node& node, const Node& body, Index vertex_count);

}  // namespace pliant
