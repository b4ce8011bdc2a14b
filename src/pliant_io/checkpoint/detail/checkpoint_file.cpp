#include "pliant_io/checkpoint/detail/checkpoint_file.h"

#include <bit>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant_io/files/crc32.h"

namespace pliant {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they are in memory");

constexpr std::string_view magic = "PLIANTCP";
constexpr std::uint32_t format_version = 4;
constexpr std::uint32_t version_of_old_contact = 3;
constexpr std::size_t version_place = 8;
constexpr std::size_t checksum_place = 12;
constexpr std::size_t size_place = 16;
constexpr std::size_t header_size = 24;

template <class Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

template <class Number>
Number number_at(std::string_view bytes, std::size_t place) {
  Number number;
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

/// Of the version and the content.
std::uint32_t checksum(std::uint32_t version, std::string_view content) {
  std::string bytes;
  append(bytes, version);
  return crc32(bytes.append(content));
}

}  // namespace

std::string seal(std::string_view content) {
  std::string bytes(magic);
  append(bytes, format_version);
  append(bytes, checksum(format_version, content));
  append(bytes, static_cast<std::uint64_t>(content.size()));
  return bytes.append(content);
}

Unsealed unseal(std::string_view bytes, std::string_view name, const FileWords& words) {
  const auto fail = [&](std::string_view what) { fail_input(fmt::format("{}: {}", name, what)); };
  if (!bytes.starts_with(magic.substr(0, bytes.size())) || bytes.empty()) {
    fail(fmt::format("is not a {}; give one that {} wrote, or {}", words.kind, words.writer, words.remedy));
  }
  const std::string remedy = fmt::format("take an older {}, or {}", words.kind, words.remedy);
  if (bytes.size() < header_size)
    fail(fmt::format("this {} is cut off after {} bytes; {}", words.kind, bytes.size(), remedy));
  const auto found_version = number_at<std::uint32_t>(bytes, version_place);
  const auto size = number_at<std::uint64_t>(bytes, size_place);
  const std::string_view content = bytes.substr(header_size);
  const bool whole = size == content.size();
  const bool sound = whole && number_at<std::uint32_t>(bytes, checksum_place) == checksum(found_version, content);
  if (sound && found_version == 1) {
    fail(
        "this checkpoint was written by Pliant 0.1.0, whose format this version no longer reads; resume it with Pliant "
        "0.1.0, or run the scene from its start");
  }
  const bool has_old_contact = found_version == version_of_old_contact;
  if (sound && found_version != format_version && !has_old_contact) {
    fail(fmt::format("this {} has the format {}, and this program reads {}; resume it with the program that wrote it",
                     words.kind, found_version, format_version));
  }
  if (!whole && size > content.size()) {
    fail(fmt::format("this {} is cut off: it has {} of {} bytes; {}", words.kind, content.size(), size, remedy));
  }
  if (!sound) fail(fmt::format("this {} is damaged, its checksum does not fit; {}", words.kind, remedy));
  return {content, has_old_contact};
}

}  // namespace pliant
