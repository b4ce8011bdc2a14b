#pragma once
#include "pliant/timeline/path.h"
#include "pliant_io/mesh/point_cache.h"

namespace pliant {

/// The frames of a point cache, the first one at 0 s; linear in time between two frames.
std::shared_ptr<PointAnimation> cached_animation(PointCache cache);

/// Follows the vertices of a point cache, see follow_animation; linear in time between two frames.
std::shared_ptr<Path> follow_cache(PointCache cache, std::vector<Index> vertices = {}, Attach attach = Attach::offset);

}  // namespace pliant
