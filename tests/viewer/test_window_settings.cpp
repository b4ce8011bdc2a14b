#include <filesystem>
#include <fstream>

#include <doctest/doctest.h>

#include "tests/support/temporary_folder.h"
#include "viewer/window_settings.h"

namespace test_window_settings {

using namespace pliant_tests;
using namespace pliant_viewer;

TEST_CASE("settings of the window are read as they were written") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "state" / "window.json";
  CHECK(read_window_settings(file) == WindowSettings{});
  const WindowSettings dark{Theme::dark, 1.5F}, light{Theme::light, 0};
  write_window_settings(file, dark);
  CHECK(read_window_settings(file) == dark);
  write_window_settings(file, light);
  CHECK(read_window_settings(file) == light);
  write_window_settings({}, dark);  // nowhere
}

TEST_CASE("settings that make no sense are those of a first start, and a folder in the way does no harm") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "window.json";
  for (const char* text : {"", "[", "{\"theme\": \"purple\", \"scale\": 17}", "{\"theme\": 3}", "7"}) {
    CAPTURE(text);
    std::ofstream(file) << text;
    CHECK(read_window_settings(file) == WindowSettings{});
  }
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  write_window_settings(file, {Theme::dark, 2});
  CHECK(read_window_settings(file) == WindowSettings{});
}

TEST_CASE("panels are larger in windows of many pixels, and never smaller than the desktop has letters") {
  CHECK(automatic_scale(1, {1000, 640}) == 1);
  CHECK(automatic_scale(1, {1280, 720}) == 1);
  CHECK(automatic_scale(1, {1920, 1080}) == 1);
  CHECK(automatic_scale(1, {2560, 1440}) == 1.5F);
  CHECK(automatic_scale(1, {3840, 2160}) == 2);
  CHECK(automatic_scale(1, {7680, 4320}) == 2);
  CHECK(automatic_scale(1, {3840, 720}) == 1);
  CHECK(automatic_scale(2.25F, {2560, 1440}) == 2.25F);
  CHECK(automatic_scale(1, {0, 0}) == 1);
}

TEST_CASE("the next scale is the next one there is, and the last stays") {
  CHECK(next_scale(1, true) == 1.25F);
  CHECK(next_scale(1, false) == 0.75F);
  CHECK(next_scale(1.1F, true) == 1.25F);
  CHECK(next_scale(1.1F, false) == 1);
  CHECK(next_scale(3, true) == 3);
  CHECK(next_scale(0.75F, false) == 0.75F);
}

}  // namespace test_window_settings
