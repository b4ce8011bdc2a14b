#include "render/surface_programs.h"

#include <array>
#include <utility>

#include "render/shaders.h"

namespace pliant_render {
namespace {

constexpr std::array<std::pair<const char*, bool SurfaceTraits::*>, 11> names = {
    {{"is_solid", &SurfaceTraits::is_solid},
     {"is_colored", &SurfaceTraits::is_colored},
     {"has_looks", &SurfaceTraits::has_looks},
     {"has_fields", &SurfaceTraits::has_fields},
     {"has_gradient", &SurfaceTraits::has_gradient},
     {"has_picture", &SurfaceTraits::has_picture},
     {"has_weave", &SurfaceTraits::has_weave},
     {"has_cloth", &SurfaceTraits::has_cloth},
     {"has_gloss", &SurfaceTraits::has_gloss},
     {"has_shadows", &SurfaceTraits::has_shadows},
     {"has_occlusion", &SurfaceTraits::has_occlusion}}};

}  // namespace

SurfaceTraits SurfaceTraits::with(const SurfaceTraits& other) const {
  SurfaceTraits both = *this;
  both.is_flat = is_flat || other.is_flat;
  for (const auto& [name, trait] : names) both.*trait = both.*trait || other.*trait;
  return both;
}

std::string head_of(const SurfaceTraits& traits) {
  std::string head = "#version 330 core\n";
  for (const auto& [name, trait] : names) {
    head.append("const bool ").append(name).append(traits.*trait ? " = true;\n" : " = false;\n");
  }
  return head;
}

const Program& SurfacePrograms::of(const SurfaceTraits& traits) {
  std::unique_ptr<Program>& program = programs_[traits];
  if (program == nullptr) {
    const std::string fragment = head_of(traits)
                                     .append(shaders::dithering)
                                     .append(shaders::lighting)
                                     .append(traits.is_rope ? shaders::rope_fragment : shaders::surface_fragment);
    if (traits.is_rope) {
      program = std::make_unique<Program>(shaders::stroke_vertex, shaders::line_geometry, fragment);
    } else if (traits.is_solid) {
      program = std::make_unique<Program>(shaders::solid_vertex, "", fragment);
    } else if (traits.is_flat) {
      program = std::make_unique<Program>(shaders::flat_vertex, shaders::flat_geometry, fragment);
    } else {
      program = std::make_unique<Program>(shaders::surface_vertex, "", fragment);
    }
  }
  return *program;
}

}  // namespace pliant_render
