#include "pliant_io/checkpoint/detail/read_state.h"

#include <algorithm>
#include <cmath>

#include "pliant/core/printable.h"
#include "pliant_io/checkpoint/detail/read_values.h"
#include "pliant_io/scene/scene.h"

namespace pliant {
namespace {

void read_rows(const Node& node, Positions& positions, Positions& velocities) {
  for (const auto& [key, rows] : {std::pair{"positions", &positions}, {"velocities", &velocities}}) {
    read_numbers(node.require(key), {rows->data(), static_cast<std::size_t>(rows->size())});
  }
}

Pose read_pose(const Node& node) {
  Pose pose;
  read_numbers(node.require("position"), {pose.position.data(), 3});
  read_rotation(node.require("rotation"), pose.rotation);
  return pose;
}

/// What friction remembers, of so many contacts as the list of vertices has.
std::vector<ContactMemory> read_memory(const Node& node) {
  const Node vertices = node.require("vertices");
  const Node touched = node.require("touched");
  vertices.require_list();
  touched.require_list(vertices.size(), "(one a contact)");
  std::vector<Real> numbers(4 * vertices.size());
  read_numbers(node.require("anchors_and_loads"), numbers);
  std::vector<ContactMemory> memory(vertices.size());
  for (std::size_t i = 0; i < memory.size(); ++i) {
    read(vertices[i], memory[i].vertex);
    read(touched[i], memory[i].collider);
    memory[i].anchor = {numbers[4 * i], numbers[4 * i + 1], numbers[4 * i + 2]};
    memory[i].load = numbers[4 * i + 3];
  }
  return memory;
}

/// What friction remembers of pairs of surfaces.
std::vector<PairMemory> read_pairs(const Node& node) {
  const Node features = node.require("pairs");
  features.require_list();
  if (features.size() % 3 != 0) features.fail("has no three numbers for each pair; take another checkpoint");
  std::vector<PairMemory> pairs(features.size() / 3);
  std::vector<Real> slides(features.size());
  read_numbers(node.require("slides"), slides);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Index kind = 0;
    read(features[3 * i], kind);
    if (kind < 0 || kind > static_cast<Index>(PairKind::vertex_edge)) {
      features.fail(fmt::format("has the kind {}; take another checkpoint", kind));
    }
    pairs[i].kind = static_cast<PairKind>(kind);
    read(features[3 * i + 1], pairs[i].features[0]);
    read(features[3 * i + 2], pairs[i].features[1]);
    pairs[i].slide = {slides[3 * i], slides[3 * i + 1], slides[3 * i + 2]};
  }
  return pairs;
}

/// A list of so many numbers for each thing; calls visit(numbers) with those of one.
template <std::size_t count, class Visit>
void for_each_of(const Node& list, Visit&& visit) {
  list.require_list();
  if (list.size() % count != 0) list.fail(fmt::format("has no {} numbers for each; take another checkpoint", count));
  for (std::size_t i = 0; i < list.size(); i += count) {
    std::array<Index, count> numbers{};
    for (std::size_t j = 0; j < count; ++j) read(list[i + j], numbers[j]);
    visit(numbers);
  }
}

LetGoState read_let_go(const Node& node) {
  LetGoState let_go;
  read(node.require("is_known"), let_go.is_known);
  for_each_of<3>(node.require("pairs"), [&](const auto& numbers) {
    let_go.pairs.push_back({{numbers[0], numbers[1]}, numbers[2] != 0});
  });
  for_each_of<2>(node.require("reduced"), [&](const auto& numbers) {
    let_go.reduced.push_back({numbers[0], numbers[1], 0});
  });
  std::vector<Real> shares(let_go.reduced.size());
  read_numbers(node.require("shares"), shares);
  for (std::size_t i = 0; i < shares.size(); ++i) let_go.reduced[i].share = shares[i];
  for_each_of<2>(node.require("held_up"), [&](const auto& numbers) {
    let_go.held_up.push_back({numbers[0], numbers[1]});
  });
  return let_go;
}

ContactState read_contact(const Node& node, const State& fresh) {
  constexpr Index most_light_steps = 1000;
  ContactState contact;
  for_each(node.require("colliders"), [&](const Node& entry) {
    ColliderState& collider = contact.colliders.emplace_back();
    read(entry.require("collider"), collider.collider);
    collider.pose = read_pose(entry.require("pose"));
    if (const auto target = entry.find("target")) collider.target = read_pose(*target);
  });
  contact.memory = read_memory(node);
  contact.pairs = read_pairs(node);
  if (const auto let_go = node.find("let_go")) contact.let_go = read_let_go(*let_go);
  const auto read_of_vertices = [&](const Node& entry, std::vector<Real>& numbers) {
    if (!entry.is_bytes() || !entry.bytes().empty()) numbers.resize(fresh.masses.size());
    read_numbers(entry, numbers);
  };
  read_of_vertices(node.require("stiffening"), contact.stiffening);
  read_of_vertices(node.require("in_factor"), contact.in_factor);
  if (const auto energies = node.find("energies")) read_of_vertices(*energies, contact.energies);
  read(node.require("light_steps"), contact.light_steps);
  if (contact.light_steps < 0 || contact.light_steps > most_light_steps) {
    node.require("light_steps").fail(fmt::format("{} is out of range; take another checkpoint", contact.light_steps));
  }
  return contact;
}

}  // namespace

std::vector<BatchNumbers> read_groups(const Node& list, const Simulation& simulation) {
  list.require_list();
  if (list.size() != simulation.groups().size()) {
    list.fail(fmt::format("{} groups of constraints, where the simulation has {}; add again what the program had added",
                          list.size(), simulation.groups().size()));
  }
  std::vector<BatchNumbers> all;
  std::size_t i = 0;
  for (const auto& [id, group] : simulation.groups()) {
    const Node node = list[i++];
    if (read_bytes(node.require("name")) != group.name) {
      node.fail(fmt::format("the simulation has the group '{}' here; make it as it was", printable(group.name)));
    }
    const Node batches = node.require("batches");
    batches.require_list(group.set.batches.size(), "(one a batch)");
    for (std::size_t p = 0; p < group.set.batches.size(); ++p) {
      BatchNumbers& numbers = all.emplace_back();
      numbers.batch = group.set.batches[p].get();
      numbers.parameters.resize(numbers.batch->parameters().size());
      read_numbers(batches[p].require("parameters"), numbers.parameters);
      if (const auto is_beside = batches[p].find("is_beside_factor")) read(*is_beside, numbers.is_beside_factor);
      const Node stiffness = batches[p].require("stiffness");
      numbers.stiffness = read_real(stiffness);
      if (!(numbers.stiffness > 0) || !std::isfinite(numbers.stiffness)) {
        stiffness.fail(fmt::format("{} is not a stiffness; take another checkpoint", numbers.stiffness));
      }
    }
  }
  return all;
}

void set_numbers(const std::vector<BatchNumbers>& all) {
  for (const BatchNumbers& numbers : all) {
    numbers.batch->set_beside_factor(numbers.is_beside_factor);
    numbers.batch->set_stiffness(numbers.stiffness);
    std::ranges::copy(numbers.parameters, numbers.batch->parameters().begin());
  }
}

State read_state(const Node& node, const State& fresh) {
  State state;  // what the file leaves out is as at a start, whatever the simulation has done since
  state.masses = fresh.masses;
  for (Positions* rows : {&state.positions, &state.velocities}) rows->resizeLike(fresh.positions);
  read(node.require("step"), state.step);
  if (state.step < 0 || state.step > max_steps) {
    node.require("step").fail(fmt::format("{} is out of range; take another checkpoint", state.step));
  }
  state.time = read_real(node.require("time"));
  state.time_excess = read_real(node.require("time_excess"));
  read_rows(node, state.positions, state.velocities);
  if (const auto previous = node.find("previous")) {
    state.previous_time_step = read_real(previous->require("time_step"));
    for (Positions* rows : {&state.previous_positions, &state.previous_velocities}) rows->resizeLike(state.positions);
    read_rows(*previous, state.previous_positions, state.previous_velocities);
  }
  if (const auto iterations = node.find("iterations")) {
    read(*iterations, state.iterations);
    if (state.iterations < 1) iterations->fail("not 1 or more; take another checkpoint");
  }
  if (const auto changed = node.find("changed_step")) {
    read(*changed, state.changed_step);
    if (state.changed_step < 1 || state.changed_step > state.step + change_gap) {
      changed->fail(fmt::format("{} is out of range; take another checkpoint", state.changed_step));
    }
  }
  if (const auto contact = node.find("contact")) state.contact = read_contact(*contact, fresh);
  if (const auto surplus = node.find("energy_surplus")) {
    state.energy_surplus.resize(state.masses.size());
    read_numbers(*surplus, state.energy_surplus);
  }
  return state;
}

}  // namespace pliant
