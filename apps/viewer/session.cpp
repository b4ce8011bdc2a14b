#include "viewer/session.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "pliant/constraints/drag.h"
#include "pliant/core/error.h"

namespace pliant_viewer {
namespace {

constexpr std::string_view pull_name = "mouse";

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

/// Whatever it throws is told in the window.
void call_one(const std::function<void(pliant::Simulation&)>& hook, const char* name, pliant::Simulation& simulation) {
  if (!hook) return;
  try {
    hook(simulation);
  } catch (const std::exception&) {
    throw;
  } catch (...) {
    throw std::runtime_error(std::string(name) + " has thrown something that is no std::exception");
  }
}

}  // namespace

void HookCaller::call(std::uint64_t restarts, std::uint64_t rebuilds, pliant::Simulation& simulation) {
  if (std::exchange(restarts_, restarts) != restarts) call_one(hooks_.restarted, "restarted", simulation);
  if (std::exchange(rebuilds_, rebuilds) != rebuilds) call_one(hooks_.rebuilt, "rebuilt", simulation);
  call_one(hooks_.before_step, "before_step", simulation);
}

Session::Session(MakeScene make)
    : make_(std::move(make)),
      scene_(make_()),
      unchanged_(scene_.simulation.state().step == 0 || scene_.source.texts.empty()
                     ? UnchangedScene(scene_)
                     : UnchangedScene(parse_scene(scene_.source))),
      goals_(scene_.simulation) {
  begin_record(scene_);
}

void Session::set_stop(std::function<bool()> stop) {
  stop_ = std::move(stop);
  scene_.simulation.set_stop(stop_);
}

pliant::Scene Session::close() {
  let_go();
  set_stop({});
  return std::move(scene_);
}

void Session::set_threads(Index threads) {
  pliant::SolverSettings settings = scene_.simulation.settings();
  settings.threads = threads;
  scene_.simulation.set_settings(settings);
}

pliant::StepReport Session::step() {
  do_what_is_due();
  hooks_.call(restarts_, rebuilds_, scene_.simulation);
  goals_.steer(scene_.simulation);
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
  const auto group = std::exchange(pull_group_, {});
  pull_.reset();
  if (group && scene_.simulation.groups().contains(*group)) scene_.simulation.remove(*group);  // an event may have
}

bool Session::is_hidden(pliant::GroupId group) const {
  return group == pull_group_ || of_hand_.contains(group);
}

std::vector<Slider> Session::sliders() const {
  return list_sliders(simulation(), [this](pliant::GroupId id) { return is_hidden(id); });
}

pliant::BodyId Session::body_of(Index vertex) const {
  const std::vector<pliant::Body>& bodies = scene_.simulation.bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Index last = bodies[i].first_vertex + bodies[i].mesh.vertex_count();
    if (vertex >= bodies[i].first_vertex && vertex < last) return pliant::BodyId{static_cast<Index>(i)};
  }
  pliant::fail_input("there is no vertex " + std::to_string(vertex));
}

}  // namespace pliant_viewer
