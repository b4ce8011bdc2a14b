#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/support/temporary_folder.h"
#include "viewer/recent_pictures.h"

namespace test_recent_pictures {

using namespace pliant_tests;
using namespace pliant_viewer;
namespace fs = std::filesystem;

struct Pictures {
  TemporaryFolder folder;
  fs::path kept = folder.path() / "cache" / "pictures";

  fs::path file(const std::string& name) const {
    std::ofstream(folder.path() / name) << "x";
    return folder.path() / name;
  }
};

TEST_CASE("the picture of a file comes again with its pixels, also for a name that is relative or ends in a slash") {
  const Pictures pictures;
  const fs::path scene = pictures.file("flag.json");
  const pliant_render::Image image{2, 1, {10, 20, 30, 200, 210, 220}};
  keep_recent_picture(pictures.kept, scene, image);
  const auto read = read_recent_picture(recent_picture_file(pictures.kept, scene));
  REQUIRE(read.has_value());
  CHECK(read->width == 2);
  CHECK(read->height == 1);
  CHECK(read->pixels == image.pixels);
  CHECK(recent_picture_file(pictures.kept, fs::relative(scene)) == recent_picture_file(pictures.kept, scene));
  CHECK(recent_picture_file(pictures.kept, "out/run/") == recent_picture_file(pictures.kept, "out/run"));
  CHECK(recent_picture_file(pictures.kept, "out/run") != recent_picture_file(pictures.kept, "out/ruin"));
  CHECK(recent_picture_file({}, scene).empty());
}

TEST_CASE("what is not there, or is no picture, has none; neither has a built-in scene") {
  const Pictures pictures;
  CHECK_FALSE(read_recent_picture(pictures.kept / "none.png").has_value());
  CHECK_FALSE(read_recent_picture(pictures.file("text.png")).has_value());
  keep_recent_picture(pictures.kept, "no_such_file", {1, 1, {1, 2, 3}});
  CHECK_FALSE(fs::exists(pictures.kept));
  keep_recent_picture(pictures.file("in_the_way"), pictures.file("flag.json"), {1, 1, {1, 2, 3}});  // no folder
}

TEST_CASE("the pictures that were written last are kept") {
  const Pictures pictures;
  const auto now = fs::file_time_type::clock::now();
  for (std::size_t i = 0; i < most_recent_pictures; ++i) {
    const fs::path file = pictures.file(std::to_string(i));
    keep_recent_picture(pictures.kept, file, {1, 1, {1, 2, 3}});
    const auto age = std::chrono::seconds(100 + (i == 7 ? 1000 : 0));
    fs::last_write_time(recent_picture_file(pictures.kept, file), now - age);
  }
  keep_recent_picture(pictures.kept, pictures.file("new"), {1, 1, {4, 5, 6}});
  const auto count = std::distance(fs::directory_iterator(pictures.kept), fs::directory_iterator());
  CHECK(static_cast<std::size_t>(count) == most_recent_pictures);
  CHECK_FALSE(fs::exists(recent_picture_file(pictures.kept, pictures.folder.path() / "7")));
  CHECK(fs::exists(recent_picture_file(pictures.kept, pictures.folder.path() / "new")));
}

TEST_CASE("a picture of half the size has the means of its pixels") {
  const pliant_render::Image image{4, 2, {0, 0, 0, 4,   8, 12, 1, 1, 1, 1, 1, 1,  //
                                          8, 0, 4, 100, 4, 0,  1, 1, 1, 1, 1, 1}};
  const pliant_render::Image half = halved(image);
  CHECK(half.width == 2);
  CHECK(half.height == 1);
  CHECK(half.pixels == std::vector<std::uint8_t>{28, 3, 4, 1, 1, 1});
  CHECK_THROWS_AS(halved({2, 2, {0}}), std::logic_error);
}

}  // namespace test_recent_pictures
