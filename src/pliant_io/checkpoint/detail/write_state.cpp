#include "pliant_io/checkpoint/detail/write_state.h"

#include "pliant_io/checkpoint/detail/write_values.h"

namespace pliant {

using Json = nlohmann::json;

namespace {

Json write_pose(const Pose& pose) {
  return {{"position", bytes_of(pose.position)},
          {"rotation", bytes_of(std::span<const Real>(pose.rotation.coeffs().data(), 4))}};
}

Json write_let_go(const LetGoState& let_go) {
  std::vector<Index> pairs;  // of each two vertices, and whether one was held up
  for (const LetGoVertices& each : let_go.pairs) {
    pairs.insert(pairs.end(), {each.vertices[0], each.vertices[1], each.is_held_up ? 1 : 0});
  }
  std::vector<Index> reduced;  // of each a vertex and a body
  std::vector<Real> shares;
  for (const ReducedDistance& each : let_go.reduced) {
    reduced.insert(reduced.end(), {each.vertex, each.body});
    shares.push_back(each.share);
  }
  std::vector<Index> held_up;  // of each a vertex and for how many substeps
  for (const HeldUpVertex& each : let_go.held_up) held_up.insert(held_up.end(), {each.vertex, each.substeps});
  return {{"is_known", let_go.is_known},
          {"pairs", std::move(pairs)},
          {"reduced", std::move(reduced)},
          {"shares", bytes_of(shares)},
          {"held_up", std::move(held_up)}};
}

Json write_contact(const ContactState& contact) {
  Json colliders = Json::array();
  for (const ColliderState& each : contact.colliders) {
    Json& json = colliders.emplace_back(Json{{"collider", each.collider}, {"pose", write_pose(each.pose)}});
    if (each.target) json["target"] = write_pose(*each.target);
  }
  std::vector<Index> vertices;
  std::vector<Index> touched;
  std::vector<Real> numbers;  // of each contact the anchor and the load
  for (const ContactMemory& each : contact.memory) {
    vertices.push_back(each.vertex);
    touched.push_back(each.collider);
    numbers.insert(numbers.end(), {each.anchor.x(), each.anchor.y(), each.anchor.z(), each.load});
  }
  std::vector<Index> features;  // of each pair of surfaces the kind and two numbers
  std::vector<Real> slides;
  for (const PairMemory& each : contact.pairs) {
    features.insert(features.end(), {static_cast<Index>(each.kind), each.features[0], each.features[1]});
    slides.insert(slides.end(), each.slide.begin(), each.slide.end());
  }
  return {{"colliders", std::move(colliders)},
          {"pairs", std::move(features)},
          {"slides", bytes_of(slides)},
          {"let_go", write_let_go(contact.let_go)},
          {"vertices", std::move(vertices)},
          {"touched", std::move(touched)},
          {"anchors_and_loads", bytes_of(numbers)},
          {"stiffening", bytes_of(contact.stiffening)},
          {"in_factor", bytes_of(contact.in_factor)},
          {"energies", bytes_of(contact.energies)},
          {"light_steps", contact.light_steps}};
}

}  // namespace

Json state_json(const State& state) {
  Json json = {{"step", state.step},
               {"time", state.time},
               {"time_excess", state.time_excess},
               {"positions", bytes_of(state.positions)},
               {"velocities", bytes_of(state.velocities)}};
  if (state.previous_time_step > 0) {
    json["previous"] = {{"time_step", state.previous_time_step},
                        {"positions", bytes_of(state.previous_positions)},
                        {"velocities", bytes_of(state.previous_velocities)}};
  }
  if (state.iterations > 0) json["iterations"] = state.iterations;
  if (state.changed_step > 0) json["changed_step"] = state.changed_step;
  if (!state.contact.is_empty()) json["contact"] = write_contact(state.contact);
  if (!state.energy_surplus.empty()) json["energy_surplus"] = bytes_of(state.energy_surplus);
  return json;
}

Json groups_json(const Simulation& simulation) {
  Json groups = Json::array();
  for (const auto& [id, group] : simulation.groups()) {
    Json batches = Json::array();
    for (const auto& batch : group.set.batches) {
      Json& json =
          batches.emplace_back(Json{{"stiffness", batch->stiffness()}, {"parameters", bytes_of(batch->parameters())}});
      if (batch->is_beside_factor() && !batch->comes_and_goes()) json["is_beside_factor"] = true;
    }
    groups.push_back({{"name", bytes_of(group.name)}, {"batches", std::move(batches)}});
  }
  return groups;
}

}  // namespace pliant
