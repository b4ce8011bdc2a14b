#include "pliant_io/scene/detail/foreign_file.h"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "pliant_io/mesh/mesh_format.h"
#include "pliant_io/scene/detail/json_text.h"

namespace pliant {
namespace {

using std::string_view_literals::operator""sv;

struct Signature {
  std::size_t offset;
  std::string_view bytes;
  std::string_view what;
};

constexpr std::array<Signature, 13> signatures = {{
    {0, "\x89PNG\r\n"sv, "a PNG picture"},
    {0, "\xff\xd8\xff"sv, "a JPEG picture"},
    {0, "GIF8"sv, "a GIF picture"},
    {0, "BM"sv, "a BMP picture"},
    {8, "WEBP"sv, "a WebP picture"},
    {4, "ftyp"sv, "a film or a photo"},
    {0, "%PDF"sv, "a PDF document"},
    {0, "PK\x03\x04"sv, "a ZIP archive or an office document"},
    {0, "\x1f\x8b"sv, "a gzip archive"},
    {0, "BLENDER"sv, "a file of Blender"},
    {0, "\x93NUMPY"sv, "an array of NumPy"},
    {0, "glTF"sv, "a glTF file"},
    {0, "<"sv, "an XML or HTML file"},
}};

std::string_view without_mark_and_space(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf"sv)) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == text.npos ? std::string_view() : text.substr(first);
}

std::string_view kind_of(std::string_view bytes) {
  for (const Signature& signature : signatures) {
    const bool is_long = bytes.size() >= signature.offset;
    if (is_long && bytes.substr(signature.offset).starts_with(signature.bytes)) return signature.what;
  }
  if (bytes.empty()) return "an empty file";
  const bool is_binary = std::ranges::any_of(bytes.substr(0, 1000), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t';
  });
  return is_binary ? "no text" : "a text that does not begin with '{'";
}

}  // namespace

void refuse_foreign_file(const std::filesystem::path& file, std::string_view bytes) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const std::string_view begin = without_mark_and_space(bytes);
  if (extension == ".json" || begin.starts_with('{') || begin.starts_with('[')) return;
  std::string meshes;
  for (const std::string_view each : readable_mesh_extensions()) {
    meshes += fmt::format("{}.{}", meshes.empty() ? "" : ", ", each);
  }
  fail_at(
      file.string(), "",
      fmt::format("this looks like {}, not a scene; give a scene (.json) or a mesh ({}); the window takes checkpoints "
                  "(.pliant) and recorded sessions (.session) too",
                  kind_of(bytes), meshes));
}

}  // namespace pliant
