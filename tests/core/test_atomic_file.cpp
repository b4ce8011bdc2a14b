#include <csignal>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <sys/resource.h>

#include "pliant_io/files/atomic_file.h"
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
  const fs::path target = folder.write("target", "mine");
  AtomicFile written(folder.path() / "a");
  for (const char* name : {"a.pliant.tmp-1", "a.pliant.tmp-77", "b.pliant.tmp-0", "a.tmp-0"}) folder.write(name, "x");
  fs::create_symlink(target, folder.path() / "a.pliant.tmp-2");
  remove_leftovers(folder.path(), [](std::string_view name) { return name == "a"; });
  for (const char* name : {"a.pliant.tmp-0", "b.pliant.tmp-0", "a.tmp-0", "a.pliant.tmp-2", "target"}) {
    CHECK_MESSAGE(fs::exists(folder.path() / name), name);
  }
  CHECK(folder.file_count() == 5);
  written.write("new");
  written.commit();
  CHECK(TemporaryFolder::read(folder.path() / "a") == "new");
}

TEST_CASE("a link is followed") {
  const TemporaryFolder folder;
  const fs::path target = folder.write("target", "old");
  fs::create_symlink(target, folder.path() / "link");
  write_file_atomically(folder.path() / "link", "new");
  CHECK(fs::is_symlink(folder.path() / "link"));
  CHECK(TemporaryFolder::read(target) == "new");
}

TEST_CASE("links to links are followed to their end, whether a file is there or not") {
  const TemporaryFolder folder;
  const fs::path inner = folder.path() / "inner";
  fs::create_directory(inner);
  fs::create_symlink("inner/b", folder.path() / "a");
  fs::create_symlink("../c", inner / "b");
  fs::create_symlink(folder.path() / "target", folder.path() / "c");
  for (const std::string text : {"first", "second"}) {
    write_file_atomically(folder.path() / "a", text);
    for (const fs::path& link : {folder.path() / "a", inner / "b", folder.path() / "c"}) CHECK(fs::is_symlink(link));
    CHECK(fs::is_regular_file(fs::symlink_status(folder.path() / "target")));
    CHECK(TemporaryFolder::read(folder.path() / "target") == text);
  }
}

TEST_CASE("links that lead round are refused, and stay") {
  const TemporaryFolder folder;
  fs::create_symlink("b", folder.path() / "a");
  fs::create_symlink("a", folder.path() / "b");
  const std::string message = error_of([&] { write_file_atomically(folder.path() / "a", "x"); }, ErrorKind::output);
  CHECK(contains(message, (folder.path() / "a").string() + ": cannot be written: Too many levels of symbolic links;"));
  CHECK(fs::is_symlink(folder.path() / "a"));
  CHECK(folder.file_count() == 2);
}

namespace {

/// A limit on the size of files, which makes writing fail as a full disk does.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    REQUIRE(getrlimit(RLIMIT_FSIZE, &old_limit_) == 0);
    const rlimit limit{bytes, old_limit_.rlim_max};
    REQUIRE(setrlimit(RLIMIT_FSIZE, &limit) == 0);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*old_handler_)(int);
  rlimit old_limit_{};
};

}  // namespace

TEST_CASE("a write that fails, at once or only at the flush, leaves the old file and no temporary") {
  const TemporaryFolder folder;
  const fs::path path = folder.write("a", "old");
  for (const std::size_t size : {std::size_t{1001}, std::size_t{1} << 20}) {
    std::string message;
    {
      const FileSizeLimit limit(1000);
      message = error_of([&] { write_file_atomically(path, std::string(size, 'x')); }, ErrorKind::output);
    }
    CHECK(contains(message, path.string() + ": cannot be written: File too large;"));
    CHECK(TemporaryFolder::read(path) == "old");
    CHECK(folder.file_count() == 1);
  }
}

TEST_CASE("what cannot be written is an output error with the path and the reason") {
  const TemporaryFolder folder;
  const auto message_for = [](const fs::path& path) {
    return error_of([&] { write_file_atomically(path, "x"); }, ErrorKind::output);
  };
  const fs::path absent = folder.path() / "absent" / "a";
  CHECK(contains(message_for(absent), absent.string() + ": cannot be written: No such file or directory;"));
  CHECK(contains(message_for(folder.path()), "Is a directory"));
  CHECK(contains(message_for("/dev/null"), "Invalid argument"));
  CHECK(fs::is_character_file("/dev/null"));
  CHECK(folder.file_count() == 0);
}

}  // namespace test_atomic_file
