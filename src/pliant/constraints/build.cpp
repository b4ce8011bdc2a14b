#include "pliant/constraints/build.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "pliant/core/error.h"

namespace pliant {
namespace {

std::string place(std::string_view type, const BodyView& body) {
  return std::string(type) + " on body '" + std::string(body.name) + "'";
}

std::string vertex_range(const BodyView& body) {
  const Index count = body.rest.vertex_count();
  return "the body has vertices 0 to " + std::to_string(count - 1);
}

void check_stencil(std::string_view type, const BodyView& body, std::span<const Index> stencil, Index i, int vertices) {
  const std::string where = place(type, body) + ": stencil " + std::to_string(i);
  const auto size = static_cast<int>(stencil.size());
  if (vertices > 0 && size != vertices) {
    fail_input(where + " has " + std::to_string(size) + " vertices; it takes " + std::to_string(vertices));
  }
  for (std::size_t a = 0; a < stencil.size(); ++a) {
    if (stencil[a] < 0 || stencil[a] >= body.rest.vertex_count()) {
      fail_input(where + ": vertex " + std::to_string(stencil[a]) + " is out of range; " + vertex_range(body));
    }
    if (std::find(stencil.begin(), stencil.begin() + static_cast<std::ptrdiff_t>(a), stencil[a]) !=
        stencil.begin() + static_cast<std::ptrdiff_t>(a)) {
      fail_input(where + " names vertex " + std::to_string(stencil[a]) + " twice; its vertices must differ");
    }
  }
}

/// Whether there are stencils of the user's, which are checked then.
bool are_given(std::string_view type, const BodyView& body, const Selection& on, const Stencils& given, int vertices) {
  if (given.empty()) return false;
  if (!on.everything) fail_input(place(type, body) + ": has both `on` and `stencils`; keep one");
  for (Index i = 0; i < given.size(); ++i) check_stencil(type, body, given[i], i, vertices);
  return true;
}

void check_selection(std::string_view type, const BodyView& body, const Selection& on) {
  for (const Index vertex : on.vertices) {
    if (vertex >= 0 && vertex < body.rest.vertex_count()) continue;
    fail_input(place(type, body) + ": selected vertex " + std::to_string(vertex) + " is out of range; " +
               vertex_range(body));
  }
}

}  // namespace

Stencils choose_stencils(std::string_view type, const BodyView& body, const Selection& on, const Stencils& given,
                         const std::function<Stencils()>& candidates, int vertices) {
  if (are_given(type, body, on, given, vertices)) return given;
  if (on.everything) return candidates();
  check_selection(type, body, on);
  std::vector<char> selected(static_cast<std::size_t>(body.rest.vertex_count()), 0);
  for (const Index vertex : on.vertices) selected[static_cast<std::size_t>(vertex)] = 1;
  const Stencils all = candidates();
  Stencils chosen;
  for (Index i = 0; i < all.size(); ++i) {
    const bool inside =
        std::ranges::all_of(all[i], [&](Index v) { return selected[static_cast<std::size_t>(v)] != 0; });
    if (inside) chosen.add(all[i]);
  }
  return chosen;
}

Stencils choose_vertices(std::string_view type, const BodyView& body, const Selection& on, const Stencils& given) {
  if (are_given(type, body, on, given, 1)) return given;
  check_selection(type, body, on);
  std::vector<Index> vertices = on.vertices;
  if (on.everything) {
    vertices.resize(static_cast<std::size_t>(body.rest.vertex_count()));
    std::iota(vertices.begin(), vertices.end(), Index{0});
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Stencils chosen;
  for (const Index vertex : vertices) chosen.add({vertex});
  return chosen;
}

void check_length(std::string_view type, std::string_view option, std::size_t length, bool each, Index count) {
  if (!each || length == static_cast<std::size_t>(count)) return;
  fail_input(std::string(type) + ": " + std::string(option) + " has " + std::to_string(length) + " entries for " +
             std::to_string(count) + " constraints; give one for all, or one each");
}

Values of_stencils(std::string_view type, const BodyView& body, std::string_view option, const Values& values,
                   const Stencils& stencils) {
  if (!values.of_vertices()) {
    check_length(type, option, values, stencils.size());
    return values;
  }
  if (values.list().size() != static_cast<std::size_t>(body.rest.vertex_count())) {
    fail_input(fmt::format("{}: {} has {} values for {} vertices; give one for each vertex", place(type, body), option,
                           values.list().size(), body.rest.vertex_count()));
  }
  std::vector<Real> means;
  means.reserve(static_cast<std::size_t>(stencils.size()));
  for (Index i = 0; i < stencils.size(); ++i) {
    Real sum = 0;
    for (const Index vertex : stencils[i]) sum += values[vertex];
    means.push_back(sum / static_cast<Real>(stencils[i].size()));
  }
  return Values(std::move(means));
}

namespace {

/// For an option that cannot do without.
void check_given(std::string_view option, const Values& values) {
  if (values.each() || !values.empty()) return;
  fail_input(std::string(option) + ": empty; give one for all constraints, or one each");
}

}  // namespace

StiffnessSplit::StiffnessSplit(std::string_view type, const BodyView& body, const Values& stiffness,
                               const Stencils& stencils)
    : values_(of_stencils(type, body, "stiffness", stiffness, stencils)) {
  check_given("stiffness", values_);
}

FilledShares::FilledShares(const Mesh& mesh) {
  for (std::size_t t = 0; t < mesh.embedding.filled.size(); ++t) {
    if (mesh.embedding.filled[t] == 1) continue;
    Tetrahedron sorted = mesh.tetrahedra[t];
    std::ranges::sort(sorted);
    shares_.emplace(sorted, mesh.embedding.filled[t]);
  }
}

Real FilledShares::of(std::span<const Index> stencil) const {
  if (shares_.empty() || stencil.size() != 4) return 1;
  Tetrahedron sorted{};
  std::ranges::copy(stencil, sorted.begin());
  std::ranges::sort(sorted);
  const auto found = shares_.find(sorted);
  return found == shares_.end() ? 1 : found->second;
}

Limits::Limits(std::string_view type, const BodyView& body, std::string_view of, const Values& min, const Values& max,
               const Stencils& stencils) {
  const std::string name_of_min = fmt::format("min_{}", of), name_of_max = fmt::format("max_{}", of);
  min_ = of_stencils(type, body, name_of_min, min, stencils);
  max_ = of_stencils(type, body, name_of_max, max, stencils);
  check_given(name_of_min, min_);
  check_given(name_of_max, max_);
  for (Index i = 0; i < stencils.size(); ++i) {
    if (min_[i] <= max_[i]) continue;
    fail_input(fmt::format("{}: {} {} is above {} {} at constraint {}; swap them", type, name_of_min, min_[i],
                           name_of_max, max_[i], i));
  }
}

void check_rest_measure(std::string_view type, const BodyView& body, Index i, Real measure, std::string_view remedy) {
  if (measure > 0 && std::isfinite(measure)) return;
  fail_input(place(type, body) + ": element " + std::to_string(i) + " has no positive rest " + std::string(remedy));
}

std::vector<Index> global_stencil(const BodyView& body, std::span<const Index> stencil) {
  std::vector<Index> moved(stencil.begin(), stencil.end());
  for (Index& vertex : moved) vertex += body.first_vertex;
  return moved;
}

ConstraintSet one_batch(std::unique_ptr<ConstraintGroup> group) {
  ConstraintSet set;
  set.count = group->shape().count;
  if (set.count > 0) set.batches.push_back(std::move(group));
  return set;
}

}  // namespace pliant
