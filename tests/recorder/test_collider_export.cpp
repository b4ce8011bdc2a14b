// Colliders in glTF and USD files, read as their specifications say.
#include <cmath>
#include <fstream>
#include <sstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "../support/temporary_folder.h"
#include "pliant/collision/colliders/builtin.h"
#include "pliant/collision/colliders/surface.h"
#include "pliant/mesh/shapes.h"
#include "pliant_io/export/export.h"

namespace test_collider_export {

using namespace pliant;
using nlohmann::json;

namespace {

AnimatedCollider collider_of(std::string name, const PlacedShape& placed, std::vector<Real> times,
                             std::vector<Pose> poses) {
  AnimatedCollider collider{std::move(name), placed.shape->surface(2), {}, std::move(times), std::move(poses)};
  collider.normals = corner_normals(*placed.shape, collider.surface);
  return collider;
}

/// A still sheet, a ball that turns about z and rises, and a floor.
Animation stage() {
  const Mesh mesh = grid({.columns = 3, .rows = 3});
  const std::vector<Real> times = {0.5, 0.6, 0.7};
  const std::vector<Positions> frames(3, mesh.vertices);
  Animation animation = animate(mesh, "run", PointCache::from_frames(frames, times));
  std::vector<Pose> poses;
  for (int i = 0; i < 3; ++i) poses.push_back(moved_on({{1, 2, 3}}, {0, 0, 1}, {0, 0, 0.5}, i));
  animation.colliders = {collider_of("ball", build(BoxCollider{.size = {1, 2, 3}, .rounding = 0.2}), times, poses),
                         collider_of("floor", build(PlaneCollider{}), {0.5}, {{{0, 0, -1}}})};
  return animation;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Glb {
  json document;
  std::string buffer;

  explicit Glb(const std::string& bytes) {
    const auto word = [&](std::size_t at) {
      std::uint32_t value = 0;
      std::memcpy(&value, bytes.data() + at, sizeof value);
      return std::size_t{value};
    };
    document = json::parse(bytes.substr(20, word(12)));
    buffer = bytes.substr(28 + word(12));
  }
  std::vector<float> floats(std::size_t accessor) const {
    const json& one = document["accessors"][accessor];
    const json& view = document["bufferViews"][one["bufferView"].get<std::size_t>()];
    const std::map<std::string, std::size_t> widths = {{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
    std::vector<float> result(one["count"].get<std::size_t>() * widths.at(one["type"]));
    std::memcpy(result.data(), buffer.data() + view["byteOffset"].get<std::size_t>(), 4 * result.size());
    return result;
  }
  const json& node(const std::string& name) const {
    for (const json& each : document["nodes"]) {
      if (each["name"] == name) return each;
    }
    throw std::runtime_error("no node " + name);
  }
};

}  // namespace

TEST_CASE("glTF has colliders as rigid nodes, which move as the poses say, with y up") {
  const pliant_tests::TemporaryFolder folder;
  const Animation animation = stage();
  const auto path = folder.path() / "run.glb";
  export_animation(path, animation);
  const Glb glb(text_of(path));
  REQUIRE(glb.document["nodes"].size() == 3);
  const json& animations = glb.document["animations"];
  REQUIRE(animations.size() == 1);
  REQUIRE(animations[0]["channels"].size() == 2);  // of the ball alone
  for (const json& channel : animations[0]["channels"]) {
    CHECK(glb.document["nodes"][channel["target"]["node"].get<std::size_t>()]["name"] == "ball");
    const json& sampler = animations[0]["samplers"][channel["sampler"].get<std::size_t>()];
    const std::vector<float> times = glb.floats(sampler["input"]), values = glb.floats(sampler["output"]);
    REQUIRE(times.size() == 3);
    CHECK(times[2] == doctest::Approx(0.2));
    for (std::size_t i = 0; i < 3; ++i) {
      const Pose& pose = animation.colliders[0].poses[i];
      if (channel["target"]["path"] == "translation") {
        CHECK(values[3 * i] == doctest::Approx(pose.position.x()));
        CHECK(values[3 * i + 1] == doctest::Approx(pose.position.z()));
        CHECK(values[3 * i + 2] == doctest::Approx(-pose.position.y()));
      } else {
        CHECK(channel["target"]["path"] == "rotation");
        CHECK(values[4 * i + 1] == doctest::Approx(std::sin(0.25 * static_cast<double>(i))));  // about y, theirs
        CHECK(values[4 * i + 3] == doctest::Approx(std::cos(0.25 * static_cast<double>(i))));
      }
    }
  }
  const json& ball = glb.document["meshes"][glb.node("ball")["mesh"].get<std::size_t>()]["primitives"][0];
  const std::vector<float> positions = glb.floats(ball["attributes"]["POSITION"]);
  const std::vector<float> normals = glb.floats(ball["attributes"]["NORMAL"]);
  REQUIRE(positions.size() == normals.size());
  const PlacedShape shape = build(BoxCollider{.size = {1, 2, 3}, .rounding = 0.2});
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
    const Vec3 place(positions[i], -positions[i + 2], positions[i + 1]);
    const Vec3 normal(normals[i], -normals[i + 2], normals[i + 1]);
    CHECK(std::abs(shape.shape->distance(place).distance) < 1e-6);
    CHECK(shape.shape->distance(place + 0.05 * normal).distance == doctest::Approx(0.05).epsilon(0.01));
  }
  CHECK(positions.size() < 3 * 3 * animation.colliders[0].surface.triangles.size() / 2);  // corners are shared
  CHECK(glb.node("floor")["translation"] == json({0, -1, 0}));
}

TEST_CASE("USD has colliders under transforms over time") {
  const pliant_tests::TemporaryFolder folder;
  const auto path = folder.path() / "run.usda";
  export_animation(path, stage());
  const std::string text = text_of(path);
  const std::size_t ball = text.find("def Xform \"ball\""), floor = text.find("def Xform \"floor\"");
  REQUIRE(ball < floor);
  REQUIRE(floor != text.npos);
  const std::string of_ball = text.substr(ball, floor - ball), of_floor = text.substr(floor);
  CHECK(of_ball.find("double3 xformOp:translate.timeSamples = {") != text.npos);
  CHECK(of_ball.find("        0: (1, 2, 3),") != text.npos);
  CHECK(of_ball.find("        2: (1, 2, 5),") != text.npos);
  CHECK(of_ball.find("quatd xformOp:orient.timeSamples = {") != text.npos);
  CHECK(of_floor.find("double3 xformOp:translate = (0, 0, -1)") != text.npos);
  CHECK(of_floor.find("point3f[] points = [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)]") != text.npos);
  CHECK(of_floor.find("normal3f[] normals = [(0, 0, 1), ") != text.npos);
}

/// A box that stands still and is there in the middle frame alone, a sphere that moves and goes before the last frame,
/// and one that is never there.
Animation visitors() {
  Animation animation = stage();
  const std::vector<Real> times = animation.times;
  std::vector<AnimatedCollider>& colliders = animation.colliders;
  colliders = {collider_of("visitor", build(BoxCollider{}), {0.6}, {{{4, 5, 6}}}),
               collider_of("leaver", build(SphereCollider{}), {0.5, 0.6}, {{{0, 0, 0}}, {{0, 0, 1}}}),
               collider_of("absent", build(SphereCollider{}), {0.9}, {{}})};
  colliders[0].from = times[1];
  colliders[0].until = colliders[1].until = times[2];
  colliders[2].from = 0.9;
  return animation;
}

TEST_CASE("glTF scales a collider to nothing, in steps, while it is not there") {
  const pliant_tests::TemporaryFolder folder;
  const auto path = folder.path() / "run.glb";
  export_animation(path, visitors());
  const Glb glb(text_of(path));
  REQUIRE(glb.document["nodes"].size() == 3);  // the sheet is one of them
  CHECK(glb.node("visitor")["scale"] == json({0, 0, 0}));
  CHECK_FALSE(glb.node("leaver").contains("scale"));
  std::map<std::string, std::vector<float>> sizes;
  std::map<std::string, std::vector<std::string>> paths;
  for (const json& channel : glb.document["animations"][0]["channels"]) {
    const std::string name = glb.document["nodes"][channel["target"]["node"].get<std::size_t>()]["name"];
    paths[name].push_back(channel["target"]["path"]);
    if (channel["target"]["path"] != "scale") continue;
    const json& sampler = glb.document["animations"][0]["samplers"][channel["sampler"].get<std::size_t>()];
    CHECK(sampler["interpolation"] == "STEP");
    const std::vector<float> times = glb.floats(sampler["input"]);
    REQUIRE(times.size() == 3);
    CHECK(times[1] == doctest::Approx(0.1));
    sizes[name] = glb.floats(sampler["output"]);
  }
  CHECK(paths["visitor"] == std::vector<std::string>{"scale"});
  CHECK(paths["leaver"] == std::vector<std::string>{"translation", "rotation", "scale"});
  CHECK(sizes["visitor"] == std::vector<float>{0, 0, 0, 1, 1, 1, 0, 0, 0});
  CHECK(sizes["leaver"] == std::vector<float>{1, 1, 1, 1, 1, 1, 0, 0, 0});
}

TEST_CASE("USD hides a collider while it is not there") {
  const pliant_tests::TemporaryFolder folder;
  const auto path = folder.path() / "run.usda";
  export_animation(path, visitors());
  const std::string text = text_of(path);
  const std::size_t visitor = text.find("def Xform \"visitor\""), leaver = text.find("def Xform \"leaver\"");
  REQUIRE(visitor < leaver);
  REQUIRE(leaver != text.npos);
  CHECK(text.find("absent") == text.npos);
  const auto visibility_of = [](const std::string& prim) {
    const std::string_view head = "token visibility.timeSamples = {";
    const std::size_t begin = prim.find(head) + head.size();
    std::string samples = prim.substr(begin, prim.find('}', begin) - begin);
    std::erase_if(samples, [](char c) { return c == ' ' || c == '\n'; });
    return samples;
  };
  CHECK(visibility_of(text.substr(visitor, leaver - visitor)) == R"(0:"invisible",1:"inherited",2:"invisible",)");
  CHECK(visibility_of(text.substr(leaver)) == R"(0:"inherited",2:"invisible",)");
  export_animation(folder.path() / "stage.usda", stage());
  CHECK(text_of(folder.path() / "stage.usda").find("visibility") == std::string::npos);
}

TEST_CASE("of a single frame an export has the colliders that are there") {
  const pliant_tests::TemporaryFolder folder;
  Animation animation = visitors();
  keep_frames(animation, {.first = 2, .last = 2});
  export_animation(folder.path() / "last.glb", animation);
  const Glb last(text_of(folder.path() / "last.glb"));
  CHECK(last.document["nodes"].size() == 1);
  animation = visitors();
  keep_frames(animation, {.first = 1, .last = 1});
  export_animation(folder.path() / "middle.glb", animation);
  const Glb middle(text_of(folder.path() / "middle.glb"));
  CHECK(middle.node("leaver")["translation"] == json({0, 1, 0}));
  CHECK_FALSE(middle.node("visitor").contains("scale"));
  CHECK(middle.document["nodes"].size() == 3);
}

TEST_CASE("poses between frames are on the way, and at rest before and after") {
  const Animation animation = stage();
  const AnimatedCollider& ball = animation.colliders[0];
  CHECK(ball.moves());
  CHECK_FALSE(animation.colliders[1].moves());
  CHECK(ball.pose_at(0.65).position.z() == doctest::Approx(4.5));
  CHECK(ball.pose_at(0.65).rotation.angularDistance(pliant::Pose{}.rotation) == doctest::Approx(0.75));
  CHECK(ball.pose_at(0) == ball.poses.front());
  CHECK(ball.pose_at(9) == ball.poses.back());
}

}  // namespace test_collider_export
