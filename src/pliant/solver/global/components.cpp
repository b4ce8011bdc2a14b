#include "pliant/solver/global/components.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pliant {
namespace {

/// Whether a force brings it: it holds nothing.
bool is_of_force(ConstraintGroup& group) {
  return group.is_external() && group.targets().empty();
}

/// Marks the vertices of constraints that a translation does not leave as they are.
void mark_anchored(ConstraintGroup& group, std::vector<char>& is_anchored) {
  if (is_of_force(group)) return;
  const GroupShape shape = group.shape();
  const auto n = static_cast<std::size_t>(shape.vertices), rows = static_cast<std::size_t>(shape.rows);
  const std::span<const Real> reduction = group.reduction();
  const std::span<const Index> stencil = group.stencil();
  for (std::size_t i = 0; i < at(shape.count); ++i) {
    bool holds = false;
    for (std::size_t r = 0; r < rows; ++r) {
      Real sum = 0, size = 0;
      for (const Real coefficient : reduction.subspan((i * rows + r) * n, n)) {
        sum += coefficient;
        size += std::abs(coefficient);
      }
      holds = holds || std::abs(sum) > 1e-6 * size;
    }
    if (!holds) continue;
    for (const Index vertex : stencil.subspan(i * n, n)) is_anchored[at(vertex)] = 1;
  }
}

/// The lowest vertex that each one is connected with.
std::vector<Index> find_roots(const LowerMatrix& matrix) {
  std::vector<Index> parent(at(matrix.size()));
  std::iota(parent.begin(), parent.end(), Index{0});
  const auto root_of = [&](Index vertex) {
    while (parent[at(vertex)] != vertex) vertex = parent[at(vertex)] = parent[at(parent[at(vertex)])];
    return vertex;
  };
  for_each_entry(matrix, [&](Index row, Index column, std::size_t) {
    const Index a = root_of(column);
    const Index b = root_of(row);
    parent[at(std::max(a, b))] = std::min(a, b);
  });
  for (Index vertex = 0; vertex < matrix.size(); ++vertex) parent[at(vertex)] = root_of(vertex);
  return parent;
}

/// Those that have none of these vertices.
Components without(const Components& components, std::span<const char> is_marked) {
  Components rest;
  for (std::size_t i = 0; i < components.count(); ++i) {
    const std::span<const Index> component = components.component(i);
    if (std::ranges::any_of(component, [&](Index vertex) { return is_marked[at(vertex)] != 0; })) continue;
    rest.vertices.insert(rest.vertices.end(), component.begin(), component.end());
    rest.starts.push_back(rest.vertices.size());
  }
  return rest;
}

}  // namespace

Components find_components(const LowerMatrix& matrix) {
  const std::vector<Index> roots = find_roots(matrix);
  Components components;
  std::vector<std::size_t> next(roots.size(), 0);  // of the component of a root
  for (const Index root : roots) ++next[at(root)];
  for (std::size_t& place : next) {
    if (place == 0) continue;
    const std::size_t first = components.starts.back();
    components.starts.push_back(first + place);
    place = first;
  }
  components.vertices.resize(roots.size());
  for (std::size_t i = 0; i < roots.size(); ++i) components.vertices[next[at(roots[i])]++] = static_cast<Index>(i);
  return components;
}

std::vector<Index> component_of_vertex(const Components& components) {
  std::vector<Index> owners(components.vertices.size());
  for (std::size_t i = 0; i < components.count(); ++i) {
    for (const Index v : components.component(i)) owners[at(v)] = static_cast<Index>(i);
  }
  return owners;
}

Components find_free_components(const Components& components, std::span<ConstraintGroup* const> groups,
                                std::span<const char> is_pinned) {
  Components free = without(components, is_pinned);
  if (free.count() == 0) return free;
  std::vector<char> is_anchored(is_pinned.begin(), is_pinned.end());
  for (ConstraintGroup* group : groups) mark_anchored(*group, is_anchored);
  return without(free, is_anchored);
}

std::vector<RigidFreedom> find_freedom(const Components& free, std::span<ConstraintGroup* const> groups) {
  std::vector<RigidFreedom> of_vertices;
  for (ConstraintGroup* group : groups) {
    if (group->is_rotation_invariant()) continue;
    const RigidFreedom most = is_of_force(*group) ? RigidFreedom::none : RigidFreedom::translations;
    for (const Index vertex : group->stencil()) {
      if (at(vertex) >= of_vertices.size()) of_vertices.resize(at(vertex) + 1, RigidFreedom::all);
      of_vertices[at(vertex)] = std::min(of_vertices[at(vertex)], most);
    }
  }
  std::vector<RigidFreedom> freedom(free.count(), RigidFreedom::all);
  for (std::size_t i = 0; i < free.count(); ++i) {
    for (const Index vertex : free.component(i)) {
      if (at(vertex) < of_vertices.size()) freedom[i] = std::min(freedom[i], of_vertices[at(vertex)]);
    }
  }
  return freedom;
}

}  // namespace pliant
