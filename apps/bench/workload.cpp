#include "bench/workload.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "pliant/core/printable.h"
#include "pliant/pliant.h"
#include "pliant_io/scene/nearest_names.h"

namespace pliant_bench {
namespace {

using namespace pliant;

constexpr Index smallest_size = 3;  // a curtain has an interior vertex
constexpr Index largest_size = 4000;

std::vector<Workload> workloads_of_size(Index size) {
  return {{"curtain", Kind::curtain, size, 10},
          {"curtain-b", Kind::curtain_bending, size, 10},
          {"cloth", Kind::cloth, size, 10},
          {"bar", Kind::bar, size, 10},
          {"falling", Kind::falling, size, 10}};
}

/// Waves along the body and a turn, a tenth of its size.
Positions deformed(const Positions& rest, Real extent) {
  Positions x = rest;
  for (Index i = 0; i < static_cast<Index>(x.rows()); ++i) {
    const Real u = rest(i, 0) / extent;
    const Real v = rest(i, 2) / extent;
    x(i, 0) += 0.03 * extent * std::sin(5 * v);
    x(i, 1) += 0.05 * extent * std::sin(7 * u + 3 * v);
    x(i, 2) += 0.04 * extent * std::cos(6 * u - 2 * v);
  }
  return x;
}

/// The number that each vertex of a mesh gets: a permutation that is the same on every machine.
std::vector<Index> shuffled_numbers(Index count) {
  std::vector<Index> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  std::mt19937 random(1);
  for (std::size_t i = numbers.size(); i > 1; --i) std::swap(numbers[i - 1], numbers[random() % i]);
  return numbers;
}

template <class Element>
void shuffle_elements(std::vector<Element>& elements, const std::vector<Index>& numbers) {
  const std::vector<Index> places = shuffled_numbers(static_cast<Index>(elements.size()));
  const std::vector<Element> before = elements;
  for (std::size_t i = 0; i < before.size(); ++i) {
    Element& element = elements[static_cast<std::size_t>(places[i])];
    element = before[i];
    for (Index& vertex : element) vertex = numbers[static_cast<std::size_t>(vertex)];
  }
}

/// The shape alone, without faces and names.
Mesh shuffled(const Mesh& mesh) {
  const std::vector<Index> numbers = shuffled_numbers(mesh.vertex_count());
  Mesh result;
  result.vertices.resize(mesh.vertices.rows(), 3);
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    result.vertices.row(numbers[static_cast<std::size_t>(i)]) = mesh.vertices.row(i);
  }
  result.triangles = mesh.triangles;
  result.tetrahedra = mesh.tetrahedra;
  shuffle_elements(result.triangles, numbers);
  shuffle_elements(result.tetrahedra, numbers);
  return result;
}

}  // namespace

std::vector<Workload> standard_workloads() {
  return {{"W1", Kind::curtain, 32, 5},   {"W1b", Kind::curtain_bending, 32, 5},
          {"W2", Kind::curtain, 100, 10}, {"W2b", Kind::curtain_bending, 100, 10},
          {"W3", Kind::curtain, 316, 10}, {"W3b", Kind::curtain_bending, 316, 10},
          {"W4", Kind::bar, 10, 10},      {"W5", Kind::cloth, 100, 10},
          {"W6", Kind::cloth, 316, 10},   {"W7a", Kind::falling, 40, 10},
          {"W7b", Kind::falling, 100, 10}};
}

std::vector<Workload> choose_workloads(const std::vector<std::string>& names, std::optional<Index> size) {
  if (size && (*size < smallest_size || *size > largest_size)) {
    fail_input("--size: " + std::to_string(*size) + " is out of range; give " + std::to_string(smallest_size) + " to " +
               std::to_string(largest_size) + " vertices along a side");
  }
  const std::vector<Workload> sized = workloads_of_size(size.value_or(smallest_size));
  const std::vector<Workload> fixed = standard_workloads();
  if (names.empty()) return size ? std::vector<Workload>{sized[0], sized[1]} : fixed;
  std::vector<std::string_view> known;
  for (const Workload& workload : fixed) known.push_back(workload.name);
  for (const Workload& workload : sized) known.push_back(workload.name);
  std::vector<Workload> chosen;
  for (const std::string& name : names) {
    const auto is_named = [&name](const Workload& workload) { return workload.name == name; };
    const auto in_fixed = std::ranges::find_if(fixed, is_named);
    const auto in_sized = std::ranges::find_if(sized, is_named);
    if (in_fixed == fixed.end() && in_sized == sized.end()) {
      fail_input("--workloads: there is no '" + printable(name) + "'; " + suggestion_text(name, known));
    }
    if (in_fixed != fixed.end() && size) {
      fail_input("--workloads: " + name +
                 " has a size of its own; with --size give curtain, curtain-b, cloth, bar or falling");
    }
    if (in_sized != sized.end() && !size) fail_input("--workloads: " + name + " needs its size; give --size as well");
    chosen.push_back(in_fixed != fixed.end() ? *in_fixed : *in_sized);
  }
  return chosen;
}

std::vector<Index> pinned_vertices(const Workload& workload, const Mesh& mesh) {
  const Index count = mesh.vertex_count();
  if (workload.kind != Kind::bar) {
    std::vector<Index> corners = {count - workload.size, count - 1};
    if (workload.order == MeshOrder::shuffled) {
      const std::vector<Index> numbers = shuffled_numbers(count);
      for (Index& corner : corners) corner = numbers[static_cast<std::size_t>(corner)];
    }
    return corners;
  }
  std::vector<Index> end;
  for (Index i = 0; i < count; ++i) {
    if (mesh.vertices(i, 0) == 0) end.push_back(i);
  }
  return end;
}

Mesh make_mesh(const Workload& workload) {
  const Index n = workload.size;
  Mesh mesh = workload.kind != Kind::bar
                  ? grid({.columns = n,
                          .rows = n,
                          .size = {1, 1},
                          .plane = workload.kind == Kind::falling ? Plane::xy : Plane::xz})
                  : bar({.cells = {4 * n, n, n}, .size = {4, 1, 1}, .cut = TetrahedronCut::five});
  return workload.order == MeshOrder::shuffled ? shuffled(mesh) : mesh;
}

Simulation make_simulation(const Workload& workload, Mesh mesh, SolverSettings settings) {
  settings.iterations = workload.iterations;
  Simulation simulation(settings);
  const Real extent = workload.kind == Kind::bar ? 4 : 1;
  const std::vector<Index> pinned = pinned_vertices(workload, mesh);
  Positions start = deformed(mesh.vertices, extent);
  Positions velocities = start - mesh.vertices;  // as if it had taken a second
  const bool is_cloth = workload.kind == Kind::cloth;
  const BodyId body = simulation.add_body(std::move(mesh), is_cloth ? Mass::area_density(0.2) : Mass::per_vertex(1),
                                          {.start = std::move(start), .velocities = std::move(velocities)});
  simulation.add(Gravity{});
  if (is_cloth) {
    simulation.add(body, TriangleStrain{.stiffness = 1e3});
    simulation.add(body, HingeBending{.stiffness = 1e-5});
    simulation.add(body, Position{.on = pinned});
    return simulation;
  }
  if (workload.kind == Kind::bar) {
    simulation.add(body, TetrahedronStrain{.stiffness = 1e5});
  } else {
    simulation.add(body, EdgeSpring{.stiffness = 1e3});
  }
  if (workload.kind == Kind::curtain_bending) simulation.add(body, Bending{.stiffness = 1e-3});
  simulation.add(body, Position{.on = pinned, .hold = Hold::soft, .stiffness = 1e6});
  return simulation;
}

}  // namespace pliant_bench
