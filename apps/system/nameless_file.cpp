#include "system/nameless_file.h"

#include <cerrno>
#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <unistd.h>

namespace pliant_system {

NamelessFile::NamelessFile(const std::filesystem::path& target) {
  std::string name = target.string() + ".pliant.tmp-XXXXXX";
  file_.reset(mkostemp(name.data(), O_CLOEXEC));
  if (file_.number() < 0) throw std::system_error(errno, std::generic_category());
  unlink(name.c_str());
}

std::size_t NamelessFile::read(std::uint64_t place, std::span<char> into) const {
  for (;;) {
    const ssize_t size = pread(file_.number(), into.data(), into.size(), static_cast<off_t>(place));
    if (size >= 0) return static_cast<std::size_t>(size);
    if (errno != EINTR) throw std::system_error(errno, std::generic_category());
  }
}

}  // namespace pliant_system
