// glTF 2.0 (Khronos Group, specification 2.0.1; section numbers are its own).
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant/core/version.h"
#include "pliant_io/export/detail/export_formats.h"
#include "pliant_io/export/detail/gltf_materials.h"
#include "pliant_io/export/detail/gltf_surface.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/base64.h"
#include "pliant_io/recorder/detail/array_format.h"

namespace pliant {
namespace {

static_assert(std::endian::native == std::endian::little, "buffers are written as they lie in memory");

using OrderedJson = nlohmann::ordered_json;
using Vec3f = Eigen::Vector3f;

/// Numbers that the specification gives to what they name (Sec. 5.1.3, 5.11.5, 5.24.4).
enum class ComponentType { unsigned_int = 5125, single = 5126 };
enum class Target { none = 0, vertices = 34962, indices = 34963 };
enum class Mode { points = 0, lines = 1, triangles = 4 };

/// Ours has +z up, glTF +y; a quarter turn about x (Sec. 3.4).
Vec3f y_up(const Vec3f& v) {
  return {v[0], v[2], -v[1]};
}

/// The JSON and the one buffer that its accessors refer to.
class GltfDocument {
 public:
  GltfDocument() {
    json_["asset"] = {{"version", "2.0"}, {"generator", fmt::format("pliant {}", version)}};
    json_["scene"] = 0;
    json_["scenes"] = {{{"nodes", OrderedJson::array()}}};
  }

  OrderedJson& operator[](const char* key) { return json_[key]; }
  const OrderedJson& json() const { return json_; }
  const std::string& buffer() const { return buffer_; }

  /// Appends to a list of the document; returns the index there.
  std::size_t add(const char* list, OrderedJson item) {
    json_[list].push_back(std::move(item));
    return json_[list].size() - 1;
  }

  std::size_t add_vectors(const std::vector<Vec3f>& vectors, bool has_bounds) {
    OrderedJson accessor = add_view(vectors.data(), vectors.size() * sizeof(Vec3f), Target::vertices);
    describe(accessor, ComponentType::single, vectors.size(), "VEC3");
    if (has_bounds) {
      Vec3f low = vectors.front();
      Vec3f high = vectors.front();
      for (const Vec3f& v : vectors) {
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
      }
      accessor["min"] = {low[0], low[1], low[2]};
      accessor["max"] = {high[0], high[1], high[2]};
    }
    return add("accessors", std::move(accessor));
  }

  std::size_t add_texture_coordinates(const std::vector<std::array<float, 2>>& pairs) {
    OrderedJson accessor = add_view(pairs.data(), pairs.size() * sizeof(pairs[0]), Target::vertices);
    describe(accessor, ComponentType::single, pairs.size(), "VEC2");
    return add("accessors", std::move(accessor));
  }

  std::size_t add_indices(const std::vector<Index>& indices) {
    OrderedJson accessor = add_view(indices.data(), indices.size() * sizeof(Index), Target::indices);
    describe(accessor, ComponentType::unsigned_int, indices.size(), "SCALAR");
    return add("accessors", std::move(accessor));
  }

  std::size_t add_times(const std::vector<float>& times) {
    OrderedJson accessor = add_view(times.data(), times.size() * sizeof(float), Target::none);
    describe(accessor, ComponentType::single, times.size(), "SCALAR");
    accessor["min"] = {times.front()};
    accessor["max"] = {times.back()};
    return add("accessors", std::move(accessor));
  }

  /// Vectors that are not those of vertices, as an animation has them.
  template <class Vector>
  std::size_t add_numbers(const std::vector<Vector>& vectors) {
    static_assert(sizeof(Vector) == 3 * sizeof(float) || sizeof(Vector) == 4 * sizeof(float));
    OrderedJson accessor = add_view(vectors.data(), vectors.size() * sizeof(Vector), Target::none);
    describe(accessor, ComponentType::single, vectors.size(), sizeof(Vector) == 3 * sizeof(float) ? "VEC3" : "VEC4");
    return add("accessors", std::move(accessor));
  }

  std::size_t add_scalars(const std::vector<float>& numbers) {
    OrderedJson accessor = add_view(numbers.data(), numbers.size() * sizeof(float), Target::none);
    describe(accessor, ComponentType::single, numbers.size(), "SCALAR");
    return add("accessors", std::move(accessor));
  }

 private:
  /// An accessor of bytes that are appended to the buffer; all are of numbers of four bytes, so that they are aligned.
  OrderedJson add_view(const void* data, std::size_t size, Target target) {
    OrderedJson view = {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}};
    if (target != Target::none) view["target"] = static_cast<int>(target);
    buffer_.append(static_cast<const char*>(data), size);
    return {{"bufferView", add("bufferViews", std::move(view))}};
  }

  static void describe(OrderedJson& accessor, ComponentType component, std::size_t count, const char* type) {
    accessor["componentType"] = static_cast<int>(component);
    accessor["count"] = count;
    accessor["type"] = type;
  }

  OrderedJson json_;
  std::string buffer_;
};

/// The same triangles seen from the other side.
std::vector<Index> turned(std::vector<Index> triangles) {
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) std::swap(triangles[i + 1], triangles[i + 2]);
  return triangles;
}

class GltfExport {
 public:
  GltfExport(const Animation& animation, const std::vector<std::size_t>& frames, const ExportOptions& options)
      : animation_(animation), frames_(frames), normals_(options.normals), colors_(options.colors) {
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
    const std::optional<SurfaceColors> colors = number < colors_.size() ? colors_[number] : std::nullopt;
    const bool has_two_tones = colors && colors->front != colors->back && !surface.triangles.empty();
    const std::size_t tone = colors ? colored(colors->front, has_two_tones ? Sides::one : Sides::both)
                                    : document_.add("materials", gltf_material_of_body(number));
    if (!surface.triangles.empty()) add_primitive(Mode::triangles, surface.triangles, front, tone);
    if (has_two_tones) {
      add_primitive(Mode::triangles, turned(surface.triangles), back_side(body, surface, rest, front),
                    colored(colors->back, Sides::one));
    }
    if (!surface.lines.empty()) add_primitive(Mode::lines, surface.lines, front, tone);
    if (primitives.empty()) add_primitive(Mode::points, {}, front, tone);
    add_node(body.name, std::move(primitives), is_moving);
  }

  /// Bodies of one color share a material.
  std::size_t colored(const std::array<Real, 3>& color, Sides sides) {
    const auto [known, is_new] = materials_.try_emplace({color, sides});
    if (is_new) known->second = document_.add("materials", gltf_material(light_of(color), sides));
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
    if (!collider_material_)
      collider_material_ = document_.add("materials", gltf_material(collider_light, Sides::both));
    OrderedJson attributes = {{"POSITION", document_.add_vectors(positions, true)}};
    if (normals_ == Normals::smooth) attributes["NORMAL"] = document_.add_vectors(normals, false);
    const OrderedJson primitive = {{"attributes", std::move(attributes)},
                                   {"material", *collider_material_},
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
  std::vector<std::optional<SurfaceColors>> colors_;
  std::map<std::pair<std::array<Real, 3>, Sides>, std::size_t> materials_;
  std::optional<std::size_t> collider_material_;
  GltfDocument document_;
  std::vector<std::size_t> moving_nodes_;
  std::vector<MovingCollider> moving_colliders_;
  Positions positions_;  ///< scratch
};

std::string dump(const OrderedJson& json) {
  // Names may hold bytes that are not UTF-8; they must not cost the file.
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

void append_word(std::string& bytes, std::uint32_t word) {
  bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
}

/// A chunk of a binary file (Sec. 4.4.3); `filler` makes its size a multiple of 4.
void write_chunk(AtomicFile& file, std::string_view type, std::string_view data, char filler) {
  const std::size_t padding = (4 - data.size() % 4) % 4;
  std::string head;
  append_word(head, static_cast<std::uint32_t>(data.size() + padding));
  head += type;
  file.write(head);
  file.write(data);
  file.write(std::string(padding, filler));
}

void write_binary(AtomicFile& file, const std::string& json, const std::string& buffer,
                  const std::filesystem::path& path) {
  constexpr std::size_t heads = 12 + 8 + 8;
  const std::size_t size = heads + (json.size() + 3) / 4 * 4 + (buffer.size() + 3) / 4 * 4;
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    fail_input(fmt::format("{}: {} bytes are past the 4 GiB of a GLB file; reduce --max-keyframes, or write USD",
                           path.string(), size));
  }
  std::string head = "glTF";
  append_word(head, 2);
  append_word(head, static_cast<std::uint32_t>(size));
  file.write(head);
  write_chunk(file, "JSON", json, ' ');
  write_chunk(file, std::string_view("BIN\0", 4), buffer, '\0');
}

}  // namespace

void write_gltf(const std::filesystem::path& path, const Animation& animation, const std::vector<std::size_t>& frames,
                const ExportOptions& options) {
  GltfExport result(animation, frames, options);
  GltfDocument& document = result.document();
  document.add("buffers", {{"byteLength", document.buffer().size()},
                           {"uri", "data:application/octet-stream;base64," + base64(document.buffer())}});
  AtomicFile file(path);
  file.write(dump(document.json()) + '\n');
  file.commit();
}

void write_glb(const std::filesystem::path& path, const Animation& animation, const std::vector<std::size_t>& frames,
               const ExportOptions& options) {
  GltfExport result(animation, frames, options);
  GltfDocument& document = result.document();
  document.add("buffers", {{"byteLength", document.buffer().size()}});
  AtomicFile file(path);
  write_binary(file, dump(document.json()), document.buffer(), path);
  file.commit();
}

}  // namespace pliant
