#include "viewer/session_record.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/base64.h"
#include "pliant_io/files/read_file.h"
#include "viewer/json_of.h"

namespace pliant_viewer {
namespace {

constexpr int format_version = 1;

/// In the order of Action.
constexpr std::array<std::string_view, std::variant_size_v<Action>> action_names = {
    "grab",      "pull_to",   "pull_stiffness", "let_go",         "pin",          "unpin",
    "move_pin",  "drop_pin",  "move_collider",  "drop_collider",  "set",          "set_material",
    "undo",      "redo",      "restart",        "save",           "pin_vertices", "unpin_vertices",
    "hold_pins", "move_held", "drop_held",      "set_appearance", "switch_on",    "add",
    "push",      "paint",     "turn_collider"};

/// Calls field(name, value) with what an action has.
template <class Action, class Field>
void visit_fields(Action& action, const Field& field) {
  if constexpr (requires { action.pull; }) {
    field("vertices", action.pull.point.vertices);
    field("weights", action.pull.point.weights);
    field("target", action.pull.target);
    field("stiffness", action.pull.stiffness);
  }
  if constexpr (requires { action.motion; }) {
    field("center", action.motion.center);
    field("rotation", action.motion.rotation);
    field("translation", action.motion.translation);
  }
  if constexpr (requires { action.dab; }) {
    field("vertices", action.dab.vertices);
    field("shares", action.dab.shares);
    field("factor", action.dab.factor);
  }
  if constexpr (requires { action.group; }) field("group", action.group);
  if constexpr (requires { action.vertices; }) field("vertices", action.vertices);
  if constexpr (requires { action.vertex; }) field("vertex", action.vertex);
  if constexpr (requires { action.collider; }) field("collider", action.collider);
  if constexpr (requires { action.target; }) field("target", action.target);
  if constexpr (requires { action.rotation; }) field("rotation", action.rotation);
  if constexpr (requires { action.stiffness; }) field("stiffness", action.stiffness);
  if constexpr (requires { action.key; }) field("key", action.key);
  if constexpr (requires { action.value; }) field("value", action.value);
  if constexpr (requires { action.goes_on; }) field("goes_on", action.goes_on);
  if constexpr (requires { action.body; }) field("body", action.body);
  if constexpr (requires { action.material; }) field("material", action.material);
  if constexpr (requires { action.appearance; }) field("appearance", action.appearance);
  if constexpr (requires { action.type; }) field("type", action.type);
  if constexpr (requires { action.name; }) field("name", action.name);
  if constexpr (requires { action.on; }) field("on", action.on);
  if constexpr (requires { action.keep_changes; }) field("keep_changes", action.keep_changes);
}

template <class Value>
Json json_of_field(const Value& value) {
  if constexpr (requires { value.x(); }) {
    return {value.x(), value.y(), value.z()};
  } else if constexpr (lists_options<Value>) {
    return json_of(value);
  } else {
    return value;
  }
}

Json json_of(const TimedAction& timed) {
  Json json = {{"step", timed.step}, {"do", action_name(timed.action)}};
  std::visit(
      [&](const auto& action) {
        visit_fields(action, [&](const char* name, const auto& value) { json[name] = json_of_field(value); });
      },
      timed.action);
  return json;
}

/// A value of the file with its place, for messages.
class Node {
 public:
  Node(const Json& json, std::string place) : json_(json), place_(std::move(place)) {}

  [[noreturn]] void fail(std::string_view what) const { pliant::fail_input(fmt::format("{}: {}", place_, what)); }
  Node at(const char* key) const {
    if (!json_.is_object() || !json_.contains(key)) fail(fmt::format("'{}' is missing", key));
    return {json_.at(key), fmt::format("{}.{}", place_, key)};
  }
  Node at(std::size_t i) const { return {json_.at(i), fmt::format("{}[{}]", place_, i)}; }
  std::size_t size() const {
    if (!json_.is_array()) fail("must be a list");
    return json_.size();
  }
  void check_size(std::size_t wanted) const {
    if (size() != wanted) fail(fmt::format("must have {} entries", wanted));
  }

  template <class Integer>
  Integer integer(Integer most) const {
    if (!json_.is_number_unsigned() && !(json_.is_number_integer() && json_.get<std::int64_t>() >= 0)) {
      fail("must be a whole number, 0 or more");
    }
    if (json_.get<std::uint64_t>() > static_cast<std::uint64_t>(most)) fail(fmt::format("is more than {}", most));
    return static_cast<Integer>(json_.get<std::uint64_t>());
  }
  void read(Index& value) const { value = integer(std::numeric_limits<Index>::max()); }
  void read(std::uint32_t& value) const { value = integer(std::numeric_limits<std::uint32_t>::max()); }
  void read(bool& value) const {
    if (!json_.is_boolean()) fail("must be true or false");
    value = json_.get<bool>();
  }
  void read(std::string& value) const {
    if (!json_.is_string()) fail("must be a text");
    value = json_.get<std::string>();
  }
  template <class Number>
  requires std::is_floating_point_v<Number>
  void read(Number& value) const {
    if (!json_.is_number()) fail("must be a number");
    const auto number = json_.get<double>();
    if (!(std::abs(number) <= static_cast<double>(std::numeric_limits<Number>::max()))) fail("is too large");
    value = static_cast<Number>(number);
  }
  void read(std::array<std::uint32_t, 3>& values) const {
    check_size(3);
    for (std::size_t i = 0; i < 3; ++i) at(i).read(values[i]);
  }
  template <class Number>
  void read(std::vector<Number>& values) const {
    values.resize(size());
    for (std::size_t i = 0; i < values.size(); ++i) at(i).read(values[i]);
  }
  template <class Number>
  void read(Eigen::Matrix<Number, 3, 1>& vector) const {
    check_size(3);
    for (std::size_t i = 0; i < 3; ++i) at(i).read(vector[static_cast<Eigen::Index>(i)]);
  }
  void read(pliant::Color& color) const {
    std::array<Real*, 3> shares = {&color.red, &color.green, &color.blue};
    check_size(shares.size());
    for (std::size_t i = 0; i < shares.size(); ++i) {
      at(i).read(*shares[i]);
      if (!(*shares[i] >= 0 && *shares[i] <= 1)) at(i).fail("must be from 0 to 1");
    }
  }
  template <class Value>
  void read(std::optional<Value>& value) const {
    read(value.emplace());
  }
  template <class Choice>
  requires std::is_enum_v<Choice>
  void read(Choice& choice) const {
    std::string name;
    read(name);
    const auto names = choice_names(choice);
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) fail(fmt::format("'{}' is not known", pliant::printable(name)));
    choice = static_cast<Choice>(found - names.begin());
  }
  /// What is not there stays as it is.
  template <lists_options Options>
  void read(Options& options) const {
    if (!json_.is_object()) fail("must be an object");
    Options::visit(options, [&](const pliant::OptionInfo& info, auto& value) {
      const std::string name(info.name);
      if (!json_.contains(name)) return;
      const Node node = at(name.c_str());
      node.read(value);
      if constexpr (std::is_floating_point_v<std::remove_reference_t<decltype(value)>>) {
        if (!(value >= info.range.min && value <= info.range.max)) node.fail("is out of range");
      }
    });
  }

 private:
  const Json& json_;
  std::string place_;
};

/// The action of that number, as it is made.
template <std::size_t i = 0>
Action make_action(std::size_t number) {
  if constexpr (i + 1 < std::variant_size_v<Action>) {
    if (number != i) return make_action<i + 1>(number);
  }
  return Action(std::in_place_index<i>);
}

TimedAction read_action(const Node& node) {
  std::string name;
  node.at("do").read(name);
  const auto found = std::ranges::find(action_names, name);
  if (found == action_names.end()) node.at("do").fail(fmt::format("'{}' is not known", pliant::printable(name)));
  TimedAction timed{node.at("step").integer(std::numeric_limits<std::int64_t>::max()),
                    make_action(static_cast<std::size_t>(found - action_names.begin()))};
  std::visit(
      [&](auto& action) { visit_fields(action, [&](const char* key, auto& value) { node.at(key).read(value); }); },
      timed.action);
  const auto* grab = std::get_if<action::Grab>(&timed.action);
  if (grab == nullptr) return timed;
  const Vec3f& weights = grab->pull.point.weights;
  if (!(weights.minCoeff() >= 0) || !(weights.sum() > 0.5F && weights.sum() < 1.5F)) {
    node.at("weights").fail("must be 0 or more, with the sum 1");
  }
  if (!(grab->pull.stiffness > 0)) node.at("stiffness").fail("must be more than 0");
  return timed;
}

void read_list(const Node& node, SessionRecord& record) {
  const Node actions = node.at("actions"), checksums = node.at("checksums");
  std::int64_t step = 0;
  for (std::size_t i = 0; i < actions.size(); ++i) {
    record.actions.push_back(read_action(actions.at(i)));
    const std::int64_t last = std::exchange(step, record.actions.back().step);
    if (step < last || step > record.steps)
      actions.at(i).at("step").fail("steps must ascend, up to those of the session");
  }
  step = -1;
  for (std::size_t i = 0; i < checksums.size(); ++i) {
    checksums.at(i).check_size(2);
    StepChecksum& checksum = record.checksums.emplace_back();
    checksum.step = checksums.at(i).at(std::size_t{0}).integer(record.steps);
    checksums.at(i).at(std::size_t{1}).read(checksum.crc32);
    if (checksum.step <= std::exchange(step, checksum.step)) checksums.at(i).fail("steps must ascend");
  }
}

}  // namespace

std::string_view action_name(const Action& action) {
  return action_names.at(action.index());
}

std::int64_t SessionRecord::last_start() const {
  const auto found = std::find_if(actions.rbegin(), actions.rend(), [](const TimedAction& timed) {
    return std::holds_alternative<action::Restart>(timed.action);
  });
  return found == actions.rend() ? 0 : found->step;
}

bool is_made_from(const OpenedScene& opened, const pliant::Scene& scene) {
  const auto is_same_text = [](const pliant::SceneText& a, const pliant::SceneText& b) { return a.text == b.text; };
  const auto is_same_file = [](const pliant::SceneFile& a, const pliant::SceneFile& b) {
    return a.path == b.path && a.size == b.size && a.crc32 == b.crc32;
  };
  return std::ranges::equal(opened.source.texts, scene.source.texts, is_same_text) &&
         std::ranges::equal(opened.files, scene.files, is_same_file);
}

void write_session_record(const std::filesystem::path& file, const SessionRecord& record) {
  Json actions = Json::array(), checksums = Json::array();
  for (const TimedAction& timed : record.actions) actions.push_back(json_of(timed));
  for (const StepChecksum& checksum : record.checksums) checksums.push_back({checksum.step, checksum.crc32});
  const Json json = {{"pliant_session", format_version},
                     {"scene", std::string(pliant::printable(record.scene))},
                     {"steps", record.steps},
                     {"actions", std::move(actions)},
                     {"checksums", std::move(checksums)},
                     {"start", pliant::base64(record.start)}};
  pliant::write_file_atomically(file, json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

SessionRecord read_session_record(const std::filesystem::path& file) {
  const std::string text = pliant::read_file(file);
  const std::string place = pliant::printable_place(file.string());
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("pliant_session")) {
    pliant::fail_input(place + ": not a recorded session, or cut; the window writes them with Ctrl + R");
  }
  const Node node(json, place);
  if (node.at("pliant_session").integer(1'000'000) != format_version) {
    node.at("pliant_session").fail(fmt::format("must be {}: this program reads no other format", format_version));
  }
  SessionRecord record;
  node.at("scene").read(record.scene);
  record.steps = node.at("steps").integer(std::int64_t{1} << 40);
  read_list(node, record);
  std::string start;
  node.at("start").read(start);
  std::optional<std::string> bytes = pliant::bytes_of_base64(start);
  if (!bytes) node.at("start").fail("not base64");
  record.start = std::move(*bytes);
  return record;
}

std::function<pliant::Scene()> scene_maker_of(const SessionRecord& record, const std::filesystem::path& file) {
  auto first = std::make_shared<pliant::Scene>(pliant::parse_checkpoint(record.start, file.string()));
  return [first, source = first->source]() mutable {
    if (first == nullptr) return pliant::parse_scene(source);
    return std::move(*std::exchange(first, nullptr));
  };
}

}  // namespace pliant_viewer
