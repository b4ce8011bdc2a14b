#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "pliant_io/files/read_file.h"
#include "tests/support/temporary_folder.h"
#include "viewer/recent_files.h"

namespace test_recent_files {

using namespace pliant_tests;
using namespace pliant_viewer;
namespace fs = std::filesystem;
using Files = std::vector<fs::path>;

struct Recent {
  TemporaryFolder folder;
  fs::path list = folder.path() / "state" / "recent.json";

  fs::path file(const std::string& name) const {
    std::ofstream(folder.path() / name) << "x";
    return folder.path() / name;
  }
  void remember(const fs::path& file) const { remember_file(list, file); }
  Files read() const { return read_recent_files(list); }
};

TEST_CASE("recent files come newest first, each once, ten at most") {
  const Recent recent;
  CHECK(recent.read().empty());
  Files files;
  for (int i = 0; i < 12; ++i) files.push_back(recent.file("mesh " + std::to_string(i) + ".obj"));
  for (const fs::path& file : files) recent.remember(file);
  recent.remember(files[5]);
  CHECK(recent.read() ==
        Files{files[5], files[11], files[10], files[9], files[8], files[7], files[6], files[4], files[3], files[2]});
}

TEST_CASE("a recent file that is gone is not listed, and comes back when it does") {
  const Recent recent;
  const fs::path one = recent.file("one.obj"), two = recent.file("two.obj");
  recent.remember(one);
  recent.remember(two);
  fs::remove(two);
  CHECK(recent.read() == Files{one});
  recent.remember(one);
  recent.file("two.obj");
  CHECK(recent.read() == Files{one, two});
  recent.remember("nothing_of_the_kind");
  CHECK(recent.read() == Files{one, two});
}

TEST_CASE("a folder is remembered without the slash at its end, a link as the link") {
  const Recent recent;
  const fs::path run = recent.folder.path() / "run", link = recent.folder.path() / "link.obj";
  fs::create_directory(run);
  fs::create_symlink(recent.file("mesh.obj"), link);
  recent.remember(run / "");
  recent.remember(run / ".." / "run");
  recent.remember(link);
  CHECK(recent.read() == Files{link, run});
}

TEST_CASE("a list of recent files that is damaged or huge is begun anew, and one that cannot be written stays") {
  const Recent recent;
  const fs::path mesh = recent.file("mesh.obj");
  fs::create_directory(recent.list.parent_path());
  const std::string huge = "[\"" + mesh.string() + "\"]" + std::string(1 << 20, ' ');
  for (const std::string& text : {std::string(), std::string("[[["), std::string("{\"a\": 1}"), std::string("7"),
                                  std::string("\xff"), std::string(100'000, '['), huge}) {
    std::ofstream(recent.list, std::ios::trunc) << text;
    CHECK(recent.read().empty());
    recent.remember(mesh);
    CHECK(recent.read() == Files{mesh});
  }
  const std::string before = pliant::read_file(recent.list);
  recent.remember(recent.file("not UTF-8 \xff.obj"));
  CHECK(pliant::read_file(recent.list) == before);
  remember_file(mesh / "recent.json", mesh);  // below a file there is no folder
  CHECK(fs::is_regular_file(mesh));
  remember_file("", mesh);
}

}  // namespace test_recent_files
