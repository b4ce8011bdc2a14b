#include "pliant/constraints/line.h"

#include "pliant/constraints/anchored_batch.h"

namespace pliant {

ConstraintSet build(const BodyView& body, const Line& options) {
  return build_anchored<LineProjection>(body, options, "direction", options.direction);
}

}  // namespace pliant
