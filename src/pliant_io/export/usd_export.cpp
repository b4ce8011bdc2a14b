// USD as text (OpenUSD, usda 1.0) with the schemas of UsdGeom.
#include <cmath>

#include <fmt/format.h>

#include "pliant/core/version.h"
#include "pliant_io/export/detail/export_formats.h"
#include "pliant_io/export/detail/gltf_materials.h"
#include "pliant_io/export/detail/usd_pictures.h"
#include "pliant_io/export/detail/usd_text.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/recorder/detail/array_format.h"
#include "pliant_io/recorder/detail/one_mesh.h"

namespace pliant {
namespace {

/// How wide curves are drawn, in sizes of their body.
constexpr Real curve_width = 0.005;
/// Times that are as close to a whole frame are at it.
constexpr Real code_rounding = 1e-6;

template <typename Items, typename Write>
std::string list(const Items& items, const Write& write) {
  std::string text = "[";
  for (const auto& item : items) {
    if (text.size() > 1) text += ", ";
    write(text, item);
  }
  return text + ']';
}

std::string indices_text(const std::vector<Index>& indices) {
  return list(indices, [](std::string& text, Index index) { text += fmt::format("{}", index); });
}

void append_point(std::string& text, const Eigen::Vector3f& p) {
  fmt::format_to(std::back_inserter(text), "({}, {}, {})", p[0], p[1], p[2]);
}

/// Edges as polylines: each goes on while the next edge begins where the last one ended.
struct Curves {
  explicit Curves(const std::vector<Edge>& edges) {
    for (const auto& [from, to] : edges) {
      if (vertices.empty() || vertices.back() != from) {
        counts.push_back(1);
        vertices.push_back(from);
      }
      vertices.push_back(to);
      ++counts.back();
    }
  }
  std::vector<Index> counts;
  std::vector<Index> vertices;
};

class UsdExport {
 public:
  UsdExport(UsdText& text, UsdPictures& pictures, const Animation& animation, const std::vector<std::size_t>& frames,
            const ExportOptions& options)
      : text_(text),
        pictures_(pictures),
        animation_(animation),
        frames_(frames),
        looks_(options.looks),
        collider_looks_(options.collider_looks),
        rate_(frame_rate(animation.times)) {
    constexpr Real rate_of_uneven_frames = 24;
    if (rate_ == 0) rate_ = rate_of_uneven_frames;
  }

  void write() {
    PrimNames names;
    const std::string root = names.name(animation_.name);
    text_.line("#usda 1.0");
    text_.line("(");
    text_.line(fmt::format("    defaultPrim = \"{}\"", root));
    text_.line(fmt::format("    doc = {}", usd_string(fmt::format("pliant {}", version))));
    text_.line(fmt::format("    endTimeCode = {}", time_code(frames_.back())));
    text_.line(fmt::format("    framesPerSecond = {}", rate_));
    text_.line("    metersPerUnit = 1");
    text_.line("    startTimeCode = 0");
    text_.line(fmt::format("    timeCodesPerSecond = {}", rate_));
    text_.line("    upAxis = \"Z\"");
    text_.line(")");
    text_.line("");
    text_.open(fmt::format("def Xform \"{}\"", root));
    const std::vector<Real> sizes = body_sizes(animation_);
    PrimNames bodies;
    for (std::size_t i = 0; i < animation_.bodies.size(); ++i) {
      look_ = i < looks_.size() ? looks_[i] : std::nullopt;
      write_body(animation_.bodies[i], root, bodies, sizes[i]);
    }
    for (const AnimatedCollider& collider : animation_.colliders) write_collider(collider, root, bodies);
    text_.close();
  }

 private:
  Real time_code(std::size_t frame) const {
    const Real code = time_from_start(animation_, frame) * rate_;
    return std::abs(code - std::round(code)) <= code_rounding * std::max<Real>(1, code) ? std::round(code) : code;
  }

  void write_body(const Body& body, const std::string& root, PrimNames& names, Real size) {
    const std::string name = names.name(body.name);
    text_.line(fmt::format("def Xform \"{}\" (", name));
    text_.line(fmt::format("    customData = {{ string name = {} }}", usd_string(body.name)));
    text_.open(")");
    const PolygonFaces faces = visible_faces(body.mesh);
    if (faces.face_count() > 0) write_mesh(body, faces, fmt::format("/{}/{}", root, name));
    if (!body.mesh.edges.empty()) write_curves(body, size);
    if (faces.face_count() == 0 && body.mesh.edges.empty() && body.mesh.vertex_count() > 0) write_points(body, size);
    text_.close();
  }

  /// `place` is the path of the body's prim.
  void write_mesh(const Body& body, const PolygonFaces& faces, const std::string& place) {
    const bool has_material = look_ && (look_->finish || look_->front.image);
    open_mesh(has_material ? usd_material(place) : "");
    std::vector<Index> counts;
    for (std::size_t f = 1; f < faces.offsets.size(); ++f) counts.push_back(faces.offsets[f] - faces.offsets[f - 1]);
    text_.line("int[] faceVertexCounts = " + indices_text(counts));
    text_.line("int[] faceVertexIndices = " + indices_text(faces.vertices));
    write_points_over_time(body, all_vertices(body));
    if (!faces.texture_coordinates.empty()) write_texture(body.mesh, faces);
    text_.line("uniform token subdivisionScheme = \"none\"");
    text_.close();
    if (!has_material) return;
    const bool has_picture = look_->front.image && !faces.texture_coordinates.empty();
    write_usd_material(text_, place, *look_, has_picture ? pictures_.reference(*look_->front.image) : "");
  }

  /// A rigid mesh under the transform of its prim.
  void write_collider(const AnimatedCollider& collider, const std::string& root, PrimNames& names) {
    const auto is_there = [&](Real time) { return collider.is_there(time); };
    if (collider.surface.triangles.empty() || std::ranges::none_of(animation_.times, is_there)) return;
    const std::string name = names.name(collider.name);
    text_.line(fmt::format("def Xform \"{}\" (", name));
    text_.line(fmt::format("    customData = {{ string name = {} }}", usd_string(collider.name)));
    text_.open(")");
    write_pose(collider);
    if (!std::ranges::all_of(animation_.times, is_there)) write_visibility(collider);
    const auto look = collider_looks_.find(collider.name);
    const std::string place = fmt::format("/{}/{}", root, name);
    open_mesh(look != collider_looks_.end() ? usd_material(place) : "");
    write_surface(collider, look != collider_looks_.end() ? light_of(look->second.front.color) : collider_light);
    text_.close();
    if (look != collider_looks_.end()) write_usd_material(text_, place, look->second, "");
    text_.close();
  }

  /// material: its path; empty: none.
  void open_mesh(const std::string& material) {
    if (material.empty()) {
      text_.open("def Mesh \"mesh\"");
    } else {
      text_.line("def Mesh \"mesh\" (");
      text_.line("    prepend apiSchemas = [\"MaterialBindingAPI\"]");
      text_.open(")");
      text_.line(fmt::format("rel material:binding = <{}>", material));
    }
    text_.line("uniform bool doubleSided = 1");
  }

  void write_surface(const AnimatedCollider& collider, const std::array<double, 3>& light) {
    const Mesh& surface = collider.surface;
    std::vector<Index> corners;
    for (const Triangle& triangle : surface.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
    text_.line("int[] faceVertexCounts = " + indices_text(std::vector<Index>(surface.triangles.size(), 3)));
    text_.line("int[] faceVertexIndices = " + indices_text(corners));
    const std::vector<Eigen::Vector3f> points = rows_of(surface.vertices);
    Eigen::Vector3f low = points.front(), high = low;
    for (const Eigen::Vector3f& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
    text_.line("float3[] extent = " + list(std::array{low, high}, append_point));
    text_.line("normal3f[] normals = " + list(rows_of(collider.normals), append_point) + " (");
    text_.line("    interpolation = \"faceVarying\"");
    text_.line(")");
    text_.line("point3f[] points = " + list(points, append_point));
    write_color(light);
    text_.line("uniform token subdivisionScheme = \"none\"");
  }

  void write_pose(const AnimatedCollider& collider) {
    const auto write = [&](std::string_view attribute, const auto& value) {
      if (frames_.size() == 1 || !collider.moves()) {
        text_.line(fmt::format("{} = {}", attribute, value(collider.pose_at(animation_.times[frames_.front()]))));
        return;
      }
      text_.line(fmt::format("{}.timeSamples = {{", attribute));
      for (const std::size_t frame : frames_) {
        text_.line(fmt::format("    {}: {},", time_code(frame), value(collider.pose_at(animation_.times[frame]))));
      }
      text_.line("}");
    };
    write("quatd xformOp:orient", [](const Pose& pose) {
      const auto& turn = pose.rotation;
      return fmt::format("({}, {}, {}, {})", turn.w(), turn.x(), turn.y(), turn.z());
    });
    write("double3 xformOp:translate", [](const Pose& pose) {
      return fmt::format("({}, {}, {})", pose.position.x(), pose.position.y(), pose.position.z());
    });
    text_.line("uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"]");
  }

  /// A token holds until the next one.
  void write_visibility(const AnimatedCollider& collider) {
    text_.line("token visibility.timeSamples = {");
    std::optional<bool> last;
    for (std::size_t frame = 0; frame < animation_.times.size(); ++frame) {
      const bool is_there = collider.is_there(animation_.times[frame]);
      if (last != is_there) {
        text_.line(fmt::format("    {}: \"{}\",", time_code(frame), is_there ? "inherited" : "invisible"));
      }
      last = is_there;
    }
    text_.line("}");
  }

  void write_color(const std::array<double, 3>& light) {
    text_.line(fmt::format("color3f[] primvars:displayColor = [({}, {}, {})]", static_cast<float>(light[0]),
                           static_cast<float>(light[1]), static_cast<float>(light[2])));
  }

  static std::vector<Eigen::Vector3f> rows_of(const Positions& rows) {
    std::vector<Eigen::Vector3f> list;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) list.push_back(single_precision(rows, static_cast<Index>(i)));
    return list;
  }

  /// Corners without texture coordinates get (0, 0).
  void write_texture(const Mesh& mesh, const PolygonFaces& faces) {
    const std::string pairs = list(faces.texture_coordinates, [&](std::string& text, Index t) {
      const bool has_pair = t >= 0;
      const auto u = has_pair ? static_cast<float>(mesh.texture_coordinates(t, 0)) : 0;
      const auto v = has_pair ? static_cast<float>(mesh.texture_coordinates(t, 1)) : 0;
      fmt::format_to(std::back_inserter(text), "({}, {})", u, v);
    });
    text_.line("texCoord2f[] primvars:st = " + pairs + " (");
    text_.line("    interpolation = \"faceVarying\"");
    text_.line(")");
  }

  void write_curves(const Body& body, Real size) {
    const Curves curves(body.mesh.edges);
    text_.open("def BasisCurves \"edges\"");
    text_.line("int[] curveVertexCounts = " + indices_text(curves.counts));
    write_points_over_time(body, curves.vertices);
    text_.line("uniform token type = \"linear\"");
    write_width(size);
    text_.line("uniform token wrap = \"nonperiodic\"");
    text_.close();
  }

  void write_points(const Body& body, Real size) {
    text_.open("def Points \"points\"");
    write_points_over_time(body, all_vertices(body));
    write_width(size);
    text_.close();
  }

  void write_width(Real size) {
    text_.line(fmt::format("float[] widths = [{}] (", static_cast<float>(curve_width * size)));
    text_.line("    interpolation = \"constant\"");
    text_.line(")");
  }

  static std::vector<Index> all_vertices(const Body& body) {
    std::vector<Index> vertices;
    for (Index v = 0; v < body.mesh.vertex_count(); ++v) vertices.push_back(v);
    return vertices;
  }

  /// `vertices` are the body's.
  void write_points_over_time(const Body& body, const std::vector<Index>& vertices) {
    write_over_time("float3[] extent", [&] { return extent_text(body, vertices); });
    write_over_time("point3f[] points", [&] {
      return list(vertices, [&](std::string& text, Index v) { append_point(text, point(body, v)); });
    });
    if (look_) write_color(light_of(look_->front.color));
  }

  Eigen::Vector3f point(const Body& body, Index vertex) const {
    return single_precision(positions_, body.first_vertex + vertex);
  }

  std::string extent_text(const Body& body, const std::vector<Index>& vertices) const {
    Eigen::Vector3f low = point(body, vertices.front());
    Eigen::Vector3f high = low;
    for (const Index vertex : vertices) {
      low = low.cwiseMin(point(body, vertex));
      high = high.cwiseMax(point(body, vertex));
    }
    return list(std::array{low, high}, append_point);
  }

  /// An attribute, `value` being made of positions_; of a single frame it needs no time.
  template <typename Value>
  void write_over_time(std::string_view attribute, const Value& value) {
    if (frames_.size() == 1) {
      sample(frames_.front());
      text_.line(fmt::format("{} = {}", attribute, value()));
      return;
    }
    text_.line(fmt::format("{}.timeSamples = {{", attribute));
    for (const std::size_t frame : frames_) {
      sample(frame);
      text_.line(fmt::format("    {}: {},", time_code(frame), value()));
    }
    text_.line("}");
  }

  void sample(std::size_t frame) { animation_.cache.sample(animation_.times[frame], positions_); }

  UsdText& text_;
  UsdPictures& pictures_;
  const Animation& animation_;
  const std::vector<std::size_t>& frames_;
  const std::vector<std::optional<SurfaceLook>>& looks_;
  const std::map<std::string, SurfaceLook, std::less<>>& collider_looks_;
  std::optional<SurfaceLook> look_;  ///< of the body that is being written
  Real rate_;
  Positions positions_;  ///< of the frame that is being written
};

}  // namespace

void write_usda(const std::filesystem::path& path, const Animation& animation, const std::vector<std::size_t>& frames,
                const ExportOptions& options) {
  AtomicFile file(path);
  UsdText text(file);
  UsdPictures pictures(path);
  UsdExport(text, pictures, animation, frames, options).write();
  text.flush();
  pictures.commit();
  file.commit();
}

}  // namespace pliant
