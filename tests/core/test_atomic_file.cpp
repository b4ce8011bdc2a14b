#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/read_file.h"
#include "tests/mesh/meshes.h"
#include "tests/support/temporary_folder.h"

namespace test_atomic_file {

namespace fs = std::filesystem;
using namespace pliant;
using namespace pliant_tests;

TEST_CASE("an atomic file takes its name only at the commit") {
  const TemporaryFolder folder;
  const fs::path path = folder.write("a.txt", "old");
  SUBCASE("committed") {
    AtomicFile file(path);
    file.write("ne");
    file.write("w");
    CHECK(TemporaryFolder::read(path) == "old");
    file.commit();
    CHECK(TemporaryFolder::read(path) == "new");
  }
  SUBCASE("given up") {
    { AtomicFile(path).write("new"); }
    CHECK(TemporaryFolder::read(path) == "old");
  }
  CHECK(folder.file_count() == 1);
}

TEST_CASE("two writers of one name do not meet, and a leftover goes") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a";
  folder.write("a.pliant.tmp-0", "left over");
  folder.write("a.tmp-0", "of somebody else");
  AtomicFile first(path);
  AtomicFile second(path);
  CHECK(folder.file_count() == 3);
  first.write("first");
  second.write("second");
  first.commit();
  CHECK(TemporaryFolder::read(path) == "first");
  second.commit();
  CHECK(TemporaryFolder::read(path) == "second");
  CHECK(TemporaryFolder::read(folder.path() / "a.tmp-0") == "of somebody else");
  CHECK(folder.file_count() == 2);
}

TEST_CASE("leftovers are removed by the names of their files, and nothing that is being written") {
  const TemporaryFolder folder;
  AtomicFile written(folder.path() / "a");
  for (const char* name : {"a.pliant.tmp-1", "a.pliant.tmp-77", "b.pliant.tmp-0", "a.tmp-0"}) folder.write(name, "x");
  remove_leftovers(folder.path(), [](std::string_view name) { return name == "a"; });
  for (const char* name : {"a.pliant.tmp-0", "b.pliant.tmp-0", "a.tmp-0"}) {
    CHECK_MESSAGE(fs::exists(folder.path() / name), name);
  }
  CHECK(folder.file_count() == 3);
  written.write("new");
  written.commit();
  CHECK(TemporaryFolder::read(folder.path() / "a") == "new");
}

TEST_CASE("names may have any letters") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / fs::path(u8"Größe \u96f2.txt");
  write_file_atomically(path, "first");
  write_file_atomically(path, "second");
  CHECK(read_file(path) == "second");
  CHECK(folder.file_count() == 1);
  CHECK(folder.path() / fs::directory_iterator(folder.path())->path().filename() == path);
  const fs::path absent = folder.path() / fs::path(u8"Größe") / "a";
  CHECK(contains(error_of([&] { write_file_atomically(absent, "x"); }, ErrorKind::output), "Größe"));
}

TEST_CASE("what cannot be written is an output error with the path and the reason") {
  const TemporaryFolder folder;
  const auto message_for = [](const fs::path& path) {
    return error_of([&] { write_file_atomically(path, "x"); }, ErrorKind::output);
  };
  const fs::path absent = folder.path() / "absent" / "a";
  CHECK(contains(message_for(absent), absent.string() + ": cannot be written: No such file or directory;"));
  CHECK(contains(message_for(folder.path()), "Is a directory"));
  CHECK(folder.file_count() == 0);
}

}  // namespace test_atomic_file
