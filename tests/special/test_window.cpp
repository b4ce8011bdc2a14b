// The real window on a display of its own, driven by real events of mouse and keys (xdotool). CTest runs it under
// xvfb-run. Nothing is said about how long things take: what is waited for comes, or the test is ended from outside.
#define DOCTEST_CONFIG_IMPLEMENT
#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "desk.h"
#include "pliant/pliant.h"
#include "pliant_io/export/animation.h"
#include "viewer/playback.h"

using namespace pliant_tests;

namespace {

/// Share of the pixels that differ by more than a little.
double difference(const Desk::Picture& a, const Desk::Picture& b) {
  if (a.width != b.width || a.height != b.height) return 1;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); i += 3) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(int{a.pixels[i + c]} - int{b.pixels[i + c]}));
    count += most > 12 ? 1 : 0;
  }
  return static_cast<double>(count) / (static_cast<double>(a.pixels.size()) / 3);
}

constexpr std::uint32_t middle = side * 5 + 6;

}  // namespace

TEST_CASE("a ball is seen, follows the mouse through the picture, and its slider makes it larger") {
  Desk desk([] {
    Scene scene = make_sheet();
    scene.simulation.add(pliant::SphereCollider{.center = {0.5, -0.6, 0.5}, .radius = 0.15}, "ball");
    return scene;
  });
  const auto ball = [&] { return desk.shown().frame.content.colliders.at(0).pose.position.cast<float>().eval(); };
  const auto place = [&] { return desk.viewer.screen().place_of(ball()).value(); };
  const auto pixel = [](const Desk::Picture& picture, const Vec2f& at) {
    const auto first = 3 * static_cast<std::size_t>(std::lround(at.y()) * picture.width + std::lround(at.x()));
    return std::array<int, 3>{picture.pixels[first], picture.pixels[first + 1], picture.pixels[first + 2]};
  };
  const Vec2f from = place(), to = from + Vec2f(120, 30);
  const auto is_gray_blue = [](const std::array<int, 3>& color) {
    return color[0] < color[2] && color[2] - color[0] < 40 && color[2] < 205;
  };
  CHECK(is_gray_blue(pixel(desk.picture(), from)));
  CHECK_FALSE(is_gray_blue(pixel(desk.picture(), to)));
  desk.drag(from, to);
  REQUIRE(desk.viewer.interaction().collider_goal().has_value());
  const Vec3f goal = *desk.viewer.interaction().collider_goal();
  desk.turn_until([&] { return (ball() - goal).norm() < 1e-4F; });
  CHECK((place() - to).norm() < 0.1F * (to - from).norm());  // what the mouse holds is nearer than the middle
  desk.release();
  CHECK_FALSE(desk.viewer.interaction().is_busy());
  const Vec3f rest = ball();
  desk.turns(10);
  CHECK((ball() - rest).norm() < 1e-4F);
  const Desk::Picture moved = desk.picture();
  CHECK(is_gray_blue(pixel(moved, to)));
  CHECK_FALSE(is_gray_blue(pixel(moved, from)));

  CHECK(desk.parameter("collider:ball.radius") == 0.15);
  REQUIRE(desk.source.parameter_panel().place_of("collider:ball.radius").has_value());
  desk.source.live()->post([](CommandContext& context) { context.session.set("collider:ball.radius", {0.2, 0, 0}); });
  desk.turn_until([&] { return desk.parameter("collider:ball.radius") == 0.2; });
  CHECK(difference(moved, desk.picture()) > 0.01);

  desk.key("o");
  CHECK_FALSE(is_gray_blue(pixel(desk.picture(), to)));
  desk.drag(to, from);
  CHECK_FALSE(desk.viewer.interaction().collider_goal().has_value());
  desk.release();
  desk.key("o");
  CHECK((ball() - rest).norm() < 1e-4F);
}

TEST_CASE("the surface follows the mouse that pulls at it, and comes back") {
  Desk desk;
  desk.settle();
  const Vec3f home = desk.position(middle);
  const Vec2f from = desk.place(middle);
  const Vec2f to = from + Vec2f(90, 60);
  const float depth = desk.viewer.screen().depth_of(home);
  for (int i = 0; i < 8; ++i) desk.key("plus");
  desk.drag(from, to);
  REQUIRE(desk.viewer.interaction().pull().has_value());
  const Vec3f target = desk.viewer.interaction().pull()->target;
  // The mouse counts whole pixels; the target is under it, at the depth of what was taken hold of.
  CHECK((desk.viewer.screen().place_of(target).value() - to).norm() < 1);
  CHECK(std::abs(desk.viewer.screen().depth_of(target) - depth) < 0.02F);
  desk.turn_until([&] { return desk.shown().pull.has_value() && (desk.place(middle) - to).norm() < 45; });
  CHECK((desk.shown().pull->target - target).norm() < 1e-4F);
  desk.release();
  desk.turn_until([&] { return !desk.shown().pull.has_value(); });
  desk.turn_until([&] { return (desk.position(middle) - home).norm() < 0.1F; });
}

TEST_CASE("a click pins, another lets go, and a pin is dragged to where the mouse takes it") {
  Desk desk;
  desk.settle();
  const Vec3f before = desk.position(middle);
  desk.click(desk.place(middle));
  desk.turn_until([&] { return desk.shown().pins.size() == 3; });
  // The sheet hangs almost still: the nearest vertex is the one that was aimed at.
  CHECK(desk.is_pinned(middle));
  const Vec2f to = desk.place(middle) + Vec2f(-25, 45);  // down, where the sheet is taut: no fold lies before the pin
  desk.drag(desk.place(middle), to);
  desk.turn_until([&] { return (desk.place(middle) - to).norm() < 2; });
  desk.release();
  CHECK((desk.position(middle) - before).norm() > 0.05F);
  const Vec3f there = desk.position(middle);
  const std::int64_t step = desk.shown().step;
  desk.turn_until([&] { return desk.shown().step > step + 30; });
  CHECK((desk.position(middle) - there).norm() < 1e-5F);
  desk.click(desk.place(middle));
  desk.turn_until([&] { return !desk.is_pinned(middle); });
  desk.turn_until([&] { return (desk.position(middle) - there).norm() > 0.02F; });
}

TEST_CASE("keys play, step, start over, color and help") {
  Desk desk;
  desk.key("space");
  desk.turn_until([&] { return !desk.shown().is_playing; });
  const std::int64_t step = desk.shown().step;
  desk.key("s");
  desk.turn_until([&] { return desk.shown().step == step + 1; });
  desk.key("r");
  desk.turn_until([&] { return desk.shown().step == 0 && desk.shown().restarts == 1; });
  desk.key("c");
  CHECK(desk.viewer.appearance().color == pliant::ColorBy::stretch);
  desk.turn_until([&] { return desk.shown().frame.content.values.size() == side * side; });
  desk.key("w");
  CHECK(desk.viewer.appearance().wireframe);
  desk.key("h");
  CHECK(desk.viewer.is_help_open());
  desk.key("Escape");
  CHECK_FALSE(desk.viewer.is_help_open());
  desk.key("space");
  desk.turn_until([&] { return desk.shown().is_playing && desk.shown().step > 5; });
  desk.key("ctrl+q");
  CHECK(desk.window.wants_to_close());
}

TEST_CASE("a slider changes what it stands for, and a restart keeps that") {
  Desk desk;
  const std::string name = "settings.iterations";
  CHECK(desk.parameter(name) == 20);
  const auto rect = desk.source.parameter_panel().place_of(name);
  REQUIRE(rect.has_value());
  const float y = ((*rect)[1] + (*rect)[3]) / 2;
  desk.click({(*rect)[2] - 3, y});
  desk.turn_until([&] { return desk.parameter(name) > 60; });
  desk.key("r");
  desk.turn_until([&] { return desk.shown().restarts == 1; });
  CHECK(desk.parameter(name) > 60);
  desk.key("shift+r");
  desk.turn_until([&] { return desk.shown().restarts == 2; });
  desk.turn_until([&] { return desk.parameter(name) == 20; });
  // Beside the sliders nothing of this has turned the camera or taken hold of the sheet.
  CHECK(desk.shown().pins.size() == 2);
}

TEST_CASE("a material is chosen from the menu of a body, and chosen again after a restart") {
  Desk desk;
  const auto material = [&] { return desk.shown().materials->front().material; };
  CHECK(material().empty());
  const auto rect = desk.source.material_panel().place_of("body 0");
  REQUIRE(rect.has_value());
  desk.click({((*rect)[0] + (*rect)[2]) / 2, ((*rect)[1] + (*rect)[3]) / 2});
  desk.turns(5);
  desk.click({((*rect)[0] + (*rect)[2]) / 2, (*rect)[3] + 30});  // in the list below
  desk.turn_until([&] { return !material().empty(); });
  CHECK(pliant::find_builtin_material(material()) != nullptr);
  CHECK(desk.shown().pins.size() == 2);
  const std::string chosen = material();
  desk.key("r");
  desk.turn_until([&] { return desk.shown().restarts == 1; });
  CHECK(material() == chosen);
  desk.key("shift+r");
  desk.turn_until([&] { return desk.shown().restarts == 2; });
  desk.turn_until([&] { return material().empty(); });
}

TEST_CASE("keys that come between two pictures are neither lost nor taken for others") {
  Desk desk;
  desk.key("space");
  desk.turn_until([&] { return !desk.shown().is_playing; });
  const std::int64_t step = desk.shown().step;
  xdotool("key s s s");  // nobody looks until it is over
  desk.turn_until([&] { return desk.shown().step >= step + 3; });
  CHECK(desk.shown().step == step + 3);
  const std::string name = "settings.iterations";
  desk.type_into(name);
  xdotool("key 3 BackSpace 4 5 Return space");
  desk.turn_until([&] { return desk.shown().is_playing; });  // the space after the Return that ends the field
  CHECK(desk.parameter(name) == 45);
}

TEST_CASE("Ctrl+Q closes the window while a field has the keyboard") {
  Desk desk;
  desk.type_into("settings.iterations");
  CHECK_FALSE(desk.window.wants_to_close());
  desk.key("ctrl+q");
  CHECK(desk.window.wants_to_close());
}

TEST_CASE("the camera turns, moves, nears, and frames everything again") {
  Desk desk;
  desk.key("space");
  desk.turn_until([&] { return !desk.shown().is_playing; });
  desk.turns(3);
  const Desk::Picture first = desk.picture();
  CHECK(difference(first, desk.picture()) < 0.001);
  const auto view = [&] { return desk.viewer.screen().viewpoint; };
  const Vec3f eye = view().eye;
  desk.drag({100, 500}, {220, 470});  // beside the sheet
  desk.release();
  CHECK((view().eye - eye).norm() > 0.2F);
  CHECK((view().eye - view().target).norm() == doctest::Approx((eye - view().target).norm()).epsilon(1e-3));
  CHECK(view().right().z() == doctest::Approx(0).epsilon(1e-3));  // the horizon stays level
  CHECK(difference(first, desk.picture()) > 0.02);
  const Vec3f target = view().target;
  desk.drag({100, 500}, {140, 500}, 2);
  desk.release(2);
  CHECK((view().target - target).dot(view().right()) < -0.02F);
  CHECK(std::abs((view().target - target).dot(view().forward())) < 1e-3F);
  const float far = (view().eye - view().target).norm();
  xdotool("click 4 click 4");
  desk.turns(3);
  const float near = (view().eye - view().target).norm();
  CHECK(near < 0.9F * far);
  desk.key("f");
  for (const Vec3f& p : desk.shown().frame.content.positions) {
    const auto place = desk.viewer.screen().place_of(p);
    REQUIRE(place.has_value());
    CHECK(place->x() > 0);
    CHECK(place->x() < desk.viewer.screen().size.x());
    CHECK(place->y() > 0);
    CHECK(place->y() < desk.viewer.screen().size.y());
  }
}

TEST_CASE("the window may be resized, hidden and closed while it simulates; picking is right after it") {
  for (const int samples : {1, 4}) {
    Desk desk(make_sheet, samples);
    for (const char* size : {"400 300", "333 641", "980 600"}) {
      xdotool(fmt::format("search --name 'Pliant test' windowsize --sync {}", size));
      desk.turns(5);
    }
    CHECK(desk.window.size().x() == 980);
    desk.settle();
    desk.click(desk.place(middle));
    desk.turn_until([&] { return desk.shown().pins.size() == 3; });
    CHECK(desk.is_pinned(middle));
    xdotool("search --name 'Pliant test' windowunmap");
    desk.turns(5);
    const std::int64_t step = desk.shown().step;
    desk.turn_until([&] { return desk.shown().step > step + 10; });
    xdotool("search --name 'Pliant test' windowmap");
    const std::uint64_t pictures = desk.viewer.frame_count();
    desk.turn_until([&] { return desk.viewer.frame_count() > pictures + 2; });
  }
}

TEST_CASE("yanking the mouse across the screen explodes nothing") {
  Desk desk;
  desk.settle();
  for (int i = 0; i < 30; ++i) desk.key("plus");  // the stiffest pull there is
  desk.drag(desk.place(middle), {5, 5});
  for (const Vec2f& to : {Vec2f(650, 600), Vec2f(3, 400), Vec2f(690, 3), Vec2f(300, 630), Vec2f(20, 20)}) {
    desk.move(to);
  }
  desk.release();
  for (const Vec3f& p : desk.shown().frame.content.positions) REQUIRE(p.allFinite());
  desk.source.live()->post([](CommandContext& context) { context.pacer.set_speed(Pacer::unlimited); });
  // It may have passed through itself and hang in other folds, but it hangs from its hooks again.
  const auto reach = [&] {
    float farthest = 0;
    for (const Vec3f& p : desk.shown().frame.content.positions) {
      farthest = std::max(farthest, (p - desk.position(side * side - 1)).norm());
    }
    return farthest;
  };
  desk.turn_until([&] { return reach() < 1.6F; });
  CHECK(desk.shown().note.empty());
}

TEST_CASE("a run is played at its own times, frame by frame, and from where the time bar is clicked") {
  const Scene scene = make_sheet();
  const pliant::Mesh& mesh = scene.simulation.body(pliant::BodyId{0}).mesh;
  std::vector<pliant::Positions> frames;
  std::vector<pliant::Real> times;
  for (int i = 0; i < 41; ++i) {
    frames.push_back(mesh.vertices.rowwise() + Eigen::RowVector3d(0.02 * i, 0, 0));
    times.push_back(0.01 * i);
  }
  Playback source(
      pliant_render::RunFrames(pliant::animate(mesh, "run", pliant::PointCache::from_frames(frames, times))), {}, true);
  source.set_looping(false);
  Window window("Pliant test", 1000, 640);
  Viewer viewer(window, source, ViewerOptions());
  const auto turn_until = [&](const std::function<bool()>& is_so) {
    while (!is_so()) viewer.turn(0.05);
  };
  const auto x = [&] { return source.frame().content.positions[0].x(); };
  const float start = static_cast<float>(mesh.vertices(0, 0));
  turn_until([&] { return !source.is_playing(); });  // to its end, where it stops
  CHECK(source.place() == 40);
  CHECK(x() == doctest::Approx(start + 0.8F));
  xdotool("search --sync --name 'Pliant test' windowfocus key Left key Left");
  turn_until([&] { return source.place() == 38; });
  viewer.turn(0.05);
  CHECK(x() == doctest::Approx(start + 0.76F));
  xdotool("key r");
  turn_until([&] { return source.place() == 0; });
  source.set_looping(true);
  source.play(true);
  turn_until([&] { return source.place() > 20; });
  turn_until([&] { return source.place() < 10; });
  source.step(-1);
  // The bar lies at the lower edge; its slider begins behind the button.
  xdotool("mousemove 390 615");
  for (int i = 0; i < 3; ++i) viewer.turn(0.05);
  xdotool("mousedown 1");
  turn_until([&] { return source.place() > 10; });
  xdotool("mouseup 1");
  for (int i = 0; i < 3; ++i) viewer.turn(0.05);
  CHECK(source.place() < 30);
  xdotool("key c");
  turn_until([&] { return viewer.appearance().color == pliant::ColorBy::stretch; });
  xdotool("key c");
  turn_until([&] { return viewer.appearance().color == pliant::ColorBy::speed; });  // energy is not known of a run
  viewer.turn(0.05);
  CHECK(source.frame().content.values.front() == doctest::Approx(2));
  CHECK(source.range().value()[1] == doctest::Approx(2));
}

int main(int argc, char** argv) {
  return run_on_display(argc, argv);
}
