#pragma once
// Steps that the builders of several constraint types share.
#include "pliant/constraints/constraint_set.h"

namespace pliant {

/// The stencils given, checked (n vertices each, in range, none twice), or those of `candidates` that lie in `on`.
/// Throws Error(input) that names the type, the body, the constraint and the remedy.
Stencils choose_stencils(std::string_view type, const BodyView& body, const Selection& on, const Stencils& given,
                         const Stencils& candidates, int vertices);

/// Throws unless `values` is a single value or has one for each of `count` constraints.
void check_length(std::string_view type, std::string_view option, std::size_t length, bool each, Index count);

/// The same for Values and Points.
template <class List>
void check_length(std::string_view type, std::string_view option, const List& list, Index count) {
  check_length(type, option, list.list().size(), list.each(), count);
}

/// Every vertex as a stencil of its own.
Stencils every_vertex(const BodyView& body);

/// Vertices of the body that are selected: one flag each. Throws on an index out of range.
std::vector<char> selected_vertices(std::string_view type, const BodyView& body, const Selection& on);

/// Throws unless 0 ≤ min ≤ max for each of `count` constraints.
void check_limits(std::string_view type, const Values& min_stretch, const Values& max_stretch, Index count);

/// Throws unless the area or volume of element i at rest is positive and finite; `remedy` begins with its name.
void check_rest_measure(std::string_view type, const BodyView& body, Index i, Real measure, std::string_view remedy);

/// Throws when there is no value at all, for an option that cannot do without.
void check_given(std::string_view option, const Values& values);

/// Stiffness as a group has it: the common factor, and the factor of constraint i that goes into its measure.
struct StiffnessSplit {
  explicit StiffnessSplit(const Values& stiffness) : values(stiffness) { check_given("stiffness", stiffness); }
  Real common() const { return values.each() ? 1 : values[0]; }
  Real of(Index i) const { return values.each() ? values[i] : 1; }
  const Values& values;
};

/// The stencil moved from the body's own indices to those of the simulation.
std::vector<Index> global_stencil(const BodyView& body, std::span<const Index> stencil);

/// A set of one part.
ConstraintSet one_part(std::unique_ptr<ConstraintGroup> group);

template <class Element>
Stencils to_stencils(const std::vector<Element>& elements) {
  Stencils stencils{};
  stencils.values.reserve(elements.size() * std::tuple_size_v<Element>);
  stencils.offsets.reserve(elements.size() + 1);
  for (const Element& element : elements) stencils.add(element);
  return stencils;
}

}  // namespace pliant
