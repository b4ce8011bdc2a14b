#pragma once
// Steps that the builders of several constraint types share.
#include <functional>
#include <map>

#include "pliant/constraints/constraint_set.h"

namespace pliant {

/// The stencils given, checked (n vertices each, in range, none twice), or those of `candidates`, which is called for
/// nothing else, that lie in `on`. Throws Error(input) that names the type, the body, the constraint and the remedy.
Stencils choose_stencils(std::string_view type, const BodyView& body, const Selection& on, const Stencils& given,
                         const std::function<Stencils()>& candidates, int vertices);

/// The stencils given, checked as above, or the vertices in `on`, each a stencil of its own: in ascending order, in
/// time proportional to their number and not to the mesh, so that a mesh may have as many groups as vertices.
Stencils choose_vertices(std::string_view type, const BodyView& body, const Selection& on, const Stencils& given);

/// Throws unless `values` is a single value or has one for each of `count` constraints.
void check_length(std::string_view type, std::string_view option, std::size_t length, bool each, Index count);

/// The same for Values and Points.
template <class List>
void check_length(std::string_view type, std::string_view option, const List& list, Index count) {
  check_length(type, option, list.list().size(), list.each(), count);
}

/// Throws unless the area or volume of element i at rest is positive and finite; `remedy` begins with its name.
void check_rest_measure(std::string_view type, const BodyView& body, Index i, Real measure, std::string_view remedy);

/// The values as the constraints on these stencils have them: means of what is given for each vertex. Throws unless one
/// is for all, or there are as many as constraints, or as vertices.
Values of_stencils(std::string_view type, const BodyView& body, std::string_view option, const Values& values,
                   const Stencils& stencils);

/// Stiffness as a group has it: the common factor, and the factor of constraint i that goes into its measure.
class StiffnessSplit {
 public:
  /// Throws as of_stencils, and when there is none.
  StiffnessSplit(std::string_view type, const BodyView& body, const Values& stiffness, const Stencils& stencils);
  Real common() const { return values_.each() ? 1 : values_[0]; }
  Real of(Index i) const { return values_.each() ? values_[i] : 1; }

 private:
  Values values_;
};

/// How much of the tetrahedra of a mesh is inside the surface that they carry.
class FilledShares {
 public:
  explicit FilledShares(const Mesh& mesh);
  /// 1 of what is no tetrahedron of the mesh, and of all where they carry nothing. Vertices in any order.
  Real of(std::span<const Index> stencil) const;

 private:
  std::map<Tetrahedron, Real> shares_;  ///< by vertices in rising order; those below 1
};

/// The smallest and the largest stretch, area or volume of each constraint.
class Limits {
 public:
  /// `of` is "stretch" where the options are min_stretch and max_stretch. Throws as of_stencils, when there is none,
  /// and unless min ≤ max for each constraint.
  Limits(std::string_view type, const BodyView& body, std::string_view of, const Values& min, const Values& max,
         const Stencils& stencils);
  std::array<Real, 2> operator[](Index i) const { return {min_[i], max_[i]}; }

 private:
  Values min_;
  Values max_;
};

/// The stencil moved from the body's own indices to those of the simulation.
std::vector<Index> global_stencil(const BodyView& body, std::span<const Index> stencil);

/// A set of one batch.
ConstraintSet one_batch(std::unique_ptr<ConstraintGroup> group);

template <class Element>
Stencils to_stencils(const std::vector<Element>& elements) {
  Stencils stencils{};
  stencils.values.reserve(elements.size() * std::tuple_size_v<Element>);
  stencils.offsets.reserve(elements.size() + 1);
  for (const Element& element : elements) stencils.add(element);
  return stencils;
}

}  // namespace pliant
