#pragma once
// What a type of force is to people, and what its builder gets. A force as a user asks for it is a struct of options
// with an `info` and a `visit` (core/options.h), and a function
//
//     std::unique_ptr<Force> build(const ForceScope& scope, const Options& options);
//
// that throws Error(input) on options out of their range. The built-in ones are listed in forces/builtin.h.
#include <concepts>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "pliant/core/options.h"
#include "pliant/forces/force.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

/// What a force is on where no body is named: the only one, or all that there are.
enum class ForceReach { body, bodies };

/// One type of force, for people.
struct ForceInfo {
  std::string_view name;  ///< in scene files
  std::string_view formula;
  std::string_view source;
  ForceReach reach = ForceReach::body;
  std::string_view required{};  ///< option that has no default; empty: each has one
};

/// A body as the builders of forces see it.
struct ForceBody {
  const Mesh& rest;
  Index first_vertex;  ///< of this body among all vertices of the simulation
  std::string_view name;
};

/// What a force is asked to act on.
struct ForceScope {
  std::vector<ForceBody> bodies;
  bool is_whole = false;  ///< no body was named: these are all that there are so far
};

/// The one body of a force that acts on one. Throws Error(input) that names the type when there are none or several.
const ForceBody& only_body(std::string_view type, const ForceScope& scope);

/// The selected vertices of that body with the indices of the simulation. Throws Error(input) on one out of range.
std::vector<Index> selected_vertices(std::string_view type, const ForceScope& scope, const Selection& on);

/// Options of a force: what the facade and the scene files take in a list of any length.
template <class Options>
concept describes_force = requires {
  { Options::info.name } -> std::convertible_to<std::string_view>;
  { Options::info.reach } -> std::convertible_to<ForceReach>;
};

}  // namespace pliant
