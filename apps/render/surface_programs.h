#pragma once
// The programs of surfaces, one for each combination of what they have: a processor that draws pays for every branch of
// a program, taken or not.
#include <map>
#include <memory>
#include <string>

#include "render/gl_objects.h"

namespace pliant_render {

/// What a program of surfaces has code for; see shaders::surface_fragment.
struct SurfaceTraits {
  bool is_solid = false;      ///< of a collider, in the tone `held`
  bool is_rope = false;       ///< a line that is lit as a tube
  bool is_flat = false;       ///< each face by itself
  bool is_colored = false;    ///< by a value, whatever the bodies look like
  bool has_looks = false;     ///< colors of the bodies' own, see VertexLook
  bool has_fields = false;    ///< checkers or stripes
  bool has_gradient = false;  ///< as painted stiffnesses are shown
  bool has_picture = false;   ///< textures
  bool has_weave = false;     ///< threads that can be seen
  bool has_cloth = false;     ///< finishes: sheen, and light from the other side
  bool has_gloss = false;     ///< what is glossy or of metal mirrors a studio
  bool has_shadows = false;
  bool has_occlusion = false;

  auto operator<=>(const SurfaceTraits&) const = default;
  /// What either has.
  SurfaceTraits with(const SurfaceTraits& other) const;
};

/// The head of a fragment program: its version, and the traits as constants.
std::string head_of(const SurfaceTraits& traits);

class SurfacePrograms {
 public:
  /// Makes the program when it is asked for first. Needs a current OpenGL context.
  const Program& of(const SurfaceTraits& traits);

 private:
  std::map<SurfaceTraits, std::unique_ptr<Program>> programs_;
};

}  // namespace pliant_render
