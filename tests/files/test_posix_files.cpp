// What a file system has on POSIX alone: links, pipes, devices, limits.
#include <csignal>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/read_file.h"
#include "pliant_io/recorder/frame_writer.h"
#include "tests/mesh/meshes.h"
#include "tests/support/temporary_folder.h"

namespace test_posix_files {

namespace fs = std::filesystem;
using namespace pliant;
using namespace pliant_tests;

TEST_CASE("a link is no leftover") {
  const TemporaryFolder folder;
  const fs::path target = folder.write("target", "mine");
  fs::create_symlink(target, folder.path() / "a.pliant.tmp-0");
  remove_leftovers(folder.path(), [](std::string_view name) { return name == "a"; });
  write_file_atomically(folder.path() / "a", "new");
  CHECK(fs::is_symlink(folder.path() / "a.pliant.tmp-0"));
  CHECK(TemporaryFolder::read(target) == "mine");
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

TEST_CASE("devices are not written to, and neither is a folder of the system's") {
  CHECK(contains(error_of([&] { write_file_atomically("/dev/null", "x"); }, ErrorKind::output), "Invalid argument"));
  CHECK(fs::is_character_file("/dev/null"));
  CHECK(!error_of([&] { make_npy_writer("/proc", 2); }, ErrorKind::output).empty());
  const TemporaryFolder folder;
  fs::create_symlink("/dev/full", folder.path() / "frames.npy");
  const std::string full = error_of([&] { make_npy_writer(folder.path(), 2); }, ErrorKind::output);
  CHECK(contains(full, "No space left"));
}

TEST_CASE("devices and pipes are not read, and not waited for") {
  const TemporaryFolder folder;
  const auto message_for = [](const fs::path& path) { return error_of([&] { read_file(path); }); };
  fs::create_symlink("/dev/zero", folder.path() / "zero");
  CHECK(contains(message_for(folder.path() / "zero"), "zero: is not a regular file;"));
  const fs::path pipe = folder.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(contains(message_for(pipe), "is not a regular file;"));
}

}  // namespace test_posix_files
