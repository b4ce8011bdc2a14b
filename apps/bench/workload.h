#pragma once
// The standard workloads: what is simulated, from where. All with h = 1/60 s and gravity; but for `cloth` 1 kg a vertex
// and soft pins.
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/simulation/simulation.h"

namespace pliant_bench {

enum class Kind {
  curtain,          ///< n × n vertices, one diagonal a cell, edges as springs, the two upper corners pinned
  curtain_bending,  ///< the same with bending at every interior vertex
  cloth,            ///< the same of triangle strain and hinges, 0.2 kg/m², two corners held hard
  bar,              ///< n × n × 4n cells of five tetrahedra each, as rigid as possible, one end pinned
  falling           ///< that cloth, flat above a sphere and a floor: steps with contact are measured
};

/// How vertices and elements are numbered.
enum class MeshOrder {
  rows,     ///< row by row
  shuffled  ///< at random, as meshes come from some programs
};
constexpr std::array<std::string_view, 2> choice_names(MeshOrder) {
  return {"rows", "shuffled"};
}

struct Workload {
  std::string name;
  Kind kind = Kind::curtain;
  pliant::Index size = 2;  ///< n
  pliant::Index iterations = 10;
  MeshOrder order = MeshOrder::rows;
};

/// W1, W1b, ..., W7b with their own sizes.
std::vector<Workload> standard_workloads();

/// The workloads of these names: standard ones, or `curtain`, `curtain-b`, `cloth`, `bar` and `falling`, which have
/// the given size. No names: all the standard ones, or with a size both curtains. Throws Error(input) on another name,
/// and on a name that does not go with the size.
std::vector<Workload> choose_workloads(const std::vector<std::string>& names, std::optional<pliant::Index> size);

pliant::Mesh make_mesh(const Workload& workload);

/// The corners of a curtain, the end of a bar.
std::vector<pliant::Index> pinned_vertices(const Workload& workload, const pliant::Mesh& mesh);

/// The simulation of it (not of a falling cloth, see measure_contact()), somewhat out of shape and moving, so that no
/// projection has it easier than later on.
pliant::Simulation make_simulation(const Workload& workload, pliant::Mesh mesh, pliant::SolverSettings settings);

}  // namespace pliant_bench
