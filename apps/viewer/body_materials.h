#pragma once
// What the bodies of a scene are made of, as a user changes it while they move.
#include <string>
#include <vector>

#include "pliant/materials/material_groups.h"
#include "pliant_io/scene/scene.h"

namespace pliant_viewer {

struct MaterialChoice {
  std::string name;
  std::string description;
};

struct BodyMaterial {
  pliant::BodyId body{};
  std::string name;                     ///< of the body
  std::string material;                 ///< empty: it has constraints of its own
  std::vector<MaterialChoice> choices;  ///< what its mesh can be made of
};

/// Of the bodies that can be made of any material and are no figures, in their order; see Session::figures.
std::vector<BodyMaterial> list_materials(const pliant::Scene& scene, const std::vector<char>& is_figure);

/// Makes a body of the material of that name, one of the scene's own or of the library, with its threads as given. The
/// first material of a scene
/// brings the settings with which it looks right; the damping follows the materials unless it is another than theirs.
/// Throws pliant::Error (input), and has changed nothing then, where there is none or the body cannot be made of it.
void change_material(pliant::Scene& scene, pliant::BodyId body, const std::string& material,
                     const pliant::MaterialPlacement& placement);

}  // namespace pliant_viewer
