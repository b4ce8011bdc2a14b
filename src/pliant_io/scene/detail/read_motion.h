#pragma once
// Values of events, and the paths that they describe.
#include <filesystem>

#include "pliant_io/scene/detail/json_values.h"
#include "pliant_io/scene/event_options.h"

namespace pliant {

struct SceneReader;

/// A whole number, or a list of such.
void read(const Node& node, std::vector<Index>& numbers);
/// An object {"axis", "degrees"}.
void read(const Node& node, Rotation& rotation);
/// A list of objects {"time", "translate", "rotate"}.
void read(const Node& node, std::vector<Keyframe>& keyframes);

struct EventPath {
  std::shared_ptr<Path> path;
  ConstraintNumbers index;  ///< of the constraints that go along it; empty: all
};

/// The path of an object with the options of `move` (MoveOptions) or `follow` (FollowOptions). Other keys than theirs
/// and `more_keys` are refused.
EventPath read_move(const Node& node, std::vector<std::string_view> more_keys);
EventPath read_follow(const Node& node, std::vector<std::string_view> more_keys, const SceneReader& scene);

}  // namespace pliant
