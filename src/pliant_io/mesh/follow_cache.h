#pragma once
#include "pliant/timeline/path.h"
#include "pliant_io/mesh/point_cache.h"

namespace pliant {

/// Follows the vertices of a point cache, see follow_animation; linear in time between two frames.
std::shared_ptr<Path> follow_cache(PointCache cache, std::vector<Index> vertices = {}, Attach attach = Attach::offset);

}  // namespace pliant
