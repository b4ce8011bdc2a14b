// The JavaScript module. web/npm/index.d.ts has its types, and what each part of it does.
#include <algorithm>
#include <exception>
#include <fstream>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include <emscripten/bind.h>

#include "arrays.h"
#include "pliant/core/error.h"
#include "pliant/core/version.h"
#include "pliant/materials/material.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "render/scalar_fields.h"
#include "viewer/suggestions.h"
#include "web_scene.h"

namespace {

using emscripten::val;
using pliant::Index;
using pliant::Real;
using pliant_web::array_of;
using pliant_web::numbers_of;
using pliant_web::WebScene;

/// Calls f; what it throws becomes an Error of JavaScript with the same message.
template <class F>
auto guarded(F&& f) {
  std::string message;
  try {
    return f();
  } catch (const std::exception& error) {
    message = error.what();
  } catch (...) {
    message = "an error without a message";
  }
  val::global("Error").new_(message).throw_();
}

/// A scene, and the mesh of its bodies as they are drawn.
class Scene {
 public:
  explicit Scene(WebScene scene) : scene_(std::move(scene)) {}

  WebScene& scene() { return scene_; }
  pliant_viewer::Session& session() { return scene_.session(); }
  const pliant::Simulation& simulation() { return session().simulation(); }

  val look(float aspect);
  /// With the values that colors show, but for `none`.
  val frame(pliant::ColorBy color);

 private:
  WebScene scene_;
  pliant_render::RenderMesh mesh_;
};

val color_of(const pliant::Color& color) {
  return numbers_of(pliant::Vec3(color.red, color.green, color.blue));
}

val viewpoint_of(const pliant_render::Viewpoint& from) {
  val to = val::object();
  to.set("eye", numbers_of(from.eye));
  to.set("target", numbers_of(from.target));
  to.set("up", numbers_of(from.up));
  to.set("fieldOfView", from.field_of_view * 180 / std::numbers::pi_v<float>);
  return to;
}

val collider_of(const pliant_render::DrawnCollider& drawn) {
  const pliant_render::ColliderSurface& surface = *drawn.surface;
  std::vector<pliant_render::Vec3f> positions, normals;
  for (const pliant_render::ColliderSurface::Corner& corner : surface.corners) {
    positions.push_back(corner.position);
    normals.push_back(corner.normal);
  }
  val collider = val::object();
  collider.set("number", static_cast<double>(drawn.number));
  collider.set("positions", array_of(positions));
  collider.set("normals", array_of(normals));
  collider.set("isPlane", surface.is_plane);
  collider.set("isMovable", surface.shape->is_bounded());
  return collider;
}

val Scene::look(float aspect) {
  pliant_web::Look look = scene_.look(aspect);
  mesh_ = std::move(look.mesh);
  const pliant::ViewSettings& view = scene_.view();
  val result = val::object();
  result.set("vertexCount", static_cast<double>(mesh_.vertex_count));
  result.set("copies", array_of(mesh_.copies));
  result.set("triangles", array_of(mesh_.corners));
  result.set("ropes", array_of(mesh_.ropes));
  result.set("edges", array_of(mesh_.edges));
  result.set("front", array_of(look.front));
  result.set("back", array_of(look.back));
  result.set("second", array_of(look.second));
  result.set("places", array_of(look.places));
  result.set("viewpoint", viewpoint_of(look.viewpoint));
  result.set("light", numbers_of(view.light));
  result.set("background", color_of(view.background));
  result.set("radius", look.radius);
  const pliant_web::Frame frame = scene_.frame(mesh_);
  val colliders = val::array();
  bool has_plane = false;
  for (const pliant_render::DrawnCollider& each : frame.colliders) {
    colliders.call<void>("push", collider_of(each));
    has_plane = has_plane || each.surface->is_plane;
  }
  result.set("colliders", colliders);
  result.set("ground", view.ground && !has_plane ? val(frame.ground) : val::null());
  return result;
}

val pull_of(const std::optional<pliant_viewer::Pull>& pull, const pliant_web::Frame& frame) {
  if (!pull) return val::null();
  val result = val::object();
  result.set("from", numbers_of(pull->point.position(frame.positions)));
  result.set("to", numbers_of(pull->target));
  return result;
}

pliant::ColorBy color_by(const std::string& name) {
  const auto names = choice_names(pliant::ColorBy());
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    std::string all;
    for (const std::string_view each : names) all += (all.empty() ? "" : ", ") + std::string(each);
    pliant::fail_input("color: '" + name + "' is none of " + all);
  }
  return static_cast<pliant::ColorBy>(found - names.begin());
}

val Scene::frame(pliant::ColorBy color) {
  const pliant_web::Frame frame = scene_.frame(mesh_);
  std::vector<float> poses;
  val numbers = val::array();
  for (const pliant_render::DrawnCollider& each : frame.colliders) {
    const pliant_render::Vec3f place = each.pose.position.cast<float>();
    const auto turn = each.pose.rotation.cast<float>();
    poses.insert(poses.end(), {place.x(), place.y(), place.z(), turn.x(), turn.y(), turn.z(), turn.w()});
    numbers.call<void>("push", static_cast<double>(each.number));
  }
  val result = val::object();
  result.set("positions", array_of(frame.positions));
  result.set("normals", array_of(frame.normals));
  result.set("poses", array_of(poses));
  result.set("colliders", numbers);
  result.set("pins", array_of(frame.pins));
  result.set("ground", frame.ground);
  result.set("viewpoint", frame.viewpoint ? viewpoint_of(*frame.viewpoint) : val::null());
  result.set("pull", pull_of(session().pull(), frame));
  result.set("values", val::null());
  if (color == pliant::ColorBy::none) return result;
  const pliant_web::Values shown = scene_.values(mesh_, color);
  val values = val::object();
  values.set("numbers", array_of(shown.values));
  values.set("low", shown.range[0]);
  values.set("high", shown.range[1]);
  result.set("values", values);
  return result;
}

std::string kind_of(pliant::ParameterKind kind) {
  switch (kind) {
    case pliant::ParameterKind::integer:
      return "integer";
    case pliant::ParameterKind::choice:
      return "choice";
    case pliant::ParameterKind::vector:
      return "vector";
    case pliant::ParameterKind::flag:
      return "flag";
    case pliant::ParameterKind::real:
      break;
  }
  return "real";
}

val parameters(Scene& self) {
  return guarded([&] {
    val list = val::array();
    for (const pliant_viewer::Slider& slider : self.session().sliders()) {
      const pliant::Parameter& each = slider.parameter;
      val entry = val::object();
      entry.set("key", slider.key);
      entry.set("heading", slider.heading);
      entry.set("option", each.handle.option);
      entry.set("unit", each.unit);
      entry.set("doc", each.doc);
      entry.set("kind", kind_of(each.kind));
      entry.set("min", each.range.min);
      entry.set("max", each.range.max);
      entry.set("value",
                numbers_of(each.kind == pliant::ParameterKind::vector ? Eigen::VectorXd(each.value)
                                                                      : Eigen::VectorXd(each.value.head<1>())));
      val choices = val::array();
      for (const std::string& choice : each.choices) choices.call<void>("push", choice);
      entry.set("choices", choices);
      list.call<void>("push", entry);
    }
    return list;
  });
}

val materials(Scene& self) {
  return guarded([&] {
    val list = val::array();
    for (const pliant_viewer::BodyMaterial& each : self.session().materials()) {
      val choices = val::array();
      for (const pliant_viewer::MaterialChoice& choice : each.choices) {
        val one = val::object();
        one.set("name", choice.name);
        one.set("description", choice.description);
        choices.call<void>("push", one);
      }
      val entry = val::object();
      entry.set("body", each.name);
      entry.set("material", each.material);
      entry.set("choices", choices);
      list.call<void>("push", entry);
    }
    return list;
  });
}

val warnings(Scene& self) {
  val list = val::array();
  for (const std::string& each : self.session().scene().warnings) list.call<void>("push", each);
  for (const std::string& each : self.simulation().warnings()) list.call<void>("push", each);
  return list;
}

/// Numbers of JavaScript are doubles; what is no index becomes one that no vertex has.
Index index_of(double number) {
  return number >= 0 && number < 2147483647.0 ? static_cast<Index>(number) : Index{-1};
}

void grab(Scene& self, val vertices, val weights, Real x, Real y, Real z, Real stiffness) {
  guarded([&] {
    pliant_viewer::Pull pull;
    const auto count = static_cast<double>(self.simulation().state().vertex_count());
    for (unsigned i = 0; i < 3; ++i) {
      const auto vertex = vertices[i].as<double>();
      if (!(vertex >= 0 && vertex < count)) {
        pliant::fail_input("a point to pull at has vertex " + std::to_string(vertex) + "; the scene has " +
                           std::to_string(self.simulation().state().vertex_count()));
      }
      pull.point.vertices[i] = static_cast<std::uint32_t>(vertex);
      pull.point.weights[static_cast<int>(i)] = weights[i].as<float>();
    }
    pull.target = pliant::Vec3(x, y, z).cast<float>();
    pull.stiffness = stiffness > 0 ? stiffness : pliant_viewer::suggest_pull_stiffness(self.simulation());
    self.session().grab(pull);
  });
}

/// Emscripten passes bytes of a Uint8Array as a text.
void write_file(const std::string& path, const std::string& bytes) {
  guarded([&] {
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    std::ofstream file(path, std::ios::binary);
    file << bytes;
    if (!file.flush()) pliant::fail_input(path + ": cannot be written");
  });
}

void remove_files(const std::string& folder) {
  guarded([&] { std::filesystem::remove_all(folder); });
}

Scene* open_scene(const std::string& text, const std::string& name, const std::string& folder) {
  return guarded([&] { return std::make_unique<Scene>(WebScene::of_text(text, name, folder)).release(); });
}

Scene* open_mesh(const std::string& file, Real scale, const std::string& up) {
  return guarded([&] {
    pliant::ImportOptions import;
    import.scale = scale;
    const auto names = choice_names(import.up);
    const auto found = std::ranges::find(names, up);
    if (found == names.end()) pliant::fail_input("up is 'x', 'y' or 'z', not '" + up + "'");
    import.up = static_cast<pliant::UpAxis>(found - names.begin());
    return std::make_unique<Scene>(WebScene::of_mesh(file, import)).release();
  });
}

std::string builtin_scene(const std::string& name) {
  return guarded([&]() -> std::string {
    for (const pliant::BuiltinScene& each : pliant::builtin_scenes()) {
      if (each.name == name) return std::string(each.text);
    }
    pliant::fail_input("there is no built-in scene '" + name + "'");
  });
}

val color_maps() {
  val list = val::array();
  const auto names = choice_names(pliant::ColorBy());
  for (std::size_t i = 1; i < names.size(); ++i) {
    const auto color = static_cast<pliant::ColorBy>(i);
    const auto tones = pliant_render::color_map(color);
    val map = val::object();
    map.set("name", std::string(names[i]));
    map.set("title", std::string(pliant_render::field_title(color)));
    map.set("scale", pliant_render::field_scale(color));
    map.set("tones", pliant_web::typed_array("Uint8Array", tones.front().data(), 3 * tones.size()));
    list.call<void>("push", map);
  }
  return list;
}

val builtin_scenes() {
  return guarded([] {
    val list = val::array();
    for (const pliant::BuiltinScene& each : pliant::builtin_scenes()) {
      val entry = val::object();
      entry.set("name", std::string(each.name));
      entry.set("description", pliant::scene_description(each.text, each.name));
      list.call<void>("push", entry);
    }
    return list;
  });
}

using SceneClass = emscripten::class_<Scene>;

void bind_pictures(const SceneClass& scene) {
  scene
      .function(
          "look", +[](Scene& self, float aspect) { return guarded([&] { return self.look(aspect); }); })
      .function(
          "frame", +[](Scene& self) { return guarded([&] { return self.frame(pliant::ColorBy::none); }); })
      .function(
          "frame",
          +[](Scene& self, const std::string& color) { return guarded([&] { return self.frame(color_by(color)); }); })
      .function(
          "name", +[](Scene& self) { return self.session().scene().name; })
      .function(
          "description", +[](Scene& self) { return self.session().scene().description; })
      .function(
          "note", +[](Scene& self) { return self.session().note(); })
      .function(
          "rebuilds", +[](Scene& self) { return static_cast<double>(self.session().rebuilds()); })
      .function(
          "text", +[](Scene& self) { return guarded([&] { return self.scene().text(); }); })
      .function("warnings", &warnings);
}

void bind_time(const SceneClass& scene) {
  scene
      .function(
          "time", +[](Scene& self) { return self.simulation().state().time; })
      .function(
          "timeStep", +[](Scene& self) { return self.simulation().settings().time_step; })
      .function(
          "step", +[](Scene& self) { guarded([&] { self.session().step(); }); })
      .function(
          "restart", +[](Scene& self, bool keeps) { guarded([&] { self.scene().restart(keeps); }); });
}

void bind_hands(const SceneClass& scene) {
  scene.function("grab", &grab)
      .function(
          "pullTo",
          +[](Scene& self, float x, float y, float z) { guarded([&] {
                                                          self.session().pull_to({x, y, z});
                                                        }); })
      .function(
          "letGo", +[](Scene& self) { guarded([&] { self.session().let_go(); }); })
      .function(
          "pin", +[](Scene& self, double vertex) { guarded([&] { self.session().pin(index_of(vertex)); }); })
      .function(
          "unpin", +[](Scene& self, double vertex) { guarded([&] { self.session().unpin(index_of(vertex)); }); })
      .function(
          "movePin",
          +[](Scene& self, double vertex, float x, float y, float z) {
            guarded([&] { self.session().move_pin(index_of(vertex), {x, y, z}); });
          })
      .function(
          "dropPin", +[](Scene& self, double vertex) { guarded([&] { self.session().drop_pin(index_of(vertex)); }); })
      .function(
          "moveCollider",
          +[](Scene& self, double number, float x, float y, float z) {
            guarded([&] { self.session().move_collider(pliant::ColliderId{index_of(number)}, {x, y, z}); });
          })
      .function(
          "dropCollider", +[](Scene& self, double number) {
            guarded([&] { self.session().drop_collider(pliant::ColliderId{index_of(number)}); });
          });
}

void bind_edits(const SceneClass& scene) {
  scene.function("parameters", &parameters)
      .function("materials", &materials)
      .function(
          "set", +[](Scene& self, const std::string& key, Real x, Real y, Real z,
                     bool goes_on) { guarded([&] { self.session().set(key, pliant::Vec3(x, y, z), goes_on); }); })
      .function(
          "setMaterial",
          +[](Scene& self, const std::string& body, const std::string& material) {
            guarded([&] { self.session().set_material(body, material); });
          })
      .function(
          "undo", +[](Scene& self) { guarded([&] { self.session().undo(); }); })
      .function(
          "redo", +[](Scene& self) { guarded([&] { self.session().redo(); }); })
      .function(
          "undoneNext", +[](Scene& self) { return self.session().undone_next(); })
      .function(
          "redoneNext", +[](Scene& self) { return self.session().redone_next(); })
      .function(
          "hasChanges", +[](Scene& self) { return !self.session().changes().is_empty(); });
}

}  // namespace

EMSCRIPTEN_BINDINGS(pliant) {
  using emscripten::allow_raw_pointers;
  emscripten::function(
      "version", +[] { return std::string(pliant::version); });
  emscripten::function("builtinScenes", &builtin_scenes);
  emscripten::function("builtinScene", &builtin_scene);
  emscripten::function("colorMaps", &color_maps);
  emscripten::function("openScene", &open_scene, allow_raw_pointers());
  emscripten::function("openMesh", &open_mesh, allow_raw_pointers());
  emscripten::function("writeFile", &write_file);
  emscripten::function("removeFiles", &remove_files);
  const SceneClass scene("Scene");
  bind_pictures(scene);
  bind_time(scene);
  bind_hands(scene);
  bind_edits(scene);
}
