#pragma once
// OptionType for what a simulation takes, and for shapes.
#include "pliant_io/scene/shape_options.h"
#include "typed_options.h"

namespace pliant_python {

template <class Options>
class ShapeType final : public TypedOptions<Options> {
 public:
  std::string kind() const override { return "shape"; }
  std::string scene_name() const override { return std::string(Options::shape); }
  std::string summary() const override { return std::string(Options::summary); }
  pliant::Mesh mesh(const py::dict& given) const override { return make_shape(read_options<Options>(given, nullptr)); }
};

/// Groups, forces and colliders: the facade has the same calls for each of them.
template <class Options>
class AddedType final : public TypedOptions<Options> {
 public:
  static constexpr bool is_force = pliant::describes_force<Options>;
  static constexpr bool is_collider = pliant::describes_collider<Options>;
  using Id = std::conditional_t<is_force, pliant::ForceId,
                                std::conditional_t<is_collider, pliant::ColliderId, pliant::GroupId>>;

  std::string kind() const override { return is_force ? "force" : is_collider ? "collider" : "constraint"; }
  std::string scene_name() const override { return std::string(Options::info.name); }
  std::string summary() const override {
    if constexpr (is_force || is_collider) {
      return std::string(Options::info.formula);
    } else {
      const bool projects = Options::info.set != pliant::no_set;
      return "E = " + std::string(Options::info.energy) + ", z = " + std::string(Options::info.reduction) +
             (projects ? ", p in " + std::string(Options::info.set) : "") + " (" + std::string(Options::info.source) +
             ")";
    }
  }

  pliant::Index add(pliant::Simulation& simulation, std::optional<pliant::BodyId> body, const py::dict& given,
                    const std::string& name) const override {
    if constexpr (is_collider) {
      return static_cast<pliant::Index>(simulation.add(read_options<Options>(given, nullptr), name));
    } else if constexpr (is_force) {
      return static_cast<pliant::Index>(simulation.add(body, read_of(simulation, body, given), name));
    } else {
      if (!body) pliant::fail_input(class_name_of<Options>() + ": on no body; write add(body, ...)");
      return static_cast<pliant::Index>(simulation.add(*body, read_of(simulation, body, given), name));
    }
  }

  void replace(pliant::Simulation& simulation, pliant::Index number, const py::dict& given) const override {
    const Id id{number};
    if constexpr (is_collider) {
      simulation.replace(id, read_options<Options>(given, nullptr));
    } else {
      std::optional<pliant::BodyId> body;
      if constexpr (is_force) {
        const pliant::ForceScope scope = simulation.scope(id);
        for (std::size_t i = 0; !scope.is_whole && i < simulation.bodies().size(); ++i) {
          if (simulation.bodies()[i].first_vertex == scope.bodies.front().first_vertex) {
            body = pliant::BodyId{static_cast<pliant::Index>(i)};
          }
        }
      } else if (const auto found = simulation.groups().find(id); found != simulation.groups().end()) {
        body = found->second.body;
      }
      simulation.replace(id, read_of(simulation, body, given));
    }
  }

  py::object options(const pliant::Simulation& simulation, pliant::Index number) const override {
    const auto found = simulation.template options<Options>(Id{number});
    return found ? py::object(options_to_python(*found)) : py::none();
  }

 private:
  /// What selections are of: the mesh of the body; of no body, that of the only one.
  static Options read_of(const pliant::Simulation& simulation, std::optional<pliant::BodyId> body,
                         const py::dict& given) {
    if (!body && simulation.bodies().size() == 1) body = pliant::BodyId{};
    const pliant::Mesh* const mesh = body ? &simulation.body(*body).mesh : nullptr;
    Options options = read_options<Options>(given, mesh);
    if constexpr (std::is_same_v<Options, pliant::Attachment>) {
      const py::str name("to_on");
      const py::str to("to");
      if (!given.contains(to)) pliant::fail_input("Attachment: to: missing; give the body that it is tied to");
      const pliant::OptionInfo info{"to_on", "", ""};
      if (given.contains(name)) {
        read(Place{"Attachment", info, &simulation.body(options.to).mesh}, given[name], options.to_on);
      }
    }
    return options;
  }
};

}  // namespace pliant_python
