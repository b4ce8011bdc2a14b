// Films of what the real window shows, by mouse and keys.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "desk.h"

using namespace pliant_tests;

namespace {

struct FilmDesk : Desk {
  explicit FilmDesk(MakeScene make = make_sheet) : Desk(std::move(make)) {
    viewer.film_panel().choices = {.format = pliant_render::FilmFormat::png, .fps = 30, .quality = FilmQuality::window};
  }
  void pause() {
    source.play(false);
    turn_until([&] { return !shown().is_playing; });
    turns(3);
  }
  const FilmRecorder& film() { return *viewer.film_under_way(); }
  /// Films until so many seconds have gone by; returns how many pictures that gave.
  int film_until(double time) {
    turn_until([&] { return shown().frame.time >= time; });
    pause();
    const int pictures = film().clock().pictures();
    key("v");
    turn_until([&] { return viewer.film_under_way() == nullptr; });
    return pictures;
  }
  Picture read(const std::string& name) {
    Picture picture;
    int channels = 0;
    unsigned char* data = stbi_load((folder.path() / name).c_str(), &picture.width, &picture.height, &channels, 3);
    REQUIRE(data != nullptr);
    picture.pixels.assign(data, data + 3 * static_cast<std::ptrdiff_t>(picture.width) * picture.height);
    stbi_image_free(data);
    return picture;
  }
  void restart_paused() {
    pause();
    key("r");
    turn_until([&] { return shown().step == 0; });
    turns(3);
  }
};

Scene make_unmarked_sheet() {
  Scene scene = make_sheet();
  scene.view.markers = false;
  return scene;
}

}  // namespace

TEST_CASE("a film has evenly so many pictures a second of the simulated time") {
  FilmDesk desk;
  desk.restart_paused();
  desk.key("v");
  REQUIRE(desk.viewer.film_under_way() != nullptr);
  desk.turns(10);
  CHECK(desk.film().clock().pictures() == 1);  // nothing moves
  desk.source.play(true);
  const int pictures = desk.film_until(1);
  const double time = desk.shown().frame.time;
  CHECK(pictures == 1 + static_cast<int>(std::floor(30 * time + 1e-4)));
  CHECK(desk.folder.file_count() == static_cast<std::size_t>(pictures));
  CHECK(desk.viewer.message().starts_with("saved "));
  CHECK(desk.viewer.message().ends_with(fmt::format("{:.1f} s", pictures / 30.0)));
  // The simulation goes on as before.
  desk.source.play(true);
  desk.turn_until([&] { return desk.shown().frame.time > time + 1; });
}

TEST_CASE("the film shows what the window does, but for the marks of pins") {
  for (const bool has_marks : {true, false}) {
    FilmDesk desk(has_marks ? make_sheet : make_unmarked_sheet);
    desk.restart_paused();
    const Desk::Picture seen = desk.picture();
    desk.key("v");
    desk.key("v");
    desk.turn_until([&] { return desk.viewer.film_under_way() == nullptr; });
    const Desk::Picture filmed = desk.read("sheet-1-00000.png");
    REQUIRE(seen.width == filmed.width);
    REQUIRE(seen.height == filmed.height);
    int different = 0;
    for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
      if (std::abs(seen.pixels[i] - filmed.pixels[i]) > 1) ++different;  // 1: how the scale is rounded
    }
    if (!has_marks) CHECK(different == 0);
    if (has_marks) CHECK(different > 60);  // of two small dots
    CHECK(different < 6000);
  }
}

TEST_CASE("slow motion, another size, a restart and a film that is left") {
  FilmDesk desk;
  desk.restart_paused();
  desk.viewer.film_panel().choices.size = {300, 200};
  desk.source.set_speed(0.5);
  desk.key("v");
  desk.source.play(true);
  desk.turn_until([&] { return desk.shown().frame.time > 0.5; });
  desk.key("r");
  desk.turn_until([&] { return desk.shown().frame.time < 0.4; });
  const int before = desk.film().clock().pictures();
  CHECK(before >= 30);
  const int all = desk.film_until(0.5);
  CHECK(all >= 60);
  const Desk::Picture picture = desk.read(fmt::format("sheet-1-{:05}.png", all - 1));
  CHECK(picture.width == 300);
  CHECK(picture.height == 200);
  // Its place in the folder is gone: that is told, and nothing waits.
  std::filesystem::remove_all(desk.folder.path());
  desk.source.play(true);
  desk.key("v");
  desk.turn_until([&] { return desk.viewer.message().find("cannot be written") != std::string::npos; });
  desk.turn_until([&] { return desk.viewer.film_under_way() == nullptr; });
  const double time = desk.shown().frame.time;
  desk.turn_until([&] { return desk.shown().frame.time > time + 0.3; });
}

TEST_CASE("the button films as well, and whoever closes the window keeps the film") {
  FilmDesk desk;
  desk.viewer.film_panel().choices.format = pliant_render::FilmFormat::mp4;
  const auto button = desk.viewer.film_panel().place_of("button").value();
  desk.click({(button[0] + button[2]) / 2, (button[1] + button[3]) / 2});
  desk.turn_until([&] { return desk.viewer.film_under_way() != nullptr; });
  desk.turn_until([&] { return desk.film().clock().pictures() > 5; });
  const std::string text = desk.viewer.finish_film();
  CHECK(text.starts_with("saved "));
  CHECK(desk.viewer.film_under_way() == nullptr);
  CHECK(desk.folder.file_count() >= 1);
  CHECK(desk.viewer.finish_film().empty());
}

int main(int argc, char** argv) {
  return run_on_display(argc, argv);
}
