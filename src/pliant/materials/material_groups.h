#pragma once
// From a material to the mass and the constraints of a body.
#include <map>
#include <optional>
#include <vector>

#include "pliant/constraints/builtin.h"
#include "pliant/materials/material.h"
#include "pliant/simulation/simulation.h"

namespace pliant {

/// How a body has its material.
struct MaterialPlacement {
  /// Of the warp at rest, and what it follows from without: see FibreStrain.
  Points direction{};
  Grain grain = Grain::automatic;
  /// From there to the warp [degrees]; 45: cut on the bias.
  Real angle = 0;
  /// By how much it is stretched at least at the top of a meter of it that hangs, ≥ 0; 0: as measured. Cloth stretches
  /// by a tenth of that, which nobody sees, and needs many times as many iterations to do so.
  Real least_stretch = 1e-3;
  /// Stretch that draws the waves of its yarns straight, 0 to 0.1: threads do not push, and get stiffer up to twice
  /// that. 0: as stiff from the start, and when pushed.
  Real slack = 0.005;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"direction", "", "of the warp, at rest; it is laid into the plane of each triangle"},
          self.direction);
    field(OptionInfo{"grain", "", "where no direction is given: see `fibre_strain`"}, self.grain);
    field(OptionInfo{"angle", "degrees", "from there to the warp; 45: cut on the bias"}, self.angle);
    field(OptionInfo{"least_stretch", "",
                     "by how much it is stretched at least at the top of a meter of it that hangs; 0: as measured, but "
                     "for `slack`, which needs many more iterations",
                     not_negative},
          self.least_stretch);
    field(OptionInfo{"slack", "",
                     "stretch that draws the waves of its yarns straight: threads do not push, and get stiffer up to "
                     "twice that; 0: as stiff from the start, and when pushed, with which coarse meshes hardly fold",
                     Range{0, 0.1}},
          self.slack);
  }
};

/// One group of constraints that a material is expressed by.
struct MaterialGroup {
  std::string_view name;  ///< "warp", "weft", "shear", "width", "bend"; "solid", "volume"
  std::variant<FibreStrain, TriangleStrain, TriangleArea, TriangleBending, TetrahedronStrain, TetrahedronVolume>
      options;
};

/// The groups of a sheet or a solid, those that would do nothing left out. Moduli of stretch and shear, not of bending,
/// are no more than what gives `least_stretch`.
///
/// A sheet with threads: fibres along warp and weft, and a triangle strain of twice the shear modulus, of which the
/// fibres have that much less. Fibres pull alone: their stiffness rises evenly, from a two-hundredth of what
/// `least_stretch` gives at rest to what was measured, or five times what `least_stretch` gives, whichever is less, at
/// a stretch of 1 + 2 `slack` (or 1 + 5 `least_stretch`, where that is more). Without slack they push as well, with
/// what `least_stretch` gives, and are taut from 1.005 on (or 1 + 5 `least_stretch`). A sheet with Poisson's ratio ν
/// whose warp and weft are alike, as an isotropic plate in plane stress: strain E t/(1 + ν), area 2 E t ν/(1 − ν²). A
/// solid: strain E/(1 + ν), volume 3 E ν/((1 + ν)(1 − 2ν)).
std::vector<MaterialGroup> material_groups(const Material& material, const MaterialPlacement& placement = {});

/// Mass per area or volume.
Mass mass_of(const Material& material);

/// Why this mesh cannot be made of this material, and what to do; empty where it can: a sheet wants triangles, a solid
/// tetrahedra.
std::string misfit(const Material& material, const Mesh& mesh);

/// (κ/ρg)^⅓ [m], a few of which the folds of a hanging sheet are wide; Peirce's bending length (1930).
Real fold_length(const SheetMaterial& sheet);

/// That the edges of a mesh are too long for the folds of a sheet, more than twice its fold length half of them, and
/// what to do; empty where they are not.
std::string coarseness(const Material& material, const Mesh& mesh);

/// Throws Error(input) where the mesh of the body cannot be made of it, or a number of it is out of its range.
void check_material(const Body& body, const Material& material);

/// Adds these groups to a body, each named "BODY.warp" and so on, and gives the body the friction of the material
/// unless it has its own. Throws as check_material and the builders of the groups do. The damping is one of
/// SolverSettings, for all bodies: it is left to the caller.
std::vector<GroupId> add_material(Simulation& simulation, BodyId body, const Material& material,
                                  const MaterialPlacement& placement = {});

/// The damping of these bodies' materials, each by the mass of its body [1/s]; none without a body.
std::optional<Real> mean_damping(const Simulation& simulation, const std::map<BodyId, Material>& materials);

/// With which bodies of materials look right in steps of 1/60 s: BDF2, 20 iterations of L-BFGS, an adaptive start.
/// Damping is that of a material, SurfaceMaterial::damping. benchmarks/NOTES.md has what was tried.
SolverSettings settings_for_materials();

}  // namespace pliant
