#include "pliant_io/export/animation_format.h"

#include <algorithm>

#include <fmt/format.h>

#include "pliant_io/export/detail/export_formats.h"
#include "pliant_io/files/extension.h"

namespace pliant {

namespace {

using Needs = AnimationFormat::Needs;
using Thins = AnimationFormat::Thins;
using Beside = AnimationFormat::Beside;

constexpr AnimationFormat animation_format_list[] = {
    {"gltf", Needs::faces, Thins::always, Beside::colliders, write_gltf},  //
    {"glb", Needs::faces, Thins::always, Beside::colliders, write_glb},    //
    {"usda", Needs::faces, Thins::when_asked, Beside::colliders, write_usda, usd_folder},
#ifdef PLIANT_HAS_VTU
    {"pvd", Needs::faces, Thins::never, Beside::values, write_pvd, pvd_folder},
#endif
    {"pc2", Needs::points, Thins::never, Beside::nothing, write_pc2},
    {"mdd", Needs::points, Thins::never, Beside::nothing, write_mdd},
    {"npy", Needs::points, Thins::never, Beside::nothing, write_npy},
};

}  // namespace

std::span<const AnimationFormat> animation_formats() {
  return animation_format_list;
}

std::optional<AnimationFormat> animation_format(const std::filesystem::path& path) {
  const auto* const found = std::ranges::find(animation_format_list, small_extension(path), &AnimationFormat::name);
  if (found == std::end(animation_format_list)) return {};
  return *found;
}

std::string animation_extensions() {
  std::string text;
  for (const AnimationFormat& format : animation_format_list) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", format.name);
  }
  return text;
}

}  // namespace pliant
