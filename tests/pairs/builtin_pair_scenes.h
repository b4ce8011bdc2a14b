#pragma once
// Built-in scenes in which surfaces touch, changed as the pair scenes are.
#include <string>
#include <vector>

#include "tests/pairs/pair_scene.h"

namespace pliant_tests {

/// The names of those whose surfaces touch.
std::vector<std::string> builtin_pair_scenes();
/// A scene at its own size, with its own settings unless the options have others than the usual ones. What nothing pins
/// is thrown with the speed; a vertex of the last body that moves freely is dragged. Throws Error(input) on a name that
/// there is not, and where nothing can be thrown or dragged.
PairScene make_builtin_pair_scene(std::string_view name, const PairOptions& options);

}  // namespace pliant_tests
