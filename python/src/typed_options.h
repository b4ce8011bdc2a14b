#pragma once
// OptionType for one struct of options.
#include <cstdlib>

#include <cxxabi.h>

#include "option_types.h"
#include "pliant/constraints/attachment.h"
#include "pliant/materials/material_groups.h"
#include "pliant_io/scene/shape_options.h"

namespace pliant_python {

/// "EdgeSpring" of pliant::EdgeSpring.
template <class Options>
std::string class_name_of() {
  char* const text = abi::__cxa_demangle(typeid(Options).name(), nullptr, nullptr, nullptr);
  std::string name = text;
  std::free(text);
  return name.substr(name.rfind(':') + 1);
}

/// What Python's annotations call the type of an option.
template <class Value>
std::string annotation(const pliant::OptionInfo& info, const Value&);
inline std::string annotation(const pliant::OptionInfo&, const pliant::Real&) {
  return "float";
}
inline std::string annotation(const pliant::OptionInfo& info, const pliant::Index&) {
  return info.word.empty() ? "int" : "int | Literal[\"" + std::string(info.word) + "\"]";
}
inline std::string annotation(const pliant::OptionInfo&, const std::int64_t&) {
  return "int";
}
inline std::string annotation(const pliant::OptionInfo&, const bool&) {
  return "bool";
}
inline std::string annotation(const pliant::OptionInfo&, const std::string&) {
  return "str";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::Vec3&) {
  return "Vector";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::Values&) {
  return "Values";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::Points&) {
  return "Points";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::Ragged<pliant::Real>&) {
  return "Lists";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::Stencils&) {
  return "Stencils";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::Selection&) {
  return "Selection";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::BodyId&) {
  return "BodyId";
}
inline std::string annotation(const pliant::OptionInfo&, const std::vector<pliant::BodyId>&) {
  return "Sequence[BodyId]";
}
template <class Number, std::size_t n>
std::string annotation(const pliant::OptionInfo&, const std::array<Number, n>&) {
  return std::is_integral_v<Number> ? "Sequence[int]" : "Sequence[float]";
}
template <class Value>
std::string annotation(const pliant::OptionInfo& info, const std::optional<Value>&) {
  return annotation(info, Value{}) + " | None";
}
template <class Value>
std::string annotation(const pliant::OptionInfo&, const Value&) {
  static_assert(std::is_enum_v<Value>);
  std::string text;
  for (const std::string_view name : choice_names(Value{})) {
    text += (text.empty() ? "Literal[\"" : ", \"") + std::string(name) + "\"";
  }
  return text + "]";
}

/// Visits all that a type has, what scene files have in another form as well.
template <class Self, class Visitor>
void visit_all(Self& self, Visitor&& field) {
  using Options = std::remove_const_t<Self>;
  using pliant::OptionInfo;
  if constexpr (std::is_same_v<Options, pliant::Attachment>) {
    field(OptionInfo{"on", "", "vertices that are tied"}, self.on);
    field(OptionInfo{"to", "", "the body that they are tied to, which may be the same"}, self.to);
    field(OptionInfo{"to_on", "", "and what of it"}, self.to_on);
  }
  Options::visit(self, field);
  if constexpr (std::is_same_v<Options, pliant::BodyContact>) {
    field(OptionInfo{"ignores", "", "bodies that it does not touch"}, self.ignores);
  }
}

template <class Options>
Options read_options(const py::dict& given, const pliant::Mesh* mesh, Options options = {}) {
  const std::string owner = class_name_of<Options>();
  std::vector<std::string_view> names;
  visit_all(options, [&](const pliant::OptionInfo& info, const auto&) { names.push_back(info.name); });
  check_keywords(owner, given, names);
  visit_all(options, OptionReader{given, owner, mesh});
  pliant::check_options(owner, options);
  return options;
}

template <class Options>
py::dict options_to_python(const Options& options) {
  py::dict result;
  visit_all(options, [&](const pliant::OptionInfo& info, const auto& value) {
    result[py::str(info.name.data(), info.name.size())] = to_python(value);
  });
  return result;
}

/// A default as Python shows it; None where there is none to be named.
template <class Value>
py::object default_of(const Value& value) {
  if constexpr (std::is_same_v<Value, pliant::BodyId>) {
    return py::none();
  } else {
    return to_python(value);
  }
}

template <class Options>
class TypedOptions : public OptionType {
 public:
  std::string class_name() const override { return class_name_of<Options>(); }
  std::string kind() const override { return "settings"; }
  std::string scene_name() const override { return ""; }
  std::string summary() const override { return ""; }
  void check(const py::dict& given) const override { read_options<Options>(given, nullptr); }

  py::list fields() const override {
    py::list list;
    const Options defaults;
    visit_all(defaults, [&](const pliant::OptionInfo& info, const auto& value) {
      py::dict field;
      field["name"] = std::string(info.name);
      field["unit"] = std::string(info.unit);
      field["doc"] = std::string(info.doc);
      field["type"] = annotation(info, value);
      field["default"] = default_of(value);
      list.append(field);
    });
    return list;
  }
};

template <class Options>
class ShapeType final : public TypedOptions<Options> {
 public:
  std::string kind() const override { return "shape"; }
  std::string scene_name() const override { return std::string(Options::shape); }
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
      return "E = " + std::string(Options::info.energy) + ", z = " + std::string(Options::info.reduction) + ", p in " +
             std::string(Options::info.set) + " (" + std::string(Options::info.source) + ")";
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
