// What a session has changed of its scene: set, taken back, done again, saved.
#include <algorithm>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/materials/change_material.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/files/atomic_file.h"
#include "viewer/carry_over.h"
#include "viewer/session.h"
#include "viewer/view_document.h"

namespace pliant_viewer {
namespace {

constexpr std::size_t most_edits = 1000;  // that can be taken back
// Pins that these may name together, some 100 bytes each; of painted factors twelve are as much.
constexpr std::size_t most_pins = 4'000'000;

/// The keys by which two maps differ.
template <class Key, class Value>
std::set<Key> difference(const std::map<Key, Value>& a, const std::map<Key, Value>& b) {
  std::set<Key> keys;
  const auto add = [&keys](const auto& from, const auto& to) {
    for (const auto& [key, value] : from) {
      const auto found = to.find(key);
      if (found == to.end() || !(found->second == value)) keys.insert(key);
    }
  };
  add(a, b);
  add(b, a);
  return keys;
}

std::size_t pin_count(const Edit& edit) {
  std::size_t count = edit.held.size();
  for (const SceneChanges* changes : {&edit.before, &edit.after}) {
    count += changes->pins.size() + changes->released.size() + changes->moved.size();
    for (const auto& [group, painted] : changes->painted) count += painted.factors.size() / 12;
  }
  return count;
}

/// Whether one is made of the other in the scene as it is.
bool differ_in_what_is_set_alone(const SceneChanges& a, SceneChanges b) {
  b.values = a.values;
  b.appearances = a.appearances;
  b.painted = a.painted;
  return a == b;
}

/// "stretch: stiffness"
std::string text_of(const pliant::Parameter& parameter) {
  std::string option = parameter.handle.option;
  std::ranges::replace(option, '_', ' ');
  return parameter.name.empty() ? option : parameter.name + ": " + option;
}

}  // namespace

void Session::remember(Edit edit) {
  edit.after = changes_;
  ++edit_count_;
  done_.push_back(std::move(edit));
  undone_.clear();
  if (done_.size() > most_edits) done_.erase(done_.begin());
  std::size_t pins = 0;
  for (const Edit& each : done_) pins += pin_count(each);
  for (; pins > most_pins && done_.size() > 1; done_.erase(done_.begin())) pins -= pin_count(done_.front());
}

void Session::set(const std::string& key, const pliant::Vec3& value, bool goes_on) {
  const auto noted = note(action::Set{key, value, goes_on});
  const std::vector<Slider> all = sliders();
  const auto found = std::ranges::find(all, key, &Slider::key);
  if (found == all.end() || found->parameter.value == value) return;
  const pliant::Parameter& parameter = found->parameter;
  set_parameter(scene_.simulation, parameter.handle, value);
  Edit edit{.what = text_of(parameter), .before = changes_};
  edit.old_values[key] = parameter.value;
  changes_.values.try_emplace(key, ChangedValue{parameter}).first->second.value = value;
  if (goes_on && !done_.empty() && done_.back().old_values.size() == 1 && done_.back().old_values.contains(key)) {
    done_.back().after = changes_;
    undone_.clear();
  } else {
    remember(std::move(edit));
  }
}

void Session::set_material(const std::string& body, const std::string& material) {
  const auto noted = note(action::SetMaterial{body, material});
  const pliant::BodyId id = find_body(body);
  const std::vector<Slider> before = sliders();
  // Threads lie as they did, also after a material that has none.
  const auto placement = placements_.emplace(body, present_placement(simulation(), id)).first;
  std::set<std::string> of_body;  // keys of what may go
  for (const Slider& slider : before) {
    const auto* group = std::get_if<pliant::GroupId>(&slider.parameter.handle.owner);
    if (group != nullptr && simulation().groups().at(*group).body == id) of_body.insert(slider.key);
  }
  const auto names_of_body = [&] {
    std::set<std::string> names;
    for (const auto& [group_id, group] : simulation().groups()) {
      if (group.body == id) names.insert(group.name);
    }
    return names;
  };
  std::set<std::string> removed = names_of_body();
  change_material(scene_, id, material, placement->second);
  ++look_changes_;
  for (const std::string& name : names_of_body()) removed.erase(name);
  Edit edit{.what = body + ": " + material, .before = changes_};
  for (const std::string& key : of_body) changes_.values.erase(key);
  for (const auto& [name, off] : switched_off()) {
    if (off.body != body || !off.goes_with_material) continue;
    removed.insert(name);
    std::erase_if(changes_.values,
                  [&, key = "group:" + name + "."](const auto& value) { return value.first.starts_with(key); });
    if (changes_.switched_off.erase(name) == 0) changes_.switched_on.insert(name);
  }
  changes_.values.erase("contact:" + body + ".friction");
  changes_.materials[body] = {material, placement->second};
  keep_paint_of(body, removed);
  for (const pliant::Parameter& now : list_parameters(simulation(), {})) {  // the settings
    const auto old = std::ranges::find(before, "settings." + now.handle.option, &Slider::key);
    if (old == before.end() || old->parameter.value == now.value) continue;
    edit.old_values[old->key] = old->parameter.value;
    changes_.values[old->key] = {now, now.value};
  }
  remember(std::move(edit));
  note_ = coarseness(scene_.materials.at(id), simulation().body(id).mesh);
}

/// What the text says, at its start, shown as this one is.
pliant::Scene Session::read_changed(pliant::SceneText text) const {
  pliant::SceneSource source;
  source.texts.push_back(std::move(text));
  source.leaves_out_events = true;
  pliant::Scene scene = parse_scene(std::move(source));
  scene.name = scene_.name;
  scene.view = scene_.view;
  return scene;
}

/// The scene with changes, at its start.
pliant::Scene Session::make_with(const SceneChanges& changes, const UnchangedScene& unchanged) const {
  if (!unchanged.has_text()) {
    pliant::Scene scene = make_();
    unchanged.apply(changes, scene);
    unchanged.set_appearances(changes, scene);
    return scene;
  }
  pliant::Scene scene = read_changed(unchanged.text_with(changes));
  set_values(unchanged.factors(changes), scene.simulation);
  return scene;
}

/// Takes a scene that was just made to where this one is.
void Session::carry_into(pliant::Scene& next, const SceneChanges& to, const std::set<std::string>& but) const {
  if (simulation().state().step == 0) return;
  NotCarried rules;
  rules.event_count = unchanged_.event_count();
  for (const auto& [number, why] : scene_.left_out) rules.left_out_of_from.push_back(number);
  for (const auto& [number, why] : next.left_out) rules.left_out_of_to.push_back(number);
  rules.idle_of_from = scene_.idle_events;
  rules.idle_of_to = next.idle_events;
  rules.values = difference(changes_.values, to.values);
  rules.values.insert(but.begin(), but.end());
  rules.bodies = difference(changes_.materials, to.materials);
  rules.pins = difference(changes_.pins, to.pins);
  rules.pins.merge(difference(changes_.moved, to.moved));
  rules.removed = unchanged_.removed_by_events(to);
  rules.is_hidden = [this](pliant::GroupId id) { return is_hidden(id); };
  carry_over(scene_, next, rules);
}

/// Goes on with another scene, from wherever that is.
void Session::settle(pliant::Scene next) {
  // What the changes have as events shows at once, not with the first step.
  const std::size_t own_events = unchanged_.event_count() - std::min(unchanged_.event_count(), next.left_out.size());
  if (next.simulation.state().step == 0 && next.timeline.event_count() > own_events) {
    next.timeline.act_due(next.simulation, 0, 0);
  }
  next.simulation.set_stop(stop_);
  renumber_colliders(next.simulation);
  for (const pliant::ColliderId collider : left_alone_) {
    if (next.simulation.colliders().contains(collider)) next.timeline.leave_alone(next.simulation, collider);
  }
  scene_ = std::move(next);
  note_ = scene_.left_out.empty() ? "" : "left out: " + scene_.left_out.front().second;
  of_hand_.clear();
  for (const auto& [id, group] : simulation().groups()) {
    if (unchanged_.is_of_hand(group.name)) of_hand_.insert(id);
  }
  pull_group_.reset();
}

/// The same with one that stands where this one does: the mouse holds what it held.
void Session::take(pliant::Scene next) {
  const Index threads = simulation().settings().threads;
  settle(std::move(next));
  if (simulation().settings().threads != threads) set_threads(threads);
  if (const std::optional<Pull> pull = std::exchange(pull_, {})) grab(*pull);
  ++rebuilds_;
}

void Session::go(const Edit& edit, const SceneChanges& from, const SceneChanges& to) {
  if (differ_in_what_is_set_alone(from, to)) {
    std::map<std::string, pliant::Vec3> values;
    for (const std::string& key : difference(from.values, to.values)) {
      const auto changed = to.values.find(key);
      const auto old = edit.old_values.find(key);
      if (changed != to.values.end()) {
        values[key] = changed->second.value;
      } else if (old != edit.old_values.end()) {
        values[key] = old->second;
      }
    }
    set_values(std::move(values), scene_.simulation);
    if (!(from.appearances == to.appearances) || !difference(from.materials, to.materials).empty()) set_looks(to);
    if (!(from.painted == to.painted)) set_painted(from, to);
    changes_ = to;
    return;
  }
  pliant::Scene next = make_with(to, unchanged_);
  std::map<pliant::ColliderId, pliant::Pose> starts;
  for (const std::string& name : difference(from.collider_poses, to.collider_poses)) {
    if (const auto id = next.simulation.find_collider(name)) starts[*id] = next.simulation.pose(*id);
  }
  carry_into(next, to);
  take(std::move(next));
  changes_ = to;
  if (simulation().state().step == 0) return;
  for (const auto& [id, start] : starts) goals_.goals[id] = start;
  std::vector<Index> held;
  for (const auto& [vertex, target] : edit.held) held.push_back(vertex);
  for (const auto& [vertex, pins] : find_pins(held)) {
    scene_.simulation.set_target(pins.front().group, pins.front().target, edit.held.at(vertex));
  }
}

void Session::undo() {
  const auto noted = note(action::Undo{});
  if (done_.empty()) return;
  go(done_.back(), done_.back().after, done_.back().before);
  undone_.push_back(std::move(done_.back()));
  done_.pop_back();
}

void Session::redo() {
  const auto noted = note(action::Redo{});
  if (undone_.empty()) return;
  go(undone_.back(), undone_.back().before, undone_.back().after);
  done_.push_back(std::move(undone_.back()));
  undone_.pop_back();
}

/// A value that was changed while time went on was changed from what an event had made of it; from the start on it is
/// changed from the scene's own.
void Session::take_old_values_of(const std::vector<Slider>& at_start) {
  std::map<std::string, pliant::Vec3> values;
  for (const Slider& slider : at_start) values[slider.key] = slider.parameter.value;
  for (std::vector<Edit>* edits : {&done_, &undone_}) {
    for (Edit& edit : *edits) {
      for (auto& [key, old] : edit.old_values) {
        if (const auto found = values.find(key); found != values.end()) old = found->second;
      }
    }
  }
}

void Session::restart(bool keep_changes) {
  const auto noted = note(action::Restart{keep_changes});
  pliant::Scene scene = make_();
  const bool is_as_opened = is_made_from(opened_, scene);
  const bool has_history = !changes_.is_empty() || !done_.empty() || !undone_.empty();
  const bool is_fresh = !keep_changes || (!has_history && saved_changes_.is_empty());
  if (is_fresh) begin_record(scene);
  UnchangedScene unchanged(scene);
  const std::vector<Slider> at_start = list_sliders(scene.simulation);
  if (keep_changes && !changes_.is_empty()) {
    pliant::Scene changed = make_with(changes_, unchanged);
    changed.name = scene.name;
    changed.view = scene.view;
    scene = std::move(changed);
  }
  if (keep_changes) {
    take_old_values_of(at_start);
  } else {
    changes_ = saved_changes_ = {};
    done_.clear();
    undone_.clear();
    placements_.clear();
  }
  unchanged_ = std::move(unchanged);
  pull_.reset();
  held_pins_.clear();
  goals_ = ColliderGoals(scene.simulation);
  left_alone_.clear();
  note_.clear();
  settle(std::move(scene));
  ++restarts_;
  if (!is_fresh && !is_as_opened) opened_.was_changed = true;
}

/// What is to be written to `file`, and the scene that it makes, at its start.
WrittenScene Session::write_text(const std::filesystem::path& file, const pliant::ViewSettings& view) const {
  namespace fs = std::filesystem;
  if (!unchanged_.has_text()) {
    pliant::fail_input("this scene was made by a program, not read from a scene file, so it cannot be saved as one");
  }
  const fs::path folder = file.parent_path();
  const auto text_of_file = [&](const pliant::SceneDocument& document) {
    return pliant::SceneText{file.string(), folder, document.text(folder.empty() ? "." : folder), fs::absolute(file)};
  };
  std::vector<std::string> unwritten;
  pliant::SceneDocument document = unchanged_.with(changes_, &unwritten);
  write_view(view, document);
  pliant::Scene scene = read_changed(text_of_file(document));
  UnchangedScene::remove_events(scene.left_out, document);
  scene.source.texts.at(0) = text_of_file(document);
  scene.source.leaves_out_events = false;
  return {std::move(scene), std::move(unwritten)};
}

std::string Session::text(const std::filesystem::path& file, const pliant::ViewSettings& view) const {
  return write_text(file, view).scene.source.texts.at(0).text;
}

/// What save() writes to `file`, and its scene at this moment.
WrittenScene Session::prepare_save(const std::filesystem::path& file, const pliant::ViewSettings& view) const {
  WrittenScene written = write_text(file, view);
  for (const auto& [key, factor] : unchanged_.factors(changes_)) written.factors.insert(key);
  carry_into(written.scene, changes_, written.factors);
  return written;
}

/// Goes on with the bits of what was saved.
void Session::go_on_as(WrittenScene written) {
  if (!written.factors.empty()) {
    written.scene = make_with(changes_, unchanged_);
    carry_into(written.scene, changes_);
  }
  take(std::move(written.scene));
  saved_changes_ = changes_;
  if (!written.unwritten.empty()) {
    note_ = "not saved: " + written.unwritten.front() + "; a scene file has no key for it";
  }
}

std::vector<std::filesystem::path> Session::save(const std::filesystem::path& file, const pliant::ViewSettings& view) {
  namespace fs = std::filesystem;
  const auto noted = note(action::Save{});
  WrittenScene written = prepare_save(file, view);
  std::vector<fs::path> files = {file};
  const fs::path checkpoint = fs::path(file).replace_extension(".pliant");
  std::error_code ignored;
  if (simulation().state().step > 0) {
    write_checkpoint(checkpoint, written.scene);
    files.push_back(checkpoint);
  } else {
    fs::remove(checkpoint, ignored);  // of what the file was before
  }
  pliant::write_file_atomically(file, written.scene.source.texts.at(0).text);
  go_on_as(std::move(written));
  return files;
}

}  // namespace pliant_viewer
