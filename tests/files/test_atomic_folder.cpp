#include <optional>

#include <doctest/doctest.h>

#include "pliant_io/files/atomic_folder.h"
#include "tests/mesh/meshes.h"
#include "tests/support/temporary_folder.h"

namespace test_atomic_folder {

namespace fs = std::filesystem;
using namespace pliant;
using namespace pliant_tests;

namespace {

bool is_letter(std::string_view name) {
  return name.size() == 1;
}

void write(const fs::path& file, std::string_view text) {
  std::ofstream(file) << text;
}

}  // namespace

TEST_CASE("a folder takes its name as a whole, in place of an earlier one, or leaves that one as it is") {
  const TemporaryFolder place;
  const fs::path path = place.path() / "frames";
  {
    AtomicFolder folder(path, is_letter);
    write(folder.temporary_path() / "a", "1");
    write(folder.temporary_path() / "b", "1");
    CHECK(!fs::exists(path));
    folder.commit();
  }
  {
    AtomicFolder folder(path, is_letter);
    write(folder.temporary_path() / "a", "2");
  }
  CHECK(TemporaryFolder::read(path / "a") == "1");
  {
    AtomicFolder folder(path, is_letter);
    write(folder.temporary_path() / "a", "3");
    folder.commit();
  }
  CHECK(TemporaryFolder::read(path / "a") == "3");
  CHECK(!fs::exists(path / "b"));
  CHECK(place.file_count() == 1);
}

TEST_CASE("a folder with other files is not replaced, nor a file, nor what another writer has") {
  const TemporaryFolder place;
  const fs::path path = place.path() / "frames";
  fs::create_directory(path);
  write(path / "mine.txt", "1");
  const std::string error = error_of([&] { AtomicFolder(path, is_letter); }, ErrorKind::output);
  CHECK(error.find("frames: this folder cannot be written: it holds other files, mine.txt for one;") != error.npos);
  fs::remove(path / "mine.txt");
  std::optional<AtomicFolder> one, two;
  one.emplace(path, is_letter);
  two.emplace(path, is_letter);
  CHECK(one->temporary_path() != two->temporary_path());
  write(one->temporary_path() / "a", "1");
  two->commit();
  one->commit();
  CHECK(TemporaryFolder::read(path / "a") == "1");
  write(place.path() / "file", "1");
  CHECK(error_of([&] { AtomicFolder(place.path() / "file", is_letter); }, ErrorKind::output)
            .find("a file of this name is there;") != error.npos);
}

TEST_CASE("what a killed writer left is removed by the next one") {
  const TemporaryFolder place;
  const fs::path left = place.path() / "frames.pliant.tmp-0";
  fs::create_directory(left);
  write(left / "a.pliant.tmp-0", "1");
  AtomicFolder folder(place.path() / "frames", is_letter);
  CHECK(folder.temporary_path() == left);
  CHECK(fs::is_empty(left));
}

}  // namespace test_atomic_folder
