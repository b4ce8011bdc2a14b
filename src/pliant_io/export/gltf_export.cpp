// glTF 2.0 (Khronos Group, specification 2.0.1; section numbers are its own).
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant_io/export/detail/export_formats.h"
#include "pliant_io/export/detail/gltf_document.h"
#include "pliant_io/export/detail/gltf_materials.h"
#include "pliant_io/export/detail/gltf_surface.h"
#include "pliant_io/recorder/detail/array_format.h"

namespace pliant {
namespace {

using OrderedJson = nlohmann::ordered_json;
using Vec3f = Eigen::Vector3f;

enum class Mode { points = 0, lines = 1, triangles = 4 };  // Sec. 5.24.4

/// Ours has +z up, glTF +y; a quarter turn about x (Sec. 3.4).
Vec3f y_up(const Vec3f& v) {
  return {v[0], v[2], -v[1]};
}

/// The same triangles seen from the other side.
std::vector<Index> turned(std::vector<Index> triangles) {
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) std::swap(triangles[i + 1], triangles[i + 2]);
  return triangles;
}

class GltfExport {
 public:
  GltfExport(const Animation& animation, const std::vector<std::size_t>& frames, const ExportOptions& options)
      : animation_(animation),
        frames_(frames),
        normals_(options.normals),
        looks_(options.looks),
        collider_looks_(options.collider_looks) {
    for (std::size_t body = 0; body < animation.bodies.size(); ++body) add_body(body);
    for (const AnimatedCollider& collider : animation.colliders) add_collider(collider);
    add_animation();
  }

  GltfDocument& document() { return document_; }

 private:
  /// Positions of a surface's vertices in a frame, and their normals.
  struct Shape {
    std::vector<Eigen::Vector3d> positions;
    std::vector<Eigen::Vector3d> normals;
  };

  /// What the primitives of a body's front have, and those of its back, whose normals are turned.
  struct Side {
    OrderedJson attributes;
    OrderedJson targets;  ///< null where nothing moves
  };

  struct BodyMaterials {
    std::size_t front;                ///< of triangles
    std::optional<std::size_t> back;  ///< of triangles seen from behind, where they look otherwise
    std::size_t strokes;              ///< of lines and points
  };

  /// A collider whose node is animated.
  struct MovingCollider {
    std::size_t node;
    const AnimatedCollider* collider;
    bool comes_or_goes;
  };

  void add_body(std::size_t number) {
    const Body& body = animation_.bodies[number];
    if (body.mesh.vertex_count() == 0) return;
    const GltfSurface surface(body.mesh);
    const Shape rest = shape(body, surface, frames_.front());
    const bool is_moving = moves(body);
    const Side front = front_side(body, surface, rest, is_moving);
    OrderedJson primitives = OrderedJson::array();
    const auto add_primitive = [&](Mode mode, const std::vector<Index>& indices, const Side& side,
                                   std::size_t material_index) {
      OrderedJson primitive = {
          {"attributes", side.attributes}, {"material", material_index}, {"mode", static_cast<int>(mode)}};
      if (mode != Mode::triangles) primitive["attributes"].erase("TEXCOORD_0");
      if (!indices.empty()) primitive["indices"] = document_.add_indices(indices);
      if (!side.targets.empty()) primitive["targets"] = side.targets;
      primitives.push_back(std::move(primitive));
    };
    const BodyMaterials materials = materials_of(number, surface);
    if (!surface.triangles.empty()) add_primitive(Mode::triangles, surface.triangles, front, materials.front);
    if (materials.back) {
      add_primitive(Mode::triangles, turned(surface.triangles), back_side(body, surface, rest, front), *materials.back);
    }
    if (!surface.lines.empty()) add_primitive(Mode::lines, surface.lines, front, materials.strokes);
    if (primitives.empty()) add_primitive(Mode::points, {}, front, materials.strokes);
    add_node(body.name, std::move(primitives), is_moving);
  }

  BodyMaterials materials_of(std::size_t number, const GltfSurface& surface) {
    if (number >= looks_.size() || !looks_[number]) {
      const std::size_t material = document_.add("materials", gltf_material_of_body(number));
      return {material, {}, material};
    }
    SurfaceLook look = *looks_[number];
    if (surface.texture.empty()) look.front.image = look.back.image = nullptr;
    const bool has_two_sides = !surface.triangles.empty() && !are_alike(look.front, look.back);
    const SurfaceFinish finish = look.finish.value_or(SurfaceFinish{});
    BodyMaterials result{};
    result.front = result.strokes = material_of(look.front, finish, has_two_sides ? Sides::one : Sides::both);
    if (has_two_sides) result.back = material_of(look.back, finish, Sides::one);
    if (look.front.image && !surface.lines.empty()) {
      result.strokes = material_of({look.front.color, nullptr}, finish, Sides::both);
    }
    return result;
  }

  /// Bodies that look alike share a material.
  std::size_t material_of(const SurfaceSide& side, const SurfaceFinish& finish, Sides sides) {
    GltfLook look{light_of(side.color), {}, finish};
    if (side.image) look = {{1, 1, 1}, texture_of(*side.image), finish};
    const auto [known, is_new] =
        materials_.try_emplace({look.light, look.texture, finish.is_metal, finish.roughness, sides});
    if (is_new) known->second = document_.add("materials", gltf_material(look, sides));
    return known->second;
  }

  /// The same of colliders, and one for all that have no look of their own.
  std::size_t material_of(const AnimatedCollider& collider) {
    const auto look = collider_looks_.find(collider.name);
    if (look != collider_looks_.end()) {
      return material_of({look->second.front.color, nullptr}, look->second.finish.value_or(SurfaceFinish{}),
                         Sides::both);
    }
    if (!collider_material_) {
      collider_material_ = document_.add("materials", gltf_material({collider_light}, Sides::both));
    }
    return *collider_material_;
  }

  /// Pictures of the same bytes are there once.
  std::size_t texture_of(const SurfaceImage& image) {
    const auto [known, is_new] = textures_.try_emplace(image.bytes);
    if (is_new) known->second = document_.add_texture(image);
    return known->second;
  }

  Side front_side(const Body& body, const GltfSurface& surface, const Shape& rest, bool is_moving) {
    const bool has_normals = normals_ == Normals::smooth && !surface.triangles.empty();
    Side side{{{"POSITION", document_.add_vectors(y_up_floats(rest.positions), true)}}, {}};
    if (has_normals) side.attributes["NORMAL"] = document_.add_vectors(y_up_floats(rest.normals), false);
    if (!surface.texture.empty()) {
      side.attributes["TEXCOORD_0"] = document_.add_texture_coordinates(surface.texture);
    }
    if (is_moving) side.targets = add_targets(body, surface, rest, has_normals);
    return side;
  }

  /// The front's, with normals that point the other way.
  Side back_side(const Body& body, const GltfSurface& surface, const Shape& rest, const Side& front) {
    Side side = front;
    if (!side.attributes.contains("NORMAL")) return side;
    const auto turn = [](std::vector<Vec3f> vectors) {
      for (Vec3f& vector : vectors) vector = -vector;
      return vectors;
    };
    side.attributes["NORMAL"] = document_.add_vectors(turn(y_up_floats(rest.normals)), false);
    for (std::size_t i = 0; i < side.targets.size(); ++i) {
      const Shape moved = shape(body, surface, frames_[i + 1]);
      side.targets[i]["NORMAL"] = document_.add_vectors(turn(differences(moved.normals, rest.normals)), false);
    }
    return side;
  }

  /// A node that moves as a whole.
  void add_collider(const AnimatedCollider& collider) {
    const auto is_there = [&](Real time) { return collider.is_there(time); };
    if (collider.surface.triangles.empty() || std::ranges::none_of(animation_.times, is_there)) return;
    const SplitCorners corners(collider.surface, collider.normals);
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals;
    for (Eigen::Index i = 0; i < corners.positions.rows(); ++i) {
      positions.push_back(y_up(single_precision(corners.positions, static_cast<Index>(i))));
      normals.push_back(y_up(corners.normals.row(i).transpose().cast<float>().normalized()));
    }
    OrderedJson attributes = {{"POSITION", document_.add_vectors(positions, true)}};
    if (normals_ == Normals::smooth) attributes["NORMAL"] = document_.add_vectors(normals, false);
    const OrderedJson primitive = {{"attributes", std::move(attributes)},
                                   {"material", material_of(collider)},
                                   {"mode", static_cast<int>(Mode::triangles)},
                                   {"indices", document_.add_indices(corners.triangles)}};
    const std::size_t mesh = document_.add("meshes", {{"name", collider.name}, {"primitives", {primitive}}});
    const Pose pose = collider.pose_at(animation_.times.front());
    const Vec3f place = y_up(pose.position.cast<float>());
    const std::array<float, 4> turn = rotation(pose);
    const std::size_t node = document_.add(
        "nodes",
        {{"name", collider.name}, {"mesh", mesh}, {"translation", {place[0], place[1], place[2]}}, {"rotation", turn}});
    document_["scenes"][0]["nodes"].push_back(node);
    if (!is_there(animation_.times.front())) document_["nodes"][node]["scale"] = {0, 0, 0};
    const bool comes_or_goes = !std::ranges::all_of(animation_.times, is_there);
    if ((collider.moves() || comes_or_goes) && animation_.times.size() > 1) {
      moving_colliders_.push_back({node, &collider, comes_or_goes});
    }
  }

  /// x, y, z, w of a rotation, with y up.
  static std::array<float, 4> rotation(const Pose& pose) {
    const Vec3f axis = y_up(pose.rotation.vec().cast<float>());
    return {axis[0], axis[1], axis[2], static_cast<float>(pose.rotation.w())};
  }

  void add_node(const std::string& name, OrderedJson primitives, bool is_moving) {
    OrderedJson mesh = {{"name", name}, {"primitives", std::move(primitives)}};
    if (is_moving) {
      mesh["weights"] = std::vector<int>(frames_.size() - 1, 0);
      OrderedJson names = OrderedJson::array();
      for (std::size_t key = 1; key < frames_.size(); ++key) names.push_back(fmt::format("frame {}", frames_[key]));
      mesh["extras"] = {{"targetNames", std::move(names)}};  // as Blender and three.js read them
    }
    const std::size_t node =
        document_.add("nodes", {{"name", name}, {"mesh", document_.add("meshes", std::move(mesh))}});
    document_["scenes"][0]["nodes"].push_back(node);
    if (is_moving) moving_nodes_.push_back(node);
  }

  bool moves(const Body& body) {
    const auto part = [&](std::size_t frame) {
      Positions all;
      animation_.cache.sample(animation_.times[frame], all);
      return Positions(all.middleRows(body.first_vertex, body.mesh.vertex_count()));
    };
    const Positions rest = part(frames_.front());
    return std::any_of(frames_.begin() + 1, frames_.end(), [&](std::size_t frame) { return part(frame) != rest; });
  }

  OrderedJson add_targets(const Body& body, const GltfSurface& surface, const Shape& rest, bool has_normals) {
    OrderedJson targets = OrderedJson::array();
    for (std::size_t key = 1; key < frames_.size(); ++key) {
      const Shape moved = shape(body, surface, frames_[key]);
      OrderedJson target = {{"POSITION", document_.add_vectors(differences(moved.positions, rest.positions), true)}};
      if (has_normals) target["NORMAL"] = document_.add_vectors(differences(moved.normals, rest.normals), false);
      targets.push_back(std::move(target));
    }
    return targets;
  }

  Shape shape(const Body& body, const GltfSurface& surface, std::size_t frame) {
    animation_.cache.sample(animation_.times[frame], positions_);
    const Positions own = positions_.middleRows(body.first_vertex, body.mesh.vertex_count());
    const Positions normals = vertex_normals(body.mesh, own);
    Shape result;
    for (const Index vertex : surface.vertices) {
      single_precision(own, vertex);  // must be in its range
      result.positions.push_back(row(own, vertex));
      result.normals.push_back(row(normals, vertex));
    }
    return result;
  }

  static std::vector<Vec3f> y_up_floats(const std::vector<Eigen::Vector3d>& vectors) {
    std::vector<Vec3f> result;
    for (const Eigen::Vector3d& v : vectors) result.push_back(y_up(v.cast<float>()));
    return result;
  }

  /// From what the reader has of the rest shape in single precision, so that rounding does not add up.
  static std::vector<Vec3f> differences(const std::vector<Eigen::Vector3d>& moved,
                                        const std::vector<Eigen::Vector3d>& rest) {
    std::vector<Vec3f> result;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const Eigen::Vector3d base = rest[i].cast<float>().cast<double>();
      result.push_back(y_up((moved[i] - base).cast<float>()));
    }
    return result;
  }

  void add_animation() {
    OrderedJson samplers = OrderedJson::array();
    OrderedJson channels = OrderedJson::array();
    if (!moving_nodes_.empty()) animate_bodies(samplers, channels);
    if (!moving_colliders_.empty()) animate_colliders(samplers, channels);
    if (channels.empty()) return;
    document_.add("animations",
                  {{"name", animation_.name}, {"samplers", std::move(samplers)}, {"channels", std::move(channels)}});
  }

  /// At each keyframe the weight of its own target is 1, and linear between them; all bodies share the numbers.
  void animate_bodies(OrderedJson& samplers, OrderedJson& channels) {
    const std::size_t target_count = frames_.size() - 1;
    std::vector<float> weights(frames_.size() * target_count, 0);
    for (std::size_t key = 1; key < frames_.size(); ++key) weights[key * target_count + key - 1] = 1;
    samplers.push_back({{"input", document_.add_times(single_precision_times(animation_, frames_))},
                        {"output", document_.add_scalars(weights)},
                        {"interpolation", "LINEAR"}});
    for (const std::size_t node : moving_nodes_) {
      channels.push_back({{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}});
    }
  }

  /// At each frame a translation and a rotation; numbers that are few are not thinned. What is not there is scaled to
  /// 0, by which nodes are hidden: renderers may leave such a node out.
  void animate_colliders(OrderedJson& samplers, OrderedJson& channels) {
    std::vector<std::size_t> all(animation_.times.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const std::size_t input = document_.add_times(single_precision_times(animation_, all));
    for (const MovingCollider& moving : moving_colliders_) {
      std::vector<Vec3f> places, sizes;
      std::vector<std::array<float, 4>> turns;
      for (const Real time : animation_.times) {
        const Pose pose = moving.collider->pose_at(time);
        places.push_back(y_up(pose.position.cast<float>()));
        turns.push_back(rotation(pose));
        sizes.push_back(moving.collider->is_there(time) ? Vec3f::Ones() : Vec3f::Zero());
      }
      const auto add_channel = [&](std::size_t output, const char* path, const char* interpolation) {
        channels.push_back({{"sampler", samplers.size()}, {"target", {{"node", moving.node}, {"path", path}}}});
        samplers.push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
      };
      if (moving.collider->moves()) {
        add_channel(document_.add_numbers(places), "translation", "LINEAR");
        add_channel(document_.add_numbers(turns), "rotation", "LINEAR");
      }
      if (moving.comes_or_goes) add_channel(document_.add_numbers(sizes), "scale", "STEP");
    }
  }

  const Animation& animation_;
  const std::vector<std::size_t>& frames_;
  Normals normals_;
  const std::vector<std::optional<SurfaceLook>>& looks_;
  const std::map<std::string, SurfaceLook, std::less<>>& collider_looks_;
  std::map<std::tuple<std::array<double, 3>, std::optional<std::size_t>, bool, Real, Sides>, std::size_t> materials_;
  std::map<std::string_view, std::size_t> textures_;  ///< by the bytes of their pictures
  std::optional<std::size_t> collider_material_;
  GltfDocument document_;
  std::vector<std::size_t> moving_nodes_;
  std::vector<MovingCollider> moving_colliders_;
  Positions positions_;  ///< scratch
};

}  // namespace

void write_gltf(const std::filesystem::path& path, const Animation& animation, const std::vector<std::size_t>& frames,
                const ExportOptions& options) {
  GltfExport(animation, frames, options).document().write_text(path);
}

void write_glb(const std::filesystem::path& path, const Animation& animation, const std::vector<std::size_t>& frames,
               const ExportOptions& options) {
  GltfExport(animation, frames, options).document().write_binary(path);
}

}  // namespace pliant
