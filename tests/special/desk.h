#pragma once
// A real window on a display of its own, driven by real events of mouse and keys (xdotool), for programs that CTest
// runs under xvfb-run. Nothing is said about how long things take: what is waited for comes, or the test is ended from
// outside.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <stb/stb_image.h>

#include "../support/temporary_folder.h"
#include "pliant/core/error.h"
#include "pliant/pliant.h"
#include "viewer/live_source.h"
#include "viewer/viewer.h"

namespace pliant_tests {

using namespace pliant_viewer;
using pliant::Scene;

constexpr pliant::Index side = 12;

/// A sheet of a meter, hung by two corners; it comes to rest soon.
inline Scene make_sheet() {
  Scene scene;
  scene.name = "sheet";
  scene.simulation.set_settings({.iterations = 20, .threads = 1});
  const pliant::BodyId sheet = scene.simulation.add_body(
      pliant::grid({.columns = side, .rows = side, .plane = pliant::Plane::xz}), pliant::Mass::area_density(0.3));
  scene.simulation.add(sheet, pliant::TriangleStrain{.stiffness = 500}, "stretch");
  scene.simulation.add(sheet, pliant::HingeBending{.stiffness = 1e-3}, "bend");
  scene.simulation.add(sheet, pliant::Position{.on = {side * (side - 1), side * side - 1}}, "hooks");
  scene.simulation.add(pliant::Gravity{});
  scene.simulation.add(sheet, pliant::Wind{.velocity = {0, 0, 0}, .drag = 3});
  return scene;
}

inline void xdotool(const std::string& arguments) {
  REQUIRE(std::system(("xdotool " + arguments).c_str()) == 0);
}

/// A window with a source, and hands on mouse and keys.
struct Desk {
  pliant_tests::TemporaryFolder folder, state;
  Window window{"Pliant test", 1000, 640};
  LiveSource source;
  Viewer viewer;

  explicit Desk(MakeScene make = make_sheet, int samples = 1, std::function<std::string(const std::string&)> open = {},
                std::optional<SessionRecord> record = {})
      : source(std::move(make), 1, true, Window::wake, std::move(record)),
        viewer(window, source,
               {.appearance = source.appearance(),
                .samples = samples,
                .picture_folder = folder.path(),
                .open = std::move(open),
                .scenes = {{"flag", "A flag"},
                           {"towel", "A towel over a rail"},
                           {"shirt.obj", "~/meshes", "/home/meshes/shirt.obj", "Recent"}},
                .settings_file = state.path() / "window.json"}) {
    turn_until([&] { return viewer.frame_count() > 3; });
    xdotool("search --sync --name 'Pliant test' windowfocus");
    turns(3);
  }
  void turns(int count) {
    for (int i = 0; i < count; ++i) viewer.turn(0.05);
  }
  void turn_until(const std::function<bool()>& is_so) {
    while (!is_so()) viewer.turn(0.05);
  }
  void key(const std::string& name) {
    xdotool("key " + name);
    turns(3);
  }
  void move(const Vec2f& to) {
    xdotool(fmt::format("mousemove {} {}", std::lround(to.x()), std::lround(to.y())));
    turns(2);
  }
  void press(int button = 1) {
    xdotool(fmt::format("mousedown {}", button));
    turns(2);
  }
  void release(int button = 1) {
    xdotool(fmt::format("mouseup {}", button));
    turns(2);
  }
  void click(const Vec2f& at) {
    move(at);
    press();
    release();
  }
  void drag(const Vec2f& from, const Vec2f& to, int button = 1) {
    move(from);
    press(button);
    move(from + 0.3F * (to - from));
    move(to);
  }
  const Snapshot& shown() { return source.snapshot(); }
  Vec3f position(std::uint32_t vertex) { return shown().frame.content.positions[vertex]; }
  Vec2f place(std::uint32_t vertex) { return viewer.screen().place_of(position(vertex)).value(); }
  bool is_pinned(std::uint32_t vertex) { return std::ranges::binary_search(shown().pins, vertex); }
  double parameter(std::string_view key) {
    for (const Slider& slider : *shown().sliders) {
      if (slider.key == key) return slider.parameter.value[0];
    }
    throw std::logic_error("no such parameter");
  }
  /// Turns a slider into a field, which takes what is typed from then on.
  void type_into(const std::string& key) {
    const auto rect = source.parameter_panel().place_of(key).value();
    move({(rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2});
    xdotool("keydown ctrl click 1 keyup ctrl");
    turns(4);
  }
  /// Lets the sheet hang still; it goes on in real time.
  void settle() {
    source.live()->post([](CommandContext& context) { context.pacer.set_speed(Pacer::unlimited); });
    turn_until([&] { return shown().step > 1500; });
    source.live()->post([](CommandContext& context) { context.pacer.set_speed(1); });
  }
  struct Picture {
    int width = 0, height = 0;
    std::vector<unsigned char> pixels;
  };
  /// What the window shows, saved by its own key.
  Picture picture() {
    const std::size_t before = folder.file_count();
    key("p");
    turn_until([&] { return folder.file_count() > before; });
    const auto file = folder.path() / fmt::format("pliant-{:04}.png", before + 1);
    Picture picture;
    int channels = 0;
    unsigned char* data = stbi_load(file.c_str(), &picture.width, &picture.height, &channels, 3);
    REQUIRE(data != nullptr);
    picture.pixels.assign(data, data + 3 * static_cast<std::ptrdiff_t>(picture.width) * picture.height);
    stbi_image_free(data);
    return picture;
  }
};

/// The main() of such a program: skips where there is no display.
inline int run_on_display(int argc, char** argv) {
  try {
    Window::require_display();
  } catch (const pliant::Error&) {
    fmt::print("skipped: there is no display\n");
    return 77;
  }
  if (std::system("xdotool version > /dev/null 2>&1") != 0) {
    fmt::print("skipped: xdotool is not installed\n");
    return 77;
  }
  return doctest::Context(argc, argv).run();
}

/// What a desktop does when files are let go over the window.
inline void drop(Desk& desk, const std::vector<std::string>& files) {
  std::vector<const char*> names;
  for (const std::string& file : files) names.push_back(file.c_str());
  const GLFWdropfun callback = glfwSetDropCallback(desk.window.handle(), nullptr);
  REQUIRE((callback != nullptr));
  glfwSetDropCallback(desk.window.handle(), callback);
  callback(desk.window.handle(), static_cast<int>(names.size()), names.data());
}

}  // namespace pliant_tests
