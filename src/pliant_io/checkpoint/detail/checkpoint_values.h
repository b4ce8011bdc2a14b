#pragma once
// What the writing and the reading of a checkpoint share.
#include <string_view>

#include "pliant/timeline/path.h"
#include "pliant_io/scene/scene_source.h"

namespace pliant {

/// Calls field(name, value) for each override that may be given or not.
template <class Overrides, class Visitor>
void visit_overrides(Overrides& overrides, Visitor&& field) {
  field("steps", overrides.steps);
  field("time_step", overrides.time_step);
  field("iterations", overrides.iterations);
  field("tolerance", overrides.tolerance);
  field("threads", overrides.threads);
  field("backend", overrides.backend);
  field("format", overrides.format);
  field("every", overrides.every);
}

}  // namespace pliant
