#include "viewer/live_scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "viewer/added_parts.h"
#include "viewer/suggestions.h"

namespace pliant_viewer {
namespace {

constexpr Seconds patience{0.5};               // with a step while a change is waiting
constexpr Seconds longest_wait{1};             // a huge time step would overflow the clock
constexpr Seconds freshness{0.008};            // age at which a snapshot is replaced
constexpr std::size_t most_measured = 16'384;  // steps that a window which takes no snapshots leaves waiting

/// Blue where it is softer, gray as it was, orange where it is stiffer; full at a tenth and at tenfold.
/// Ropes have one color from end to end of an edge.
pliant_render::VertexLook look_of_factor(Real factor, bool has_surface) {
  pliant_render::VertexLook look;
  look.front = {222, 220, 216, 255};
  look.back = {36, 84, 168, pliant_render::gradient_pattern};
  look.second = {208, 88, 16, 0};
  look.place.x() = static_cast<float>(std::log10(factor));
  if (has_surface) return look;
  const float share = std::clamp(look.place.x(), -1.0F, 1.0F);
  const std::array<std::uint8_t, 4>& end = share < 0 ? look.back : look.second;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto from = static_cast<float>(look.front[i]), to = static_cast<float>(end[i]);
    look.front[i] = static_cast<std::uint8_t>(std::lround(from + std::abs(share) * (to - from)));
  }
  return look;
}

/// What bodies look like, but for one whose painted stiffness is shown.
pliant_render::BodyLooks looks_of(const Session& session, const std::string& painted) {
  const pliant::Simulation& simulation = session.simulation();
  const pliant::Scene& scene = session.scene();
  pliant_render::BodyLooks looks =
      pliant_render::body_looks(simulation.bodies(), scene.appearances, scene.materials, scene.collider_appearances);
  const auto id = painted.empty() ? std::nullopt : simulation.find_group(painted);
  if (!id) return looks;
  looks.vertices.resize(static_cast<std::size_t>(simulation.state().vertex_count()));
  const pliant::Group& group = simulation.groups().at(*id);
  const pliant::Body& body = simulation.body(group.body);
  const bool has_surface = !(body.mesh.triangles.empty() && body.mesh.tetrahedra.empty());
  for (Index v = 0; v < body.mesh.vertex_count(); ++v) {
    const Real factor = group.factors.empty() ? 1 : group.factors[static_cast<std::size_t>(v)];
    looks.vertices[static_cast<std::size_t>(body.first_vertex + v)] = look_of_factor(factor, has_surface);
  }
  return looks;
}

/// What was pinned by hand keeps its tone, all of a body too.
pliant_render::RenderMesh make_mesh_of(const Session& session, const std::string& painted) {
  const std::vector<pliant::Body>& bodies = session.simulation().bodies();
  const std::vector<char> is_figure = session.figures();
  std::vector<std::uint32_t> held;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Index count = is_figure[i] != 0 ? bodies[i].mesh.vertex_count() : 0;
    for (Index v = 0; v < count; ++v) held.push_back(static_cast<std::uint32_t>(bodies[i].first_vertex + v));
  }
  pliant_render::RenderMesh mesh = pliant_render::make_render_mesh(bodies, held);
  mesh.looks = looks_of(session, painted);
  return mesh;
}

/// A body whose last vertices were pinned by hand looks as before, with marks.
void show_pins_of_hand(const std::vector<std::uint32_t>& pins, const std::vector<char>& is_figure,
                       const pliant_render::RenderMesh& render_mesh, pliant_render::FrameContent& content) {
  std::erase_if(content.held, [&](std::uint32_t vertex) { return is_figure[render_mesh.bodies[vertex]] == 0; });
  std::vector<std::uint32_t> marked;
  std::ranges::set_union(pins, content.markers, std::back_inserter(marked));
  content.markers = std::move(marked);
}

}  // namespace

LiveScene::LiveScene(MakeScene make, Index threads, bool is_playing, std::function<void()> wake,
                     std::optional<SessionRecord> record)
    : session_(std::move(make)),
      context_{session_, pacer_, is_playing},
      threads_(threads),
      wake_(std::move(wake)),
      appearance_(session_.scene().view),
      name_(session_.scene().name),
      suggested_pull_(suggest_pull_stiffness(session_.simulation())) {
  context_.color = appearance_.color;
  session_.set_stop([this] { return shall_give_up(); });
  set_thread_count();
  if (record) {
    session_.replay(std::move(*record));
    if (!session_.is_replaying()) say_replay_ended();
  }
  update_render_mesh();
  measure_start();
  publish();
  thread_ = std::thread([this] { work(); });
}

LiveScene::~LiveScene() {
  end();
}

pliant::Scene LiveScene::close() {
  end();
  return session_.close();
}

void LiveScene::end() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_closing_ = true;
  }
  work_.notify_one();
  thread_.join();
}

void LiveScene::set_thread_count() {
  if (session_.simulation().settings().threads == 0 && threads_ != 0) session_.set_threads(threads_);
}

std::uint64_t LiveScene::post(Command command, Kind kind) {
  const std::lock_guard lock(mutex_);
  queue_.emplace_back(std::move(command), kind);
  if (kind != Kind::steers) ++changes_waiting_;
  if (kind == Kind::ends) ++ends_waiting_;
  work_.notify_one();
  return ++commands_posted_;
}

void LiveScene::hold_at(double time) {
  {
    const std::lock_guard lock(mutex_);
    hold_ = time;
  }
  work_.notify_one();
}

/// After a restart: where something is held, nothing goes by before the start was seen.
void LiveScene::hold_at_start() {
  const std::lock_guard lock(mutex_);
  if (std::isfinite(hold_)) hold_ = session_.simulation().state().time;
}

const Snapshot& LiveScene::newest() {
  const std::lock_guard lock(mutex_);
  if (has_news_) std::swap(front_, middle_);
  has_news_ = false;
  return front_;
}

bool LiveScene::has_news() const {
  const std::lock_guard lock(mutex_);
  return has_news_;
}

Seconds LiveScene::step_age() const {
  const Clock::rep began = step_began_;
  return began == 0 ? Seconds(0) : Clock::now() - Clock::time_point(Clock::duration(began));
}

/// Asked before each iteration, on the simulation's thread.
bool LiveScene::shall_give_up() const {
  return is_closing_ || ends_waiting_ > 0 || (changes_waiting_ > 0 && step_age() > patience);
}

void LiveScene::work() {
  pacer_.start(Clock::now());
  while (true) {
    wait_for_work();
    if (is_closing_) return;
    try {
      turn();
    } catch (const std::exception& error) {  // age at which a snapshot is replaced, such as no memory for it; steps and
                                             // commands tell theirs
      note_ = error.what();
      context_.is_playing = false;
      context_.single_steps = 0;
    }
  }
}

void LiveScene::turn() {
  run_commands();
  // A change is shown before a step that may take long.
  if (is_dirty_ && commands_published_ != commands_done_) publish();
  if (time_to_step() <= Seconds(0)) step();
  // A snapshot that the window has not taken yet is replaced now and then, and whenever there is time.
  const bool is_fresh = has_news() && Clock::now() - published_ < freshness;
  if (is_dirty_ && (!is_fresh || time_to_step() > Seconds(0))) publish();
}

/// Until the next step is due.
Seconds LiveScene::time_to_step() {
  if (context_.single_steps > 0) return Seconds(0);
  if (!context_.is_playing || is_held()) return Seconds::max();
  return pacer_.wait(Clock::now(), session_.simulation().settings().time_step);
}

/// Until a command comes, or a step is due.
void LiveScene::wait_for_work() {
  const bool was_held = is_held();
  const Seconds wait = time_to_step();
  if (wait <= Seconds(0)) return;
  std::unique_lock lock(mutex_);
  const auto has_work = [&] { return is_closing_ || !queue_.empty() || (was_held && !is_held()); };
  if (context_.is_playing) {
    work_.wait_for(lock, std::min(wait, longest_wait), has_work);
  } else {
    work_.wait(lock, has_work);
  }
}

void LiveScene::run_commands() {
  std::deque<std::pair<Command, Kind>> commands;
  {
    const std::lock_guard lock(mutex_);
    commands.swap(queue_);
    changes_waiting_ = 0;
    ends_waiting_ = 0;
  }
  for (const auto& [command, kind] : commands) {
    const bool was_playing = context_.is_playing;
    const double speed = pacer_.speed();
    const std::uint64_t restarts = session_.restarts();
    const bool was_replaying = session_.is_replaying();
    try {
      context_.message.clear();
      command(context_);
      if (!context_.message.empty()) say(context_.message);
      if (session_.restarts() != restarts) note_.clear();
    } catch (const std::exception& error) {
      note_ = error.what();
    }
    if (context_.is_playing && !was_playing) {
      pacer_.start(Clock::now());
      statistics_.clear();
      note_.clear();
    }
    if (was_replaying && !session_.is_replaying() && context_.message.empty())
      say("you have taken over; from here on the session is yours");
    if (pacer_.speed() != speed) statistics_.clear();
    ++commands_done_;
    is_dirty_ = true;
  }
  follow_session();
}

void LiveScene::say(std::string message) {
  message_ = std::move(message);
  ++messages_;
}

void LiveScene::say_replay_ended() {
  context_.is_playing = false;
  context_.single_steps = 0;
  const auto differs_from = session_.replayed().differs_from;
  say("the recorded session ends here; Space goes on from here" +
      (differs_from ? fmt::format(" (its bits differ from the recorded ones since step {})", *differs_from) : ""));
}

/// After what commands, or a replay, have done.
void LiveScene::follow_session() {
  if (session_.rebuilds() != rebuilds_seen_) {
    rebuilds_seen_ = session_.rebuilds();
    update_render_mesh();
  }
  if (session_.look_changes() != looks_seen_ || context_.painted != painted_seen_) {
    looks_seen_ = session_.look_changes();
    painted_seen_ = context_.painted;
    update_looks();
  }
  if (session_.restarts() == restarts_seen_) return;
  restarts_seen_ = session_.restarts();
  hold_at_start();
  statistics_.clear();
  pacer_.start(Clock::now());
  set_thread_count();
  update_render_mesh();
  measure_start();
}

void LiveScene::measure_start() {
  is_at_start_ = true;
  if (auto start = measurer_.measure_start(session_.measured_scene())) measured_.push_back(std::move(*start));
}

void LiveScene::step() {
  if (is_at_start_) measure_start();  // with what commands have changed
  step_began_ = Clock::now().time_since_epoch().count();
  try {
    const double before = session_.simulation().state().time;
    const bool was_replaying = session_.is_replaying();
    const pliant::StepReport report = session_.step();
    follow_session();
    context_.single_steps = std::max<std::int64_t>(context_.single_steps - 1, 0);
    if (was_replaying && !session_.is_replaying()) say_replay_ended();
    pacer_.took_step();
    is_at_start_ = false;
    if (auto measured = measurer_.measure_step(session_.measured_scene(), report, context_.measuring)) {
      measured_.push_back(std::move(*measured));
    }
    statistics_.add({Clock::now(), session_.simulation().state().time - before, report.seconds_local,
                     report.seconds_global, report.seconds_factor, report.contact.seconds, report.seconds_total});
  } catch (const std::exception& error) {
    const auto* known = dynamic_cast<const pliant::Error*>(&error);
    if (known == nullptr || known->kind() != pliant::ErrorKind::interrupted) {
      note_ = error.what();
      context_.is_playing = false;
      context_.single_steps = 0;
    }
  }
  step_began_ = 0;
  is_dirty_ = true;
}

void LiveScene::update_render_mesh() {
  auto render_mesh = std::make_shared<const pliant_render::RenderMesh>(make_mesh_of(session_, context_.painted));
  if (render_mesh_ == nullptr || !have_same_shape(*render_mesh, *render_mesh_) ||
      render_mesh->looks != render_mesh_->looks)
    render_mesh_ = std::move(render_mesh);
  std::vector<std::string> names;
  std::vector<char> is_closed;
  for (const pliant::Body& body : session_.simulation().bodies()) {
    names.push_back(body.name);
    is_closed.push_back(can_hold_pressure(body.mesh) ? 1 : 0);
  }
  body_names_ = std::make_shared<const std::vector<std::string>>(std::move(names));
  is_closed_ = std::make_shared<const std::vector<char>>(std::move(is_closed));
}

void LiveScene::update_looks() {
  auto render_mesh = std::make_shared<pliant_render::RenderMesh>(*render_mesh_);
  render_mesh->looks = looks_of(session_, context_.painted);
  render_mesh_ = std::move(render_mesh);
}

/// What the panel has of bodies.
void LiveScene::update_bodies() {
  auto appearances = std::make_shared<std::map<std::string, pliant::BodyAppearance>>();
  for (const auto& [id, appearance] : session_.scene().appearances) {
    (*appearances)[session_.simulation().body(id).name] = appearance;
  }
  appearances_ = std::move(appearances);
  materials_ = std::make_shared<const std::vector<BodyMaterial>>(session_.materials());
  std::vector<PaintableGroup> paintable = session_.paintable();
  const std::vector<char> is_figure = session_.figures();
  const auto is_of_figure = [&](const PaintableGroup& each) {
    const auto place = std::ranges::find(*body_names_, each.body) - body_names_->begin();
    return is_figure.at(static_cast<std::size_t>(place)) != 0;
  };
  std::erase_if(paintable, is_of_figure);
  paintable_ = std::make_shared<const std::vector<PaintableGroup>>(std::move(paintable));
  switches_ = std::make_shared<const std::map<std::string, bool>>(session_.switches());
  switched_off_ = std::make_shared<const std::map<std::string, SwitchedOff>>(session_.switched_off());
}

/// Lists parameters and materials anew after commands, and a few times a second since the scene's own events change
/// them too.
void LiveScene::update_sliders() {
  const Clock::time_point now = Clock::now();
  if (commands_done_ == commands_listed_ && now - sliders_listed_ < Seconds(0.2)) return;
  sliders_listed_ = now;
  commands_listed_ = commands_done_;
  sliders_ = std::make_shared<const std::vector<Slider>>(session_.sliders());
  update_bodies();
}

void LiveScene::publish() {
  const pliant::Simulation& simulation = session_.simulation();
  if (simulation.bodies().size() != body_names_->size()) update_render_mesh();  // a program has added some
  back_.render_mesh = render_mesh_;
  back_.body_names = body_names_;
  back_.is_closed = is_closed_;
  back_.frame = pliant_render::capture_frame(simulation, *render_mesh_, context_.color, surfaces_);
  back_.color = context_.color;
  back_.pinned = session_.pinned_vertices();
  back_.pins.clear();
  for (const PinnedVertex& pin : back_.pinned) back_.pins.push_back(pin.vertex);
  back_.is_figure = session_.figures();
  show_pins_of_hand(back_.pins, back_.is_figure, *render_mesh_, back_.frame.content);
  back_.pull = session_.pull();
  update_sliders();
  back_.sliders = sliders_;
  back_.materials = materials_;
  back_.paintable = paintable_;
  back_.appearances = appearances_;
  back_.switches = switches_;
  back_.switched_off = switched_off_;
  back_.wrenches.clear();
  for (const auto& [id, collider] : simulation.colliders()) back_.wrenches[id] = simulation.wrench(id);
  back_.movable = session_.movable_colliders();
  back_.measured = std::exchange(measured_, {});
  back_.statistics = statistics_.means(Clock::now());
  back_.step = simulation.state().step;
  back_.single_steps = context_.single_steps;
  back_.time_step = simulation.settings().time_step;
  back_.is_playing = context_.is_playing;
  back_.is_behind = context_.is_playing && pacer_.steps_behind() > Pacer::most_behind - 1.5;
  back_.note = !note_.empty() ? note_ : session_.note();
  back_.message = message_;
  back_.messages = messages_;
  back_.undone_next = session_.undone_next();
  back_.redone_next = session_.redone_next();
  back_.edits = session_.edit_count();
  back_.is_replaying = session_.is_replaying();
  back_.replayed = session_.replayed();
  back_.has_text = session_.has_text();
  back_.has_unsaved_changes = session_.has_unsaved_changes();
  back_.restarts = session_.restarts();
  back_.rebuilds = session_.rebuilds();
  back_.commands = commands_published_ = commands_done_;
  {
    const std::lock_guard lock(mutex_);
    if (has_news_) {
      std::ranges::move(back_.measured, std::back_inserter(middle_.measured));
      std::swap(back_.measured, middle_.measured);
    }
    if (back_.measured.size() > most_measured) leave_out_every_second(back_.measured);
    std::swap(back_, middle_);
    has_news_ = true;
  }
  is_dirty_ = false;
  published_ = Clock::now();
  wake_();
}

}  // namespace pliant_viewer
