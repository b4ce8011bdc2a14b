#include "pliant_io/export/detail/usd_pictures.h"

#include <algorithm>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant_io/export/detail/export_formats.h"
#include "pliant_io/export/detail/gltf_materials.h"

namespace pliant {
namespace {

constexpr std::string_view picture_head = "picture_";

std::string picture_name(std::size_t number, SurfaceImage::Format format) {
  return fmt::format("{}{}.{}", picture_head, number, format == SurfaceImage::Format::png ? "png" : "jpg");
}

/// Whether picture_name() makes it.
bool is_picture(std::string_view name) {
  if (!name.starts_with(picture_head) || !(name.ends_with(".png") || name.ends_with(".jpg"))) return false;
  const std::string_view digits = name.substr(picture_head.size(), name.size() - picture_head.size() - 4);
  return !digits.empty() && std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
}

/// A relative path in the marks of references.
std::string asset_text(const std::string& path) {
  const bool is_writable = std::ranges::none_of(path, [](char c) { return static_cast<unsigned char>(c) < ' '; });
  if (!is_writable || path.find("@@@") != path.npos || usd_string(path).find("\xEF\xBF\xBD") != std::string::npos) {
    fail_input("a name that a reference in USD cannot hold; give one of letters and digits");
  }
  const std::string_view mark = path.find('@') == path.npos ? "@" : "@@@";
  return fmt::format("{0}./{1}{0}", mark, path);
}

void write_shader(UsdText& text, std::string_view name, std::string_view kind,
                  const std::vector<std::string>& attributes) {
  text.line("");
  text.open(fmt::format("def Shader \"{}\"", name));
  text.line(fmt::format("uniform token info:id = \"{}\"", kind));
  for (const std::string& attribute : attributes) text.line(attribute);
  text.close();
}

}  // namespace

std::filesystem::path usd_folder(const std::filesystem::path& path) {
  return path.parent_path() / (path.stem().string() + "_textures");
}

std::string UsdPictures::reference(const SurfaceImage& image) {
  const auto found = std::ranges::find(images_, image.bytes, &SurfaceImage::bytes);
  const auto number = static_cast<std::size_t>(found - images_.begin());
  if (found == images_.end()) images_.push_back(&image);
  return asset_text(usd_folder(path_).filename().string() + '/' + picture_name(number, image.format));
}

void UsdPictures::commit() {
  if (images_.empty()) return;
  AtomicFolder folder(usd_folder(path_), is_picture);
  for (std::size_t i = 0; i < images_.size(); ++i) {
    write_file_atomically(folder.temporary_path() / picture_name(i, images_[i]->format), images_[i]->bytes);
  }
  folder.commit();
}

std::string usd_material(const std::string& place) {
  return place + "/look";
}

void write_usd_material(UsdText& text, const std::string& place, const SurfaceLook& look, const std::string& picture) {
  const std::string material = usd_material(place);
  const auto connection = [&](std::string_view attribute, std::string_view output) {
    return fmt::format("{}.connect = <{}/{}>", attribute, material, output);
  };
  const SurfaceFinish finish = look.finish.value_or(SurfaceFinish{});
  const auto [red, green, blue] = light_of(look.front.color);
  const std::string color = fmt::format("color3f inputs:diffuseColor = ({}, {}, {})", static_cast<float>(red),
                                        static_cast<float>(green), static_cast<float>(blue));
  text.open("def Material \"look\"");
  text.line(connection("token outputs:surface", "surface.outputs:surface"));
  write_shader(text, "surface", "UsdPreviewSurface",
               {picture.empty() ? color : connection("color3f inputs:diffuseColor", "picture.outputs:rgb"),
                fmt::format("float inputs:metallic = {}", finish.is_metal ? 1 : 0),
                fmt::format("float inputs:roughness = {}", finish.roughness), "token outputs:surface"});
  if (!picture.empty()) {
    write_shader(text, "picture", "UsdUVTexture",
                 {"asset inputs:file = " + picture, "token inputs:sourceColorSpace = \"sRGB\"",
                  connection("float2 inputs:st", "coordinates.outputs:result"), "token inputs:wrapS = \"repeat\"",
                  "token inputs:wrapT = \"repeat\"", "float3 outputs:rgb"});
    write_shader(text, "coordinates", "UsdPrimvarReader_float2",
                 {"string inputs:varname = \"st\"", "float2 outputs:result"});
  }
  text.close();
}

}  // namespace pliant
