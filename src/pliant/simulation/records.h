#pragma once
// What a simulation is made of: bodies, and groups of constraints on them.
#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pliant/collision/colliders/collider.h"
#include "pliant/collision/contact/body_contact.h"
#include "pliant/constraints/constraint_set.h"
#include "pliant/core/option_visitors.h"
#include "pliant/forces/force_options.h"

namespace pliant {

class Simulation;

enum class BodyId : Index {};
enum class GroupId : Index {};
enum class ForceId : Index {};
enum class ColliderId : Index {};

/// One body. Its vertices are [first_vertex, first_vertex + mesh.vertex_count()) of the simulation.
struct Body {
  std::string name;
  Mesh mesh;  ///< its vertices are the rest positions
  Index first_vertex = 0;
  BodyContact contact{};  ///< see Simulation::set_contact
};

struct BodyOptions {
  std::string name{};      ///< in messages; default "body 0", "body 1", ...
  Positions start{};       ///< m × 3 [m]; default: the rest positions
  Positions velocities{};  ///< m × 3 [m/s]; default: zero
};

/// What becomes of the anchors (targets of pins and drags, origins of lines) of a group that is replaced. `kept`: a
/// constraint of the same vertices has that of its predecessor; `given`: all have what the new options say.
enum class Anchors { kept, given };

/// The option of a constraint that says where targets or origins are; null for a type without.
template <class Constraint>
const Points* anchors_in(const Constraint& options) {
  if constexpr (requires {
                  { options.targets } -> std::same_as<const Points&>;
                }) {
    return &options.targets;
  } else if constexpr (requires {
                         { options.origin } -> std::same_as<const Points&>;
                       }) {
    return &options.origin;
  } else {
    return nullptr;
  }
}

/// The options that something was made of, whatever their type.
class AnyOptions {
 public:
  virtual ~AnyOptions() = default;
  virtual void list(OptionLister& lister) const = 0;
  /// Of constraints, the stiffness that is the common factor of a group, and anchors_in(); null for a type without.
  virtual const Values* stiffness() const = 0;
  virtual const Points* anchors() const = 0;
  /// Makes the group, force or collider of that number, which was made of these, anew: of what it has now, changed.
  virtual void change(Simulation& simulation, Index number, OptionSetter& setter) const = 0;
};

/// AnyOptions::change, of options of this type.
template <class Options, class Owner>
void change_options(Owner& simulation, Index number, OptionSetter& setter) {
  const auto changed = [&setter](Options options) {
    set_options(options, setter);
    return options;
  };
  if constexpr (describes_force<Options>) {
    simulation.replace(ForceId{number}, changed(*simulation.template options<Options>(ForceId{number})));
  } else if constexpr (describes_collider<Options>) {
    simulation.replace(ColliderId{number}, changed(*simulation.template options<Options>(ColliderId{number})));
  } else {
    Options options = *simulation.template options<Options>(GroupId{number});
    set_options(options, setter);
    const bool gives_anchors = setter.has_changed(anchors_in(options));
    simulation.replace(GroupId{number}, options, gives_anchors ? Anchors::given : Anchors::kept);
  }
}

template <class Options>
class OptionsOf final : public AnyOptions {
 public:
  explicit OptionsOf(Options given) : options(std::move(given)) {}
  void list(OptionLister& lister) const override { list_options(options, lister); }
  const Values* stiffness() const override {
    if constexpr (requires {
                    { options.stiffness } -> std::same_as<const Values&>;
                  })
      return &options.stiffness;
    return nullptr;
  }
  const Points* anchors() const override { return anchors_in(options); }
  void change(Simulation& simulation, Index number, OptionSetter& setter) const override {
    change_options<Options>(simulation, number, setter);
  }
  const Options options;
};

template <class Options>
std::shared_ptr<const AnyOptions> source_of(const Options& options) {
  return std::make_shared<const OptionsOf<Options>>(options);
}

/// What a group or a force was made of; null where it was made of options of another type, or of none.
template <class Options, class Record>
const Options* options_in(const Record& record) {
  const auto* source = dynamic_cast<const OptionsOf<Options>*>(record.source.get());
  return source == nullptr ? nullptr : &source->options;
}

/// Constraints of one type on one body, or between two, as a user sees them.
struct Group {
  std::string name;
  std::string type;
  BodyId body{};
  /// None of constraints that were made elsewhere. Stiffness and targets may have changed since (Simulation::options).
  std::shared_ptr<const AnyOptions> source;
  ConstraintSet set;
  std::vector<Index> points{};  ///< of each target a number, which it keeps when others come and go; at first 0, 1, ...
  Index next_point = 0;         ///< the number of the next new target
  std::optional<BodyId> other{};  ///< that it ties `body` to, which may be the same; none: it is on `body` alone
};

/// Constraints that tie a body to another one.
template <class Constraint>
concept between_bodies = requires(const Constraint& options) {
  { options.to } -> std::same_as<const BodyId&>;
};

/// A group on a body, or between that and another one, given how to see a body.
template <class Constraint, class View>
Group group_of(BodyId id, const Constraint& options, std::string name, View&& view) {
  check_options(Constraint::info.name, options);
  Group group{std::move(name), std::string(Constraint::info.name), id, source_of(options), {}};
  if constexpr (between_bodies<Constraint>) {
    group.set = build(view(id), view(options.to), options);
    group.other = options.to;
  } else {
    group.set = build(view(id), options);
  }
  return group;
}

template <class Constraint>
bool gives_anchors(const Constraint& options) {
  const Points* anchors = anchors_in(options);
  return anchors != nullptr && !anchors->empty();
}

/// Stiffnesses of constraints whose group has this common factor by now: the factor, or that times each one's own.
Values with_factor(const Values& given, Real factor);

/// What a group was made of, with its common factor of now, if it has one; none where it was made of another type.
template <class Constraint>
std::optional<Constraint> options_of(const Group& group, std::optional<Real> factor) {
  const Constraint* given = options_in<Constraint>(group);
  if (given == nullptr) return std::nullopt;
  Constraint now = *given;
  if constexpr (requires { now.stiffness.each(); }) {
    if (factor) now.stiffness = with_factor(now.stiffness, *factor);
  }
  return now;
}

/// What a simulation knows of a force besides the force itself.
struct ForceRecord {
  std::string name;
  std::optional<BodyId> body{};                   ///< that it is on; none: all there were, or it is a user's own
  std::shared_ptr<const AnyOptions> source = {};  ///< none: it is a user's own
};

/// A collider as a user sees it. Where it is, Simulation::pose() says.
struct ColliderRecord {
  std::string name;
  std::shared_ptr<const AnyOptions> source;  ///< none: it is a user's own
  std::shared_ptr<const ColliderShape> shape;
  Pose pose{};  ///< where it began, or was put last
  ColliderMotion motion{};
};

}  // namespace pliant
