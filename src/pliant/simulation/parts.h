#pragma once
// What a simulation is made of: bodies, and groups of constraints on them.
#include <string>
#include <vector>

#include "pliant/constraints/constraint_set.h"

namespace pliant {

enum class BodyId : Index {};
enum class GroupId : Index {};
enum class ForceId : Index {};

/// One body. Its vertices are [first_vertex, first_vertex + mesh.vertex_count()) of the simulation.
struct Body {
  std::string name;
  Mesh mesh;  ///< its vertices are the rest positions
  Index first_vertex = 0;
};

struct BodyOptions {
  std::string name{};      ///< in messages; default "body 0", "body 1", ...
  Positions start{};       ///< m × 3 [m]; default: the rest positions
  Positions velocities{};  ///< m × 3 [m/s]; default: zero
};

/// Constraints of one type on one body, as a user sees them.
struct Group {
  std::string name;
  std::string type;
  BodyId body{};
  ConstraintSet set;
  std::vector<Index> points{};  ///< of each target a number, which it keeps when others come and go; at first 0, 1, ...
  Index next_point = 0;         ///< the number of the next new target
};

/// What becomes of the anchors (targets of pins and drags, origins of lines) of a group that is replaced. `kept`: a
/// constraint of the same vertices has that of its predecessor; `given`: all have what the new options say.
enum class Anchors { kept, given };

}  // namespace pliant
