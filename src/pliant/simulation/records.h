#pragma once
// What a simulation is made of: bodies, and groups of constraints on them.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pliant/constraints/constraint_set.h"
#include "pliant/forces/force_options.h"

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

/// Whether options say where targets or origins are.
template <class Constraint>
bool gives_anchors(const Constraint& options) {
  if constexpr (requires { options.targets; }) {
    return !options.targets.empty();
  } else if constexpr (requires { options.origin; }) {
    return !options.origin.empty();
  } else {
    return false;
  }
}

/// The options that something was made of, whatever their type.
class AnyOptions {
 public:
  virtual ~AnyOptions() = default;
};

template <class Options>
class OptionsOf final : public AnyOptions {
 public:
  explicit OptionsOf(Options given) : options(std::move(given)) {}
  const Options options;
};

template <class Options>
std::shared_ptr<const AnyOptions> source_of(const Options& options) {
  return std::make_shared<const OptionsOf<Options>>(options);
}

/// What a simulation knows of a force besides the force itself.
struct ForceRecord {
  std::string name;
  std::optional<BodyId> body{};                   ///< that it is on; none: all there were, or it is a user's own
  std::shared_ptr<const AnyOptions> source = {};  ///< none: it is a user's own
};

/// Null where it was made of options of another type.
template <class Options>
const Options* options_in(const ForceRecord& record) {
  const auto* source = dynamic_cast<const OptionsOf<Options>*>(record.source.get());
  return source == nullptr ? nullptr : &source->options;
}

/// What becomes of the anchors (targets of pins and drags, origins of lines) of a group that is replaced. `kept`: a
/// constraint of the same vertices has that of its predecessor; `given`: all have what the new options say.
enum class Anchors { kept, given };

}  // namespace pliant
