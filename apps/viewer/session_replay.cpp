// A session's record: what it is made of, and how it is done again.
#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "viewer/session.h"
#include "viewer/view_document.h"

namespace pliant_viewer {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

}  // namespace

/// Begins a new record with this scene.
void Session::begin_record(const pliant::Scene& scene) {
  opened_ = {scene.source, scene.files, {}};
  // Of one that goes on from a checkpoint the source tells the start alone.
  const bool can_be_saved = !scene.source.texts.empty();
  if (can_be_saved && scene.simulation.state().step > 0) opened_.checkpoint = pliant::checkpoint_bytes(scene, {});
  log_.clear();
}

SessionRecord Session::record(const std::filesystem::path& file, const pliant::ViewSettings& view) const {
  if (!unchanged_.has_text()) {
    pliant::fail_input("this scene was made by a program, not read from a scene file, so its session cannot be saved");
  }
  const char* const changed =
      "the scene's files were changed while it was open, so this session cannot be saved; open it again";
  if (opened_.was_changed) pliant::fail_input(changed);
  pliant::Scene start = opened_.checkpoint.empty() ? parse_scene(opened_.source)
                                                   : pliant::parse_checkpoint(opened_.checkpoint, scene_.name);
  if (!is_made_from(opened_, start)) pliant::fail_input(changed);
  pliant::SceneDocument document(start);
  write_view(view, document);
  if (const std::string text = document.get("view"); !text.empty()) {
    start.source.overrides.set.push_back("view=" + text);
  }
  SessionRecord record;
  record.scene = scene_.name;
  record.start = pliant::checkpoint_bytes(start, file.parent_path());
  record.steps = log_.steps();
  record.actions = log_.actions();
  record.checksums = log_.checksums();
  // That of the last step is of now: something may have been done since.
  if (!record.checksums.empty() && record.checksums.back().step == record.steps) record.checksums.pop_back();
  record.checksums.push_back({record.steps, state_checksum(simulation())});
  return record;
}

SessionLog::Scope Session::note(Action action) {
  if (!is_doing_again_) replay_.reset();  // someone takes over
  return {log_, std::move(action)};
}

void Session::replay(SessionRecord record) {
  replayed_ = {.wanted_steps = record.steps};
  replay_ = Replay{std::move(record)};
  if (replayed_.wanted_steps == 0) check_replay();
}

/// After a step: compares, and ends behind the last one, with what was done after that.
void Session::check_replay() {
  const bool is_end = replayed_.steps == replayed_.wanted_steps;
  if (is_end) do_what_is_due();
  const std::vector<StepChecksum>& checksums = replay_->record.checksums;
  std::size_t& next = replay_->next_checksum;
  if (next < checksums.size() && checksums[next].step == replayed_.steps) {
    const bool is_same = checksums[next++].crc32 == state_checksum(simulation());
    if (!is_same && !replayed_.differs_from) replayed_.differs_from = replayed_.steps;
  }
  if (!is_end) return;
  replay_.reset();
  replayed_.has_ended = true;
}

/// Before the next step. An action that fails ends the replay.
void Session::do_what_is_due() {
  while (replay_ && replay_->next_action < replay_->record.actions.size()) {
    const TimedAction timed = replay_->record.actions[replay_->next_action];
    if (timed.step > replayed_.steps) return;
    ++replay_->next_action;
    is_doing_again_ = true;
    try {
      do_again(timed.action);
    } catch (const pliant::Error& error) {
      is_doing_again_ = false;
      replay_.reset();
      throw pliant::Error(error.kind(),
                          fmt::format("'{}' after step {}: {}", action_name(timed.action), timed.step, error.what()));
    } catch (...) {
      is_doing_again_ = false;
      replay_.reset();
      throw;
    }
    is_doing_again_ = false;
  }
}

void Session::do_again(const Action& action) {
  const auto collider = [](Index id) { return static_cast<pliant::ColliderId>(id); };
  std::visit(
      Overloaded{[&](const action::Grab& grabbed) { grab(grabbed.pull); },
                 [&](const action::PullTo& moved) { pull_to(moved.target); },
                 [&](const action::PullStiffness& set) { set_pull_stiffness(set.stiffness); },
                 [&](const action::LetGo&) { let_go(); },
                 [&](const action::PinVertex& pinned) { pin(pinned.vertex); },
                 [&](const action::Unpin& released) { unpin(released.vertex); },
                 [&](const action::MovePin& moved) { move_pin(moved.vertex, moved.target); },
                 [&](const action::DropPin& dropped) { drop_pin(dropped.vertex); },
                 [&](const action::PinVertices& pinned) { pin(pinned.vertices); },
                 [&](const action::UnpinVertices& released) { unpin(released.vertices); },
                 [&](const action::HoldPins& held) { hold_pins(held.vertices); },
                 [&](const action::MoveHeld& moved) { move_held(moved.motion); },
                 [&](const action::DropHeld&) { drop_held(); },
                 [&](const action::MoveCollider& moved) { move_collider(collider(moved.collider), moved.target); },
                 [&](const action::TurnCollider& turned) { turn_collider(collider(turned.collider), turned.rotation); },
                 [&](const action::DropCollider& dropped) { drop_collider(collider(dropped.collider)); },
                 [&](const action::Set& changed) { set(changed.key, changed.value, changed.goes_on); },
                 [&](const action::SetMaterial& dressed) { set_material(dressed.body, dressed.material); },
                 [&](const action::SetAppearance& set) { set_appearance(set.body, set.appearance, set.goes_on); },
                 [&](const action::SwitchOn& switched) { switch_on(switched.name, switched.on); },
                 [&](const action::Add& added) { add(added.type, added.body); },
                 [&](const action::Push& pushed) { push(pushed.vertices); },
                 [&](const action::Paint& painted) { paint(painted.group, painted.dab, painted.goes_on); },
                 [&](const action::Undo&) { undo(); },
                 [&](const action::Redo&) { redo(); },
                 [&](const action::Restart& restarted) { restart(restarted.keep_changes); },
                 [&](const action::Save&) {
                   const auto noted = note(action::Save{});
                   go_on_as(prepare_save("replayed.json", scene_.view));
                 }},
      action);
}

}  // namespace pliant_viewer
