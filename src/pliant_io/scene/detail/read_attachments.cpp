// What ties bodies to each other.
#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/scene_reader.h"

namespace pliant {
namespace {

/// What is changed of an attachment but its options.
struct Side {
  BodyId body{};
  Selection on{};
};

Side read_side(const Node& node, const SceneReader& scene) {
  node.check_keys({"body", "on"});
  Side side;
  side.body = scene.named_body(node.require("body"));
  if (const auto on = node.find("on")) side.on = read_selection(*on, scene.body(side.body));
  return side;
}

}  // namespace

GroupEntry SceneReader::read_attachment(const Node& node, std::vector<std::string_view> more_keys) const {
  more_keys.insert(more_keys.end(), {"name", "from", "to"});
  Attachment attachment;
  read_options(node, attachment, std::move(more_keys));
  const Side from = read_side(node.require("from"), *this);
  const Side to = read_side(node.require("to"), *this);
  attachment.on = from.on;
  attachment.to = to.body;
  attachment.to_on = to.on;
  return {from.body, std::move(attachment)};
}

void SceneReader::add_attachment(const Node& node) {
  GroupEntry read = read_attachment(node, {"enabled"});
  add_group(node, read.body, std::move(read.options), entry);
}

GroupEntry SceneReader::read_added_group(const Node& node) const {
  std::string type;
  read(node.require("type"), type);
  if (type == Attachment::info.name) return read_attachment(node, {"type"});
  const BodyId on = read_body_name(node);
  return {on, read_constraint_options(node, {"name", "body"}, body(on))};
}

}  // namespace pliant
