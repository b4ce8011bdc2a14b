#include "pliant_io/scene/detail/read_motion.h"

#include "pliant_io/mesh/follow_cache.h"
#include "pliant_io/mesh/point_cache_format.h"
#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/scene_files.h"
#include "pliant_io/scene/detail/scene_reader.h"

namespace pliant {

void read(const Node& node, std::vector<Index>& numbers) {
  numbers.clear();
  if (!node.is_list()) return read(node, numbers.emplace_back());
  if (node.size() == 0) node.fail("the list is empty; fill it, or leave out the key");
  for (std::size_t i = 0; i < node.size(); ++i) read(node[i], numbers.emplace_back());
}

void read(const Node& node, Rotation& rotation) {
  read_options(node, rotation);
  node.require("degrees");
  node.require("axis").locate([&] { return rotation.vector(); });
}

void read(const Node& node, std::vector<Keyframe>& keyframes) {
  node.require_list();
  if (node.size() == 0) node.fail("the list is empty; give one key or more");
  keyframes.clear();
  for (std::size_t i = 0; i < node.size(); ++i) {
    Keyframe& key = keyframes.emplace_back();
    read_options(node[i], key);
    node[i].require("time");
  }
}

EventPath read_move(const Node& node, std::vector<std::string_view> more_keys) {
  MoveOptions options;
  read_options(node, options, std::move(more_keys));
  const std::string_view kind = node.require_one_of({"target", "offset", "rotate", "keyframes"});
  const bool turns = kind == "rotate" || kind == "keyframes";
  if (const auto center = node.find("center"); center && !turns) {
    center->fail(fmt::format("'{}' turns nothing; leave out the center, or use rotate or keyframes", kind));
  }
  if (const auto over = node.find("over"); over && kind == "keyframes") {
    over->fail("the times of the keyframes say how long the move takes; leave out 'over'");
  }
  const auto make = [&]() -> std::shared_ptr<Path> {
    if (kind == "target") return straight_path(MoveKind::target, options.target, options.over, options.ease);
    if (kind == "offset") return straight_path(MoveKind::offset, options.offset, options.over, options.ease);
    if (kind == "keyframes") return rigid_path(options.keyframes, options.center, options.ease);
    if (!(options.over >= 0)) fail_input(fmt::format("{} s is not a duration; give a number from 0 up", options.over));
    return rigid_path({{.time = options.over, .rotate = *options.rotate}}, options.center, options.ease);
  };
  return {node.locate(make), options.index};
}

EventPath read_follow(const Node& node, std::vector<std::string_view> more_keys, const SceneReader& scene) {
  FollowOptions options;
  const bool is_file = node.has("file");
  more_keys.insert(more_keys.end(), {"body", "file"});
  FileOptions file_options;
  if (is_file) {
    FileOptions::visit(file_options, [&](const OptionInfo& info, const auto&) { more_keys.push_back(info.name); });
    FileOptions::visit(file_options, OptionReader{node});
  }
  read_options(node, options, std::move(more_keys));
  const std::string_view kind = node.require_one_of({"body", "file"});
  if (kind == "body") {
    const BodyId body = scene.read_body_name(node);
    return {follow_body(body, options.vertices, options.attach), options.index};
  }
  const Node file = node.require(kind);
  node.locate([&] { check_options("follow", file_options); });
  const PointCacheFormat format = file.locate([&] { return require_point_cache_format(read_path(file)); });
  NamedFile named = read_named_file(file);
  PointCache cache = file.locate([&] {
    return PointCache::parse(std::move(named.bytes), named.path.string(), format,
                             {.frames_per_second = file_options.frames_per_second});
  });
  return {follow_cache(std::move(cache), options.vertices, options.attach), options.index};
}

}  // namespace pliant
