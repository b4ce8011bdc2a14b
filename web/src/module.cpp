// The JavaScript module: what web_scene.h has, as the class Scene.
#include <exception>
#include <string>
#include <utility>

#include <emscripten/bind.h>

#include "pliant_io/scene/builtin_scenes.h"
#include "web_scene.h"

namespace {

using emscripten::val;
using pliant::Index;
using pliant::Real;
using pliant::Vec3;
using pliant_web::WebScene;

/// Calls f; what it throws becomes an Error of JavaScript with the same message.
template <class F>
auto guarded(F&& f) {
  std::string message;
  try {
    return f();
  } catch (const std::exception& error) {
    message = error.what();
  }
  val::global("Error").new_(message).throw_();
}

WebScene* open_scene(const std::string& text, const std::string& name) {
  return guarded([&] { return new WebScene(text, name); });  // NOLINT: delete() of the object in JavaScript frees it
}

/// A view of the numbers, m × 3, in the module's memory: until it grows, or the scene is deleted.
val positions(const WebScene& scene) {
  return val(
      emscripten::typed_memory_view(static_cast<std::size_t>(scene.positions().size()), scene.positions().data()));
}

/// A copy.
val triangles(const WebScene& scene) {
  return guarded([&] {
    const std::vector<pliant::Triangle> all = scene.triangles();
    return val::global("Int32Array").new_(val(emscripten::typed_memory_view(3 * all.size(), all.data()->data())));
  });
}

val parameters(const WebScene& scene) {
  return guarded([&] {
    val list = val::array();
    for (const pliant::Parameter& each : scene.parameters()) {
      val entry = val::object();
      entry.set("owner", each.name);
      entry.set("option", each.handle.option);
      entry.set("unit", each.unit);
      entry.set("doc", each.doc);
      entry.set("min", each.range.min);
      entry.set("max", each.range.max);
      val value = val::array();
      const int numbers = each.kind == pliant::ParameterKind::vector ? 3 : 1;
      for (int i = 0; i < numbers; ++i) value.call<void>("push", each.value[i]);
      entry.set("value", value);
      val choices = val::array();
      for (const std::string& choice : each.choices) choices.call<void>("push", choice);
      entry.set("choices", choices);
      list.call<void>("push", entry);
    }
    return list;
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

val builtin_scene_names() {
  val names = val::array();
  for (const pliant::BuiltinScene& each : pliant::builtin_scenes()) {
    names.call<void>("push", std::string(each.name));
  }
  return names;
}

}  // namespace

EMSCRIPTEN_BINDINGS(pliant) {
  emscripten::function("builtinSceneNames", &builtin_scene_names);
  emscripten::function("builtinScene", &builtin_scene);
  emscripten::class_<WebScene>("Scene")
      .constructor(&open_scene, emscripten::allow_raw_pointers())
      .function("positions", &positions)
      .function("triangles", &triangles)
      .function("parameters", &parameters)
      .function(
          "time", +[](const WebScene& self) { return self.scene().simulation.state().time; })
      .function(
          "timeStep", +[](const WebScene& self) { return self.scene().simulation.settings().time_step; })
      .function(
          "step", +[](WebScene& self) { guarded([&] { self.step(); }); })
      .function(
          "grab", +[](WebScene& self, Index vertex, Real stiffness, Real x, Real y,
                      Real z) { guarded([&] { self.grab(vertex, stiffness, Vec3(x, y, z)); }); })
      .function(
          "pullTo", +[](WebScene& self, Real x, Real y, Real z) { guarded([&] { self.pull_to(Vec3(x, y, z)); }); })
      .function(
          "letGo", +[](WebScene& self) { guarded([&] { self.let_go(); }); })
      .function(
          "pin", +[](WebScene& self, Index vertex) { guarded([&] { self.pin(vertex); }); })
      .function(
          "movePin", +[](WebScene& self, Index vertex, Real x, Real y,
                         Real z) { guarded([&] { self.move_pin(vertex, Vec3(x, y, z)); }); })
      .function(
          "unpin", +[](WebScene& self, Index vertex) { guarded([&] { self.unpin(vertex); }); })
      .function(
          "set", +[](WebScene& self, const std::string& owner, const std::string& option, Real x, Real y, Real z) {
            guarded([&] { self.set(owner, option, Vec3(x, y, z)); });
          });
}
