#pragma once
// The scenes of the experiments, which are part of the program: every experiments/*/*.json.
#include <span>

#include "pliant_io/scene/builtin_scenes.h"

namespace pliant_experiments {

/// By their path below experiments/, without ".json": "damping/curtain".
std::span<const pliant::BuiltinScene> experiment_scenes();

}  // namespace pliant_experiments
