#include "viewer/session.h"

#include <algorithm>
#include <tuple>

#include "pliant/collision/colliders/builtin.h"
#include "pliant/constraints/drag.h"
#include "pliant/constraints/position.h"
#include "pliant/core/error.h"
#include "pliant/simulation/held.h"

namespace pliant_viewer {
namespace {

constexpr std::string_view pull_name = "mouse";
constexpr std::string_view pin_name = "pinned by hand";  // until the scene is made anew

/// The constraint that draws at a point of a body whose first vertex has this index.
pliant::Drag drag_of(const Pull& pull, Index first_vertex) {
  pliant::Drag drag;
  std::vector<Index> vertices;
  std::vector<Real> weights;
  Real sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto weight = static_cast<Real>(std::max(pull.point.weights[static_cast<int>(i)], 0.0F));
    const Index vertex = static_cast<Index>(pull.point.vertices[i]) - first_vertex;
    if (std::ranges::find(vertices, vertex) != vertices.end()) continue;  // of an edge
    vertices.push_back(vertex);
    weights.push_back(weight);
    sum += weight;
  }
  for (Real& weight : weights) weight /= sum;
  drag.stencils.add(std::span<const Index>(vertices));
  drag.weights.add(std::span<const Real>(weights));
  drag.stiffness = pull.stiffness;
  drag.targets = pliant::Points(pull.target.cast<Real>().eval());
  return drag;
}

/// The diagonal of the box around all bodies [m].
Real size_of(const pliant::Simulation& simulation) {
  const pliant::Positions& x = simulation.state().positions;
  return x.rows() == 0 ? 0 : (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm();
}

/// Ends what a collider does by itself.
template <class... Types>
void stop_collider(std::tuple<Types...>*, pliant::Simulation& simulation, pliant::ColliderId id) {
  const auto stop_as = [&]<class Type>(Type*) {
    const auto* options = simulation.options<Type>(id);
    if (options == nullptr || (options->velocity.isZero(0) && options->angular_velocity.isZero(0))) return;
    Type at_rest = *options;
    at_rest.velocity = at_rest.angular_velocity = pliant::Vec3::Zero();
    simulation.replace(id, at_rest);
  };
  (stop_as(static_cast<Types*>(nullptr)), ...);
}

}  // namespace

Session::Session(MakeScene make)
    : make_(std::move(make)),
      scene_(make_()),
      unchanged_(scene_.simulation.state().step == 0 ? UnchangedScene(scene_)
                                                     : UnchangedScene(parse_scene(scene_.source))),
      collider_speed_(suggest_collider_speed(scene_.simulation)) {
  begin_record(scene_);
}

void Session::set_stop(std::function<bool()> stop) {
  stop_ = std::move(stop);
  scene_.simulation.set_stop(stop_);
}

void Session::set_threads(Index threads) {
  pliant::SolverSettings settings = scene_.simulation.settings();
  settings.threads = threads;
  scene_.simulation.set_settings(settings);
}

pliant::StepReport Session::step() {
  do_what_is_due();
  steer_colliders();
  pliant::StepReport report;
  try {
    report = scene_.step();
  } catch (const pliant::Error& error) {
    if (error.kind() != pliant::ErrorKind::input) throw;
    if (scene_.timeline.skip_due(scene_.simulation) == 0) throw;
    note_ = std::string("left out: ") + error.what();
    report = scene_.step();
  }
  log_.took_step(scene_.simulation);
  if (replay_) {
    ++replayed_.steps;
    check_replay();
  }
  return report;
}

void Session::grab(const Pull& pull) {
  const pliant::BodyId body = body_of(static_cast<Index>(pull.point.vertices[0]));
  if (pull_group_) let_go();
  const auto noted = note(action::Grab{pull});
  pull_group_ =
      scene_.simulation.add(body, drag_of(pull, scene_.simulation.body(body).first_vertex), std::string(pull_name));
  pull_ = pull;
}

void Session::pull_to(const Vec3f& target) {
  if (!pull_group_ || !target.allFinite()) return;
  const auto noted = note(action::PullTo{target});
  scene_.simulation.set_target(*pull_group_, 0, target.cast<Real>());
  pull_->target = target;
}

void Session::set_pull_stiffness(Real stiffness) {
  const auto noted = note(action::PullStiffness{stiffness});
  if (!pull_group_) return;
  scene_.simulation.set_stiffness(*pull_group_, stiffness);
  pull_->stiffness = stiffness;
}

void Session::let_go() {
  const auto noted = note(action::LetGo{});
  if (pull_group_) scene_.simulation.remove(*pull_group_);
  pull_group_.reset();
  pull_.reset();
}

void Session::pin(Index vertex) {
  const auto noted = note(action::PinVertex{vertex});
  if (is_pinned(vertex)) return;
  const pliant::BodyId body = body_of(vertex);
  Edit edit{.what = "pin", .before = changes_};
  pliant::Position position;
  position.on = pliant::Selection({vertex - scene_.simulation.body(body).first_vertex});
  of_hand_.insert(scene_.simulation.add(body, position, std::string(pin_name)));
  changes_.pins[vertex] = std::nullopt;
  edit.held[vertex] = target_of(*find_pin(vertex));
  remember(std::move(edit));
}

void Session::unpin(Index vertex) {
  const auto noted = note(action::Unpin{vertex});
  if (!is_pinned(vertex)) return;
  Edit edit{.what = "unpin", .before = changes_};
  edit.held[vertex] = target_of(*find_pin(vertex));
  // One vertex may have soft pins of several groups.
  while (const auto pin = find_pin(vertex)) {
    const pliant::Group& group = scene_.simulation.groups().at(pin->group);
    const bool is_of_hand = of_hand_.contains(pin->group);
    if (!is_of_hand) note_release(vertex, group, *pin);
    if (is_of_hand && scene_.simulation.target_count(pin->group) == 1) {
      of_hand_.erase(pin->group);
      scene_.simulation.remove(pin->group);
    } else {  // stays, if only as an empty one: events may name it
      const Index of_body = vertex - scene_.simulation.body(group.body).first_vertex;
      scene_.simulation.release(pin->group, std::span(&of_body, 1));
    }
  }
  changes_.pins.erase(vertex);
  changes_.moved.erase(vertex);
  remember(std::move(edit));
}

void Session::note_release(Index vertex, const pliant::Group& group, const Pin& pin) {
  ReleasedPin& released = changes_.released[vertex];
  if (std::ranges::find(released.groups, group.name) != released.groups.end()) return;
  if (released.groups.empty()) released.number = group.points[static_cast<std::size_t>(pin.target)];
  released.groups.push_back(group.name);
}

void Session::move_pin(Index vertex, const Vec3f& target) {
  const auto pin = find_pin(vertex);
  if (!pin || !target.allFinite()) return;
  const auto noted = note(action::MovePin{vertex, target});
  const pliant::Group& group = scene_.simulation.groups().at(pin->group);
  scene_.timeline.stop(scene_.simulation, pin->group, {group.points[static_cast<std::size_t>(pin->target)]});
  scene_.simulation.set_target(pin->group, pin->target, target.cast<Real>());
}

void Session::move_collider(pliant::ColliderId collider, const Vec3f& position) {
  pliant::Simulation& simulation = scene_.simulation;
  const auto found = simulation.colliders().find(collider);
  if (found == simulation.colliders().end() || !found->second.shape->is_bounded() || !position.allFinite()) return;
  const auto noted = note(action::MoveCollider{static_cast<Index>(collider), position});
  scene_.timeline.leave_alone(simulation, collider);
  left_alone_.insert(collider);
  stop_collider(static_cast<pliant::BuiltinColliders*>(nullptr), simulation, collider);
  collider_goals_[collider] = position.cast<Real>();
}

/// Sets where the next step takes the colliders that are on their way.
void Session::steer_colliders() {
  pliant::Simulation& simulation = scene_.simulation;
  const Real most = collider_speed_ * simulation.settings().time_step;
  std::erase_if(collider_goals_, [&](const auto& entry) {
    const auto& [id, goal] = entry;
    if (!simulation.colliders().contains(id)) return true;
    pliant::Pose pose = simulation.pose(id);
    const pliant::Vec3 way = goal - pose.position;
    const Real length = way.norm();
    if (length == 0) return true;
    pose.position = length > most ? pliant::Vec3(pose.position + way * (most / length)) : goal;
    simulation.set_target(id, pose);
    return false;
  });
}

bool Session::is_hidden(pliant::GroupId group) const {
  return group == pull_group_ || of_hand_.contains(group);
}

std::vector<Slider> Session::sliders() const {
  return list_sliders(simulation(), [this](pliant::GroupId id) { return is_hidden(id); });
}

std::optional<Session::Pin> Session::find_pin(Index vertex) const {
  for (const auto& [id, group] : scene_.simulation.groups()) {
    if (group.type != pliant::Position::info.name) continue;
    const std::vector<Index> vertices = vertices_of_pins(group);
    const auto found = std::ranges::find(vertices, vertex);
    if (found != vertices.end()) return Pin{id, static_cast<Index>(found - vertices.begin())};
  }
  return {};
}

pliant::BodyId Session::body_of(Index vertex) const {
  const std::vector<pliant::Body>& bodies = scene_.simulation.bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Index last = bodies[i].first_vertex + bodies[i].mesh.vertex_count();
    if (vertex >= bodies[i].first_vertex && vertex < last) return pliant::BodyId{static_cast<Index>(i)};
  }
  pliant::fail_input("there is no vertex " + std::to_string(vertex));
}

Real suggest_pull_stiffness(const pliant::Simulation& simulation) {
  constexpr Real weight_at_stretch = 3 * 9.81;  // [m/s²]: the spring holds three times the weight
  constexpr Real stretch = 0.1;                 // of the bodies' size
  Real mass = 0;
  for (const Real of_vertex : simulation.state().masses) mass += of_vertex;
  if (mass == 0) return 1;
  const Real size = size_of(simulation);
  return std::clamp<Real>(mass * weight_at_stretch / (stretch * std::max<Real>(size, 1e-3)), 1e-3, 1e9);
}

Real suggest_collider_speed(const pliant::Simulation& simulation) {
  constexpr Real sizes_in_a_second = 3;
  return sizes_in_a_second * std::max<Real>(size_of(simulation), 1e-3);
}

}  // namespace pliant_viewer
