// How bodies touch, and what the solver is told of it.
#include <algorithm>

#include <fmt/format.h>

#include "pliant/collision/crossings.h"
#include "pliant/constraints/attachment.h"
#include "pliant/mesh/topology.h"
#include "pliant/simulation/transaction.h"
#include "pliant/solver/solver.h"

namespace pliant {
namespace {

/// Of the edges of a body, from the shortest on, the place whose length its contact distance goes by, and the share of
/// that length which it is.
constexpr Real short_edge = 0.05;
constexpr Real share_of_edge = 0.25;
/// Of a body without an edge [m].
constexpr Real distance_without_edges = 0.005;

Real contact_distance_of(const Mesh& mesh) {
  std::vector<Real> lengths;
  const bool is_carried = !mesh.embedding.is_empty();  // its edges are then those of the surface, not of the lattice
  for (const Edge& edge : is_carried ? edge_triangles(mesh).edges : unique_edges(mesh)) {
    const Real length = (mesh.vertices.row(edge[0]) - mesh.vertices.row(edge[1])).norm();
    if (length > 0) lengths.push_back(length);
  }
  if (lengths.empty()) return distance_without_edges;
  const auto place = lengths.begin() + static_cast<std::ptrdiff_t>(short_edge * static_cast<Real>(lengths.size()));
  std::ranges::nth_element(lengths, place);
  return share_of_edge * *place;
}

/// Group of each body, and which groups ignore each other, as Surface has them.
struct IgnoringGroups {
  std::vector<Index> of_bodies;
  std::vector<char> ignored;

  /// All bodies that ignore none and are ignored by none are in group 0.
  explicit IgnoringGroups(const std::vector<Body>& bodies) : of_bodies(bodies.size(), 0) {
    Index count = 1;
    const auto name = [&](std::size_t body) {
      if (of_bodies[body] == 0) of_bodies[body] = count++;
    };
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (const BodyId other : bodies[i].contact.ignores) name(i), name(static_cast<std::size_t>(other));
    }
    if (count == 1) return;
    ignored.assign(at(count) * at(count), 0);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (const BodyId other : bodies[i].contact.ignores) {
        const std::size_t a = at(of_bodies[i]), b = at(of_bodies[static_cast<std::size_t>(other)]);
        ignored[a * at(count) + b] = ignored[b * at(count) + a] = 1;
      }
    }
  }
};

/// What the ties of a group join: those that end up shorter than r [m], which contact would otherwise hold open.
void add_joints(const Group& group, Real r, std::vector<Joint>& joints) {
  for (const auto& batch : group.set.batches) {
    const auto* ties = dynamic_cast<const Batch<AttachmentProjection>*>(batch.get());
    if (ties == nullptr) continue;
    const auto size = static_cast<std::size_t>(ties->shape().vertices);
    for (std::size_t i = 0; i < at(ties->shape().count); ++i) {
      if (!(AttachmentProjection::end_length(&ties->fields()[i * AttachmentProjection::fields]) < r)) continue;
      const std::span<const Index> stencil = ties->stencil().subspan(i * size, size);
      for (const Index corner : stencil.subspan(1)) joints.push_back({stencil[0], corner, size == 2});
    }
  }
}

}  // namespace

const Body& Colliders::body(BodyId id) const {
  const auto i = static_cast<std::size_t>(id);
  if (i >= bodies_.size()) {
    fail_input("body " + std::to_string(i) + " does not exist; there are " + std::to_string(bodies_.size()));
  }
  return bodies_[i];
}

void Colliders::join_anew() {
  if (transaction_ != nullptr) transaction_->save_colliders();
  state_.contact.let_go.is_known = false;
  colliders_changed_ = true;
  surfaces_changed_ = true;
}

void Colliders::set_mass(BodyId id, const Mass& mass) {
  const Body& owner = body(id);
  const std::vector<Real> masses = vertex_masses(owner.mesh, mass, owner.name);
  if (transaction_ != nullptr) transaction_->save_state();
  std::ranges::copy(masses, state_.masses.begin() + owner.first_vertex);
  masses_changed_ = true;
  note_change();
}

void Colliders::set_contact(BodyId id, const BodyContact& contact) {
  const std::string where = "contact of body '" + body(id).name + "'";
  check_options(where, contact);
  for (const BodyId other : contact.ignores) {
    if (static_cast<std::size_t>(other) >= bodies_.size()) {
      fail_input(fmt::format("{}: ignores: body {} does not exist; there are {}", where, static_cast<Index>(other),
                             bodies_.size()));
    }
    if (other == id) {
      fail_input(where + ": ignores: this is the body itself; set `self` to false to let it not touch itself");
    }
  }
  if (transaction_ != nullptr) transaction_->save_body_contacts();
  BodyContact& present = bodies_[static_cast<std::size_t>(id)].contact;
  if (contact.self != present.self || contact.ignores != present.ignores) join_anew();
  present = contact;
  colliders_changed_ = true;
  surfaces_changed_ = true;
  note_change();
}

Real Colliders::contact_distance(BodyId id) const {
  const Body& owner = body(id);
  if (owner.contact.distance > 0) return owner.contact.distance;
  if (contact_.distance > 0) return contact_.distance;
  const auto place = static_cast<std::size_t>(id);
  return place < edge_distances_.size() ? edge_distances_[place] : contact_distance_of(owner.mesh);
}

std::span<const ContactPoint> Simulation::contacts() const {
  return solver_->contact().points();
}

std::vector<VertexTouch> Simulation::touches() const {
  std::vector<VertexTouch> touches(state_.masses.size());
  solver_->add_touches(touches);
  return touches;
}

Wrench Simulation::wrench(ColliderId id) const {
  collider(id);
  return solver_->contact().wrench(static_cast<Index>(id));
}

void Simulation::update_colliders() {
  std::vector<SolverCollider> colliders;
  std::vector<Real> radii, frictions;
  std::vector<char> inner;  // vertices of lattices that carry a surface
  for (const auto& [id, record] : colliders_) {
    const Vec3 surface_velocity = record.pose.rotation.conjugate() * record.motion.surface_velocity;
    const std::optional<Real>& own = record.motion.friction;
    colliders.push_back({static_cast<Index>(id), record.shape, record.motion, surface_velocity,
                         own.value_or(contact_.friction), own.has_value()});
  }
  const bool has_contact = !colliders.empty() || contact_.surfaces;
  const bool has_frictions =
      has_contact && std::ranges::any_of(bodies_, [](const Body& body) { return body.contact.friction.has_value(); });
  for (std::size_t i = 0; has_contact && i < bodies_.size(); ++i) {
    if (i == edge_distances_.size()) edge_distances_.push_back(contact_distance_of(bodies_[i].mesh));
    const std::size_t end = radii.size() + at(bodies_[i].mesh.vertex_count());
    radii.resize(end, contact_distance(BodyId{static_cast<Index>(i)}));
    if (has_frictions) frictions.resize(end, bodies_[i].contact.friction.value_or(-1));
    const Index carried = bodies_[i].mesh.embedding.carried_count();
    if (carried == 0) continue;
    inner.resize(at(state_.vertex_count()), 0);
    std::fill(inner.begin() + bodies_[i].first_vertex + carried, inner.begin() + static_cast<std::ptrdiff_t>(end), 1);
  }
  solver_->set_colliders(std::move(colliders), std::move(radii), std::move(frictions), std::move(inner));
  if (surfaces_changed_) update_surfaces();
  colliders_changed_ = false;
}

void Simulation::update_surfaces() {
  SolverSurfaces surfaces;
  surface_triangles_.clear();
  if (contact_.surfaces) {
    IgnoringGroups groups(bodies_);
    surfaces.ignored = std::move(groups.ignored);
    surfaces.frictions.otherwise = contact_.friction;
    surfaces.rest.resize(state_.vertex_count(), 3);
    for (const Body& body : bodies_) surface_triangles_.push_back(surface_triangles(body.mesh));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Body& body = bodies_[i];
      const Index count = body.mesh.vertex_count();
      surfaces.parts.push_back({.first_vertex = body.first_vertex,
                                .vertex_count = count,
                                .triangles = surface_triangles_[i],
                                .edges = body.mesh.edges,
                                .meets_itself = body.contact.self,
                                .group = groups.of_bodies[i]});
      surfaces.rest.middleRows(body.first_vertex, count) = body.mesh.vertices;
      surfaces.frictions.own.push_back(body.contact.friction);
    }
  }
  for (const auto& [id, group] : groups_) {
    if (!contact_.surfaces || !group.other) continue;
    add_joints(group, (contact_distance(group.body) + contact_distance(*group.other)) / 2, surfaces.joints);
  }
  solver_->set_surfaces(std::move(surfaces));
  surfaces_changed_ = false;
}

}  // namespace pliant
