// Whether files are on the disk before they take their names. Takes the place of fsync.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <cerrno>
#include <filesystem>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "../support/temporary_folder.h"
#include "pliant/core/error.h"
#include "pliant_io/files/atomic_file.h"

namespace {

struct Sync {
  int calls = 0;
  off_t size = 0;          ///< of the file, at the last call
  std::string standing{};  ///< what stood under the name then
  std::filesystem::path name{};
  int error_number = 0;  ///< what the next call fails with; 0: it does not
};
Sync last;

}  // namespace

extern "C" int fsync(int file) {
  ++last.calls;
  struct stat status {};
  if (fstat(file, &status) == 0) last.size = status.st_size;
  last.standing = pliant_tests::TemporaryFolder::read(last.name);
  errno = std::exchange(last.error_number, 0);
  return errno == 0 ? 0 : -1;
}

TEST_CASE("a file is on the disk, whole, before it takes its name") {
  const pliant_tests::TemporaryFolder folder;
  const std::filesystem::path path = folder.write("a", "old");
  const std::string contents(100'000, 'x');
  SUBCASE("at once") {
    last = {.name = path};
    pliant::write_file_atomically(path, contents);
    CHECK(last.calls == 1);
  }
  SUBCASE("after an interrupt") {
    last = {.name = path, .error_number = EINTR};
    pliant::write_file_atomically(path, contents);
    CHECK(last.calls == 2);
  }
  SUBCASE("where the file system cannot tell") {
    last = {.name = path, .error_number = EINVAL};
    pliant::write_file_atomically(path, contents);
    CHECK(last.calls == 1);
  }
  CHECK(last.size == 100'000);
  CHECK(last.standing == "old");
  CHECK(pliant_tests::TemporaryFolder::read(path) == contents);
}

TEST_CASE("what does not get to the disk does not take the name") {
  const pliant_tests::TemporaryFolder folder;
  const std::filesystem::path path = folder.write("a", "old");
  last = {.name = path, .error_number = EIO};
  CHECK_THROWS_AS(pliant::write_file_atomically(path, "new"), pliant::Error);
  CHECK(pliant_tests::TemporaryFolder::read(path) == "old");
  CHECK(folder.file_count() == 1);
}
