#pragma once
// The options that a group, a force or a collider was made of, whatever their type: how they are listed and changed by
// who does not know it.
#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "pliant/collision/colliders/collider.h"
#include "pliant/constraints/constraint_set.h"
#include "pliant/core/option_visitors.h"
#include "pliant/forces/force_options.h"

namespace pliant {

class Simulation;
struct Group;

enum class BodyId : Index {};
enum class GroupId : Index {};
enum class ForceId : Index {};
enum class ColliderId : Index {};

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

using SeeBody = std::function<BodyView(BodyId)>;

/// The options that something was made of, whatever their type.
class AnyOptions {
 public:
  virtual ~AnyOptions() = default;
  virtual void list(OptionLister& lister) const = 0;
  /// Of constraints, the stiffness that is the common factor of a group, and anchors_in(); null for a type without.
  virtual const Values* stiffness() const = 0;
  virtual const Points* anchors() const = 0;
  /// A group of these on a body, given how to see one; none of what makes no constraints.
  virtual std::optional<Group> make_group(BodyId id, std::string name, const SeeBody& see) const = 0;
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
  std::optional<Group> make_group(BodyId id, std::string name, const SeeBody& see) const override;
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

}  // namespace pliant
